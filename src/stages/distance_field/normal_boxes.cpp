#include "normal_boxes.h"

#include <algorithm>
#include <array>

#include "triangle_shape.h"

namespace particle_surface_tracker {

namespace {

/// Triangles whose normals are made at a time: they stay in the innermost cache.
constexpr std::uint32_t kChunk = 256;

}  // namespace

NormalBoxes::NormalBoxes(const SurfaceTriangulation& surface) : boxes_(surface.vertices.size()) {
  const TriangleKernel& kernel = active_triangle_kernel();
  const auto count = static_cast<std::uint32_t>(surface.triangles.size());
  std::array<Quad, kChunk + TriangleKernel::lanes> normals;
  for (std::uint32_t begin = 0; begin < count; begin += kChunk) {
    const std::uint32_t end = std::min(begin + kChunk, count);
    kernel.make_normals({&surface, begin, end, 1.0, {}}, normals.data());
    for (std::uint32_t t = begin; t < end; ++t) {
      const Quad& normal = normals[t - begin];
      if (is_zero(normal)) continue;
      for (const std::uint32_t vertex : surface.triangles[t]) boxes_[vertex].extend({normal, normal});
    }
  }
}

}  // namespace particle_surface_tracker
