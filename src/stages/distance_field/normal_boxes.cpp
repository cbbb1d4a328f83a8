#include "normal_boxes.h"

#include <cmath>

namespace particle_surface_tracker {

namespace {

/// Smallest sine of the angle between two sides of a triangle whose normal means something.
constexpr float kSmallestSine = 1e-4f;

Quad unit_normal(const std::vector<Vec3f>& vertices, const Triangle& triangle) {
  const Quad a = load_quad(vertices[triangle[0]]);
  const Quad e1 = load_quad(vertices[triangle[1]]) - a;
  const Quad e2 = load_quad(vertices[triangle[2]]) - a;
  const Quad normal = cross(e1, e2);
  const float squared = dot(normal, normal);
  if (!(squared > kSmallestSine * kSmallestSine * dot(e1, e1) * dot(e2, e2))) return Quad{};
  return normal / std::sqrt(squared);
}

}  // namespace

NormalBoxes::NormalBoxes(const SurfaceTriangulation& surface)
    : normals_(surface.triangles.size()), boxes_(surface.vertices.size()) {
  for (std::size_t t = 0; t < normals_.size(); ++t) {
    const Quad normal = unit_normal(surface.vertices, surface.triangles[t]);
    normals_[t] = normal;
    if (is_zero(normal)) continue;
    for (const std::uint32_t vertex : surface.triangles[t]) boxes_[vertex].extend({normal, normal});
  }
}

}  // namespace particle_surface_tracker
