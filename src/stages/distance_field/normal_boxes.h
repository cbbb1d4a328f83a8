#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "quad.h"

namespace particle_surface_tracker {

/// A box of directions; the fourth coordinates mean nothing.
struct NormalBox {
  Quad lower = Quad{} + 2.0f;  ///< Above the upper end: holds no direction.
  Quad upper = Quad{} - 2.0f;

  void extend(const NormalBox& box) {
    lower = smaller(lower, box.lower);
    upper = larger(upper, box.upper);
  }
};

/// Normals of the triangles, and the box that holds those around each vertex.
class NormalBoxes {
 public:
  explicit NormalBoxes(const SurfaceTriangulation& surface);

  /// Unit normal of a triangle, outward; zero if the triangle is a segment or a point.
  const Quad& normal(std::uint32_t triangle) const { return normals_[triangle]; }

  /// What the normals of the triangles around a vertex are within.
  const NormalBox& around(std::uint32_t vertex) const { return boxes_[vertex]; }

 private:
  std::vector<Quad> normals_;
  std::vector<NormalBox> boxes_;
};

}  // namespace particle_surface_tracker
