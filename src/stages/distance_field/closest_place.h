#pragma once

#include <limits>
#include <vector>

#include "surface_cells.h"

namespace particle_surface_tracker {

/// A place on the isosurface.
struct ClosestPlace {
  float squared_distance;  ///< To it [cells²]; the distance is at most 0.01 cells above the smallest.
  Vec3d place;             ///< [cells]
};

/// Finds the closest place on the isosurface for single positions, whatever their distance: cells that cannot be closer
/// than what has been found, or hardly, are passed over. One object per thread.
class ClosestPlaceSearch {
 public:
  /// \param reach [cells].
  ClosestPlaceSearch(const SurfaceCells& cells, double reach)
      : cells_(cells), reach_(reach), leaf_cells_(cells.leaves().size()) {}

  /// \param position [cells].
  /// \param squared_limit no place farther than this is looked for [cells²].
  /// \return if nothing is within the reach and the limit, a squared distance of more than the reach's square or of the
  /// limit.
  ClosestPlace find(const Vec3d& position, float squared_limit = std::numeric_limits<float>::max());

 private:
  /// Where the triangles of a cell are; coordinates in cells, relative to the corner of its leaf.
  struct Disc {
    Vec3f center;
    float radius;  // they are within this of the center
    Vec3f normal;  // unit, a mean
    float height;  // they are within this of the plane through the center across the normal; negative: not made yet
  };

  /// The cells of a leaf. Most are passed over for the ball around the cell, and their disc is never made.
  struct LeafCells {
    std::vector<float> x, y, z;  // centers of the cells
    std::vector<Disc> discs;
  };

  struct NearLeaf {
    const SurfaceCells::Leaf* leaf;
    Vec3f position;          // relative to the leaf's corner
    float squared_distance;  // to its cells
  };

  void find_leaves(const openvdb::Coord& leaf_origin);
  LeafCells& cells_of(const SurfaceCells::Leaf& leaf);
  void search_leaf(const NearLeaf& near, const Vec3d& position, ClosestPlace& closest);
  Disc make_disc(std::uint32_t cell, const openvdb::Coord& leaf_origin) const;
  static float distance_to_disc(const Disc& disc, const Vec3f& offset);
  void measure(std::uint32_t cell, const Vec3d& position, ClosestPlace& closest) const;

  const SurfaceCells& cells_;
  double reach_;
  openvdb::Coord around_{1, 1, 1};                // the leaf whose surroundings are known; no leaf begins here
  std::vector<const SurfaceCells::Leaf*> found_;  // in them
  std::vector<NearLeaf> near_;
  std::vector<float> squared_;         // distances to the centers of a leaf's cells
  std::vector<LeafCells> leaf_cells_;  // of the leaves met so far, by their number
};

}  // namespace particle_surface_tracker
