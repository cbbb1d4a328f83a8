#include "normal_spread.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace particle_surface_tracker {

namespace {

/// Smallest sine of the angle between two sides of a triangle whose normal means something.
constexpr float kSmallestSine = 1e-4f;

/// Normals whose sum is shorter have no mean.
constexpr float kSmallestSum = 1e-3f;

Vec3f unit_normal(const std::vector<Vec3f>& vertices, const Triangle& triangle) {
  const Vec3f e1 = vertices[triangle[1]] - vertices[triangle[0]];
  const Vec3f e2 = vertices[triangle[2]] - vertices[triangle[0]];
  const Vec3f cross = e1.cross(e2);
  const float squared = cross.squaredNorm();
  if (!(squared > kSmallestSine * kSmallestSine * e1.squaredNorm() * e2.squaredNorm())) return Vec3f::Zero();
  return cross / std::sqrt(squared);
}

}  // namespace

NormalSpread::NormalSpread(const SurfaceTriangulation& surface)
    : normals_(surface.triangles.size()),
      means_(surface.vertices.size(), Vec3f::Zero()),
      cosines_(surface.vertices.size(), 1.0f) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals_.size(), 1024), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t) {
      normals_[t] = unit_normal(surface.vertices, surface.triangles[t]);
    }
  });
  for (std::size_t t = 0; t < normals_.size(); ++t) {
    for (const std::uint32_t vertex : surface.triangles[t]) means_[vertex] += normals_[t];
  }
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, means_.size(), 1024), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v) {
      const float length = means_[v].norm();
      means_[v] = length > kSmallestSum ? Vec3f(means_[v] / length) : Vec3f::Zero();
    }
  });
  for (std::size_t t = 0; t < normals_.size(); ++t) {
    if (normals_[t].isZero(0.0f)) continue;
    for (const std::uint32_t vertex : surface.triangles[t]) {
      cosines_[vertex] = std::min(cosines_[vertex], normals_[t].dot(means_[vertex]));
    }
  }
}

}  // namespace particle_surface_tracker
