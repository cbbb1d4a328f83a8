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

/// The box that holds the normals of the triangles around each vertex.
class NormalBoxes {
 public:
  explicit NormalBoxes(const SurfaceTriangulation& surface);

  /// What the normals of the triangles around a vertex are within.
  const NormalBox& around(std::uint32_t vertex) const { return boxes_[vertex]; }

 private:
  std::vector<NormalBox> boxes_;
};

}  // namespace particle_surface_tracker
