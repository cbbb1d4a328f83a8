#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include <openvdb/math/Proximity.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "patch_places.h"

namespace particle_surface_tracker::remeshing {

namespace {

using openvdb::Coord;

/// The mesh is searched in cells up to this far away; attributes of surface that is born farther from it are initial.
constexpr int kFarthestRing = 3;

openvdb::Vec3d to_vdb(const Vec3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// The place on a mesh that is closest to a position.
class ClosestBlend {
 public:
  explicit ClosestBlend(const MeshLattice& lattice) : lattice_(lattice) {}

  VertexBlend find(const Vec3d& position) {
    best_ = std::numeric_limits<double>::infinity();
    blend_.clear();
    const Vec3d in_cells = position / lattice_.h();
    const Coord center(static_cast<int>(std::floor(in_cells.x())), static_cast<int>(std::floor(in_cells.y())),
                       static_cast<int>(std::floor(in_cells.z())));
    for (int ring = 0; ring <= kFarthestRing; ++ring) {
      // What lies in this ring is farther than the rings inside it are wide.
      const double nearest = std::max(ring - 1, 0) * lattice_.h();
      if (best_ <= nearest * nearest) break;
      look_at_ring(center, ring, position);
    }
    return blend_;
  }

 private:
  void look_at_ring(const Coord& center, int ring, const Vec3d& position) {
    for (int x = -ring; x <= ring; ++x) {
      for (int y = -ring; y <= ring; ++y) {
        const bool on_side = std::abs(x) == ring || std::abs(y) == ring;
        for (int z = -ring; z <= ring; z += on_side || ring == 0 ? 1 : 2 * ring) {
          look_at_cell(center.offsetBy(x, y, z), position);
        }
      }
    }
  }

  void look_at_cell(const Coord& cell, const Vec3d& position) {
    double squared = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double outside =
          std::max({lattice_.plane(cell[axis]) - position[axis], position[axis] - lattice_.plane(cell[axis] + 1), 0.0});
      squared += outside * outside;
    }
    if (squared >= best_) return;
    for (const std::uint32_t triangle : lattice_.triangles_in_cell(cell)) look_at_triangle(triangle, position);
  }

  void look_at_triangle(std::uint32_t triangle, const Vec3d& position) {
    const Triangle& t = lattice_.triangles()[triangle];
    const auto corner = [&](int k) { return to_vdb(lattice_.positions()[t[k]].cast<double>()); };
    openvdb::Vec3d weights;
    const openvdb::Vec3d place =
        openvdb::math::closestPointOnTriangleToPoint(corner(0), corner(1), corner(2), to_vdb(position), weights);
    const double squared = (place - to_vdb(position)).lengthSqr();
    if (!(squared < best_)) return;
    best_ = squared;
    blend_ = {{t[0], weights[0]}, {t[1], weights[1]}, {t[2], weights[2]}};
  }

  const MeshLattice& lattice_;
  double best_ = 0.0;
  VertexBlend blend_;
};

}  // namespace

void blend_filling(const MeshLattice& lattice, Patch& patch) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, patch.vertices.size(), 256),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      ClosestBlend closest(lattice);
                      for (std::size_t v = range.begin(); v != range.end(); ++v) {
                        PatchVertex& vertex = patch.vertices[v];
                        if (vertex.kind != PatchVertex::Kind::kFront) vertex.blend = closest.find(vertex.position);
                      }
                    });
}

}  // namespace particle_surface_tracker::remeshing
