#include "particle_surface_tracker/stages/stretched_detail.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

namespace particle_surface_tracker {

namespace {

constexpr const char* kAttributeName = "stretch";

/// δ is left alone until the surface around a vertex has grown by this factor.
constexpr double kToleratedGrowth = 2.0;

/// Largest change of area in one frame that is believed; more is a vertex that jumps.
constexpr double kLargestGrowth = 2.0;

float double_area(const std::vector<Vec3f>& positions, const Triangle& t) {
  return (positions[t[1]] - positions[t[0]]).cross(positions[t[2]] - positions[t[0]]).norm();
}

/// Part of its δ that a vertex keeps.
double kept_part(double stretch) {
  return std::min(1.0, kToleratedGrowth / stretch);
}

}  // namespace

void thin_stretched_detail(TriangleMesh& mesh, const std::vector<Vec3f>& before) {
  const std::size_t attribute = mesh.attributes().add(kAttributeName, 1, {1.0F}, AttributeUse::kInternal);
  const std::vector<Triangle>& triangles = mesh.triangles();
  std::vector<float> areas_before(triangles.size()), areas(triangles.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles.size(), 4096), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t) {
      areas_before[t] = double_area(before, triangles[t]);
      areas[t] = double_area(mesh.positions(), triangles[t]);
    }
  });
  std::vector<float> around_before(mesh.vertex_count(), 0.0F), around(mesh.vertex_count(), 0.0F);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) {
      around_before[v] += areas_before[t];
      around[v] += areas[t];
    }
  }
  std::vector<float>& stretch = mesh.attributes()[attribute].values;
  std::vector<float>& delta = mesh.delta();
  for (std::size_t v = 0; v < delta.size(); ++v) {
    if (!(around_before[v] > 0.0F) || !(around[v] > 0.0F)) continue;
    const double growth =
        std::clamp(static_cast<double>(around[v]) / around_before[v], 1.0 / kLargestGrowth, kLargestGrowth);
    const double kept_before = kept_part(stretch[v]);
    stretch[v] = static_cast<float>(growth * stretch[v]);
    const double kept = kept_part(stretch[v]);
    if (kept != kept_before) delta[v] = static_cast<float>(delta[v] * (kept / kept_before));
  }
}

}  // namespace particle_surface_tracker
