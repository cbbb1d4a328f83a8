#include "frame_description.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "particle_surface_tracker/core/mesh_measures.h"

namespace particle_surface_tracker {

namespace {

/// Largest share of the particles that may be replaced by others in a frame, before their ids are in doubt.
constexpr double kLargestReplacedShare = 0.3;
constexpr std::size_t kFewestReplaced = 100;

}  // namespace

void describe_frame(FrameReport& report, const TrackedFrame& tracked, const ImplicitSurface* surface,
                    const ParticleFrame& frame) {
  const MeshMeasures mesh = measure_mesh(tracked.mesh);
  report.stamp_ns = frame.stamp_ns;
  report.particles = frame.size();
  report.vertices = tracked.mesh.vertex_count();
  report.triangles = tracked.mesh.triangle_count();
  report.components = mesh.components;
  report.genus = mesh.genus;
  report.volume = mesh.volume;
  report.area = mesh.area;
  report.smallest_angle = mesh.smallest_angle;
  if (surface != nullptr && !frame.empty()) {
    const SurfaceTriangulation& isosurface = surface->triangulation;
    report.implicit_volume = signed_volume(isosurface.vertices, isosurface.triangles);
  }
  for (const float delta : tracked.mesh.delta()) {
    report.max_abs_delta = std::max(report.max_abs_delta, std::abs(static_cast<double>(delta)));
  }
  const auto& ids = tracked.mesh.ids();
  report.original_vertices_alive = static_cast<std::size_t>(
      std::count_if(ids.begin(), ids.end(), [&](std::uint32_t id) { return id < tracked.original_vertices; }));
}

void warn_of_untrue_ids(FrameReport& report, std::size_t particles) {
  const std::size_t replaced = std::min(report.particles_gone, report.particles_born);
  const double share = static_cast<double>(replaced) / static_cast<double>(particles);
  if (replaced < kFewestReplaced || share <= kLargestReplacedShare) return;
  report.warnings.push_back(
      fmt::format("{:.0f} % of the particles vanished, and as many appeared, by their ids: are these true ids, "
                  "and not places in an array that the simulator sorts or fills anew?",
                  100.0 * share));
}

}  // namespace particle_surface_tracker
