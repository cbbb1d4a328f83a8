#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Interpolation.h>
#include <openvdb/tools/MeshToVolume.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/particle_grid.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "winding_number.h"

namespace particle_surface_tracker {

namespace {

constexpr double kLargestOutsideShare = 0.05;
constexpr double kLargestMedianDistance = 3.0;  // [r]
constexpr double kLargestSpacingRatio = 3.0;
/// So few particles may be far from each other whatever their spacing: the first drops of an emitter, for instance.
constexpr std::size_t kFewestForSpacing = 10;

/// Median over the vertices of the distance to the nearest particle [m].
double median_particle_distance(const TriangleMesh& mesh, const ParticleFrame& frame, double r) {
  // A wrong scale puts vertices far from all particles, where a search is slow; some thousand vertices settle the
  // median.
  constexpr std::size_t enough = 5000;
  const std::size_t stride = std::max<std::size_t>(1, mesh.vertex_count() / enough);
  const ParticleGrid grid(frame.positions, r);
  std::vector<double> distances;
  for (std::size_t v = 0; v < mesh.vertex_count(); v += stride) {
    const Vec3d vertex = mesh.positions()[v].cast<double>();
    distances.push_back((frame.positions[grid.nearest(vertex)].cast<double>() - vertex).norm());
  }
  const auto median = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), median, distances.end());
  return *median;
}

/// Share of the particles that lie outside the mesh's bounding box by more than r.
double share_outside_box(const TriangleMesh& mesh, const ParticleFrame& frame, double r) {
  Eigen::AlignedBox3d box;
  for (const Vec3f& position : mesh.positions()) box.extend(position.cast<double>());
  const auto outside = std::count_if(frame.positions.begin(), frame.positions.end(), [&](const Vec3f& p) {
    return box.squaredExteriorDistance(p.cast<double>()) > r * r;
  });
  return static_cast<double>(outside) / static_cast<double>(frame.size());
}

/// Share of the particles that lie outside the mesh by more than r, or, where it is small anyway, by however little:
/// distances take ten times as long as all else. Only these come from a level set: the signs of OpenVDB's are those of
/// a flood from outside, to which a cavity is inside.
double share_outside(const TriangleMesh& mesh, const ParticleFrame& frame, double r) {
  const std::vector<int> windings = winding_numbers(mesh, frame.positions, r);
  const auto not_inside = static_cast<double>(std::count(windings.begin(), windings.end(), 0));
  const double most = not_inside / static_cast<double>(frame.size());
  if (most <= kLargestOutsideShare) return most;
  openvdb::initialize();
  const double voxel = 0.5 * r;
  constexpr float half_width = 4.0F;  // [voxels], more than r
  std::vector<openvdb::Vec3s> points;
  for (const Vec3f& p : mesh.positions()) points.emplace_back(p.x(), p.y(), p.z());
  std::vector<openvdb::Vec3I> triangles;
  for (const auto& [a, b, c] : mesh.triangles()) triangles.emplace_back(a, b, c);
  const auto transform = openvdb::math::Transform::createLinearTransform(voxel);
  const auto distance = openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*transform, points, triangles, half_width);
  openvdb::tools::GridSampler<openvdb::FloatGrid, openvdb::tools::BoxSampler> sampler(*distance);

  std::size_t outside = 0;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    const Vec3f& p = frame.positions[i];
    if (windings[i] == 0 && std::abs(sampler.wsSample(openvdb::Vec3d(p.x(), p.y(), p.z()))) > r) ++outside;
  }
  return static_cast<double>(outside) / static_cast<double>(frame.size());
}

[[noreturn]] void throw_mismatch(const std::string& figures) {
  throw TrackingError("the mesh does not bound these particles: " + figures +
                      ". Is one of them in another scale, position, axis convention or frame?");
}

}  // namespace

void check_spacing_fits_particles(const ParticleFrame& frame, double particle_spacing) {
  const double r = particle_spacing;
  if (frame.size() < kFewestForSpacing) return;
  const double estimated = estimate_particle_spacing(frame);
  if (r <= kLargestSpacingRatio * estimated && estimated <= kLargestSpacingRatio * r) return;
  throw TrackingError(
      fmt::format("the particle spacing is given as {:.6g} m, but the median distance from a particle to "
                  "the nearest other one is {:.6g} m; give the spacing of the simulation",
                  r, estimated));
}

void check_mesh_fits_particles(const TriangleMesh& mesh, const ParticleFrame& frame, double particle_spacing) {
  const double r = particle_spacing;
  check_spacing_fits_particles(frame, r);
  const double median = median_particle_distance(mesh, frame, r);
  if (median > kLargestMedianDistance * r) {
    throw_mismatch(fmt::format(
        "the median distance from a vertex to the nearest particle is {:.3g} r (at most {} r, r = {:.6g} m)",
        median / r, kLargestMedianDistance, r));
  }
  // The box first: it also keeps the level set from being as large as a mesh of the wrong scale.
  const double share = share_outside_box(mesh, frame, r);
  const double outside = share > kLargestOutsideShare ? share : share_outside(mesh, frame, r);
  if (outside > kLargestOutsideShare) {
    throw_mismatch(
        fmt::format("{:.1f} % of the particles lie outside the mesh by more than r = {:.6g} m (at most {:.0f} %)",
                    100.0 * outside, r, 100.0 * kLargestOutsideShare));
  }
}

}  // namespace particle_surface_tracker
