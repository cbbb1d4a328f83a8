#include "sequences/frame_judgement.h"

#include <fmt/format.h>

#include "sequences/mesh_judge.h"
#include "sequences/solid_judge.h"

namespace particle_surface_tracker::test {

namespace {

std::string intersections(const FrameJudgement& judgement, const char* absent) {
  const bool counted = judgement.intersecting != FrameJudgement::not_counted;
  return counted ? fmt::format("{}", judgement.intersecting) : absent;
}

}  // namespace

FrameJudgement judge_frame(const Tracker& tracker, const ParticleFrame& particles, const FrameReport& report,
                           bool count_intersections) {
  const double r = tracker.parameters().particle_spacing;
  const std::vector<Vec3f>& positions = tracker.mesh().positions();
  const std::vector<Triangle>& triangles = tracker.mesh().triangles();
  const SurfaceTriangulation& surface = tracker.implicit_surface()->triangulation;
  const Detection& detection = tracker.detection();

  FrameJudgement judgement;
  judgement.frame = report.frame;
  judgement.covered_share = SolidJudge(positions, triangles).covered_share(particles.positions, 0.5 * r);
  judgement.volume = enclosed_volume(positions, triangles);
  judgement.volume_ratio = judgement.volume / enclosed_volume(surface.vertices, surface.triangles);
  judgement.vertices = positions.size();
  judgement.flagged = detection.flagged_vertices.size();
  judgement.clusters = count_clusters(positions.size(), triangles, detection.flagged_vertices);
  judgement.unreached = detection.unreached_vertices;
  judgement.inverted = count_inverted_triangles(positions, triangles);
  judgement.is_manifold = find_surface_defects(positions.size(), triangles).none();
  judgement.intersecting = count_intersections && judgement.is_manifold
                               ? count_self_intersecting_triangles(positions, triangles)
                               : FrameJudgement::not_counted;
  judgement.max_abs_delta = report.max_abs_delta / r;
  return judgement;
}

std::string judgement_header() {
  return "frame  covered %   V/V_phi  to first   flagged        %  clusters  unreached  inverted  crossing  max "
         "|delta| r";
}

std::string judgement_row(const FrameJudgement& j, const FrameJudgement& first) {
  return fmt::format("{:5} {:10.3f} {:9.4f} {:9.4f} {:9} {:8.3f} {:9} {:10} {:9} {:>9} {:14.3f}{}", j.frame,
                     100.0 * j.covered_share, j.volume_ratio, j.volume_ratio / first.volume_ratio, j.flagged,
                     100.0 * j.flagged_share(), j.clusters, j.unreached, j.inverted, intersections(j, "-"),
                     j.max_abs_delta, j.is_manifold ? "" : "  NOT MANIFOLD");
}

std::string judgement_csv_header() {
  return "frame,covered_share,volume,volume_ratio,volume_ratio_to_first,vertices,flagged,clusters,unreached,inverted,"
         "self_intersecting,manifold,max_abs_delta_r";
}

std::string judgement_csv_row(const FrameJudgement& j, const FrameJudgement& first) {
  return fmt::format("{},{:.6f},{:.9g},{:.6f},{:.6f},{},{},{},{},{},{},{},{:.6f}", j.frame, j.covered_share, j.volume,
                     j.volume_ratio, j.volume_ratio / first.volume_ratio, j.vertices, j.flagged, j.clusters,
                     j.unreached, j.inverted, intersections(j, ""), j.is_manifold ? 1 : 0, j.max_abs_delta);
}

}  // namespace particle_surface_tracker::test
