#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Normals of the triangles, and how far those around each vertex lean away from their mean.
class NormalSpread {
 public:
  explicit NormalSpread(const SurfaceTriangulation& surface);

  /// Unit normal of a triangle, outward; zero if the triangle is a segment or a point.
  const Vec3f& normal(std::uint32_t triangle) const { return normals_[triangle]; }

  /// Unit mean of the normals around a vertex; zero where they cancel.
  const Vec3f& mean(std::uint32_t vertex) const { return means_[vertex]; }

  /// Cosine of the largest angle between the mean and a normal around the vertex.
  float cosine(std::uint32_t vertex) const { return cosines_[vertex]; }

 private:
  std::vector<Vec3f> normals_;
  std::vector<Vec3f> means_;
  std::vector<float> cosines_;
};

}  // namespace particle_surface_tracker
