#pragma once

#include <cstdint>
#include <vector>

#include <emmintrin.h>
#include <openvdb/Types.h>

#include "normal_boxes.h"
#include "particle_surface_tracker/core/implicit_surface.h"
#include "stages/nodes/leaf_index.h"
#include "triangle_shape.h"

namespace particle_surface_tracker {

/// Triangles in one cut cell.
constexpr int kMostCellTriangles = 12;

/// The cut cells of an isosurface, ready for questions about distances.
class SurfaceCells {
 public:
  /// The cells of one leaf of 8³.
  struct Leaf {
    openvdb::Coord origin;
    std::uint32_t begin, end;
  };

  explicit SurfaceCells(const ImplicitSurface& surface);

  const ImplicitSurface& surface() const { return surface_; }
  const NormalBoxes& normals() const { return normals_; }
  const std::vector<Leaf>& leaves() const { return leaves_; }

  /// Number of the leaf with that origin, or LeafIndex::none.
  std::uint32_t find(const openvdb::Coord& origin) const { return index_.find(origin); }

  TriangleRange triangles_of(const Leaf& leaf) const {
    const SurfaceTriangulation& mesh = surface_.triangulation;
    return {&mesh, mesh.cells[leaf.begin].first_triangle, mesh.cells[leaf.end].first_triangle, per_meter_, leaf.origin};
  }

  /// A vertex of the triangulation relative to a node, in cells.
  Quad relative(std::uint32_t vertex, const openvdb::Coord& node) const {
    const Quad place = load_quad(surface_.triangulation.vertices[vertex]);
    const __m128d xy = _mm_cvtps_pd(place) * per_meter_ - _mm_setr_pd(node.x(), node.y());
    const __m128d z = _mm_cvtps_pd(_mm_movehl_ps(place, place)) * per_meter_ - _mm_set_sd(node.z());
    return _mm_movelh_ps(_mm_cvtpd_ps(xy), _mm_cvtpd_ps(z));
  }

 private:
  const ImplicitSurface& surface_;
  double per_meter_;
  NormalBoxes normals_;
  std::vector<Leaf> leaves_;
  LeafIndex index_;
};

}  // namespace particle_surface_tracker
