#pragma once

#include <vector>

#include "surface_cells.h"

namespace particle_surface_tracker {

/// A place on the isosurface.
struct ClosestPlace {
  float squared_distance;  ///< To it [cells²].
  Vec3d place;             ///< [cells]
};

/// Finds the closest place on the isosurface for single positions, whatever their distance: cells that cannot be closer
/// than what has been found are passed over. One object per thread.
class ClosestPlaceSearch {
 public:
  /// \param reach [cells].
  ClosestPlaceSearch(const SurfaceCells& cells, double reach) : cells_(cells), reach_(reach) {}

  /// \param position [cells].
  /// \return if nothing is within reach, a squared distance of more than the reach's square.
  ClosestPlace find(const Vec3d& position);

 private:
  struct NearLeaf {
    const SurfaceCells::Leaf* leaf;
    Vec3f position;          // relative to the leaf's corner
    float squared_distance;  // to its cells
  };

  void find_leaves(const openvdb::Coord& leaf_origin);
  void measure(std::uint32_t cell, const Vec3d& position, ClosestPlace& closest) const;

  const SurfaceCells& cells_;
  double reach_;
  openvdb::Coord around_{1, 1, 1};                // the leaf whose surroundings are known; no leaf begins here
  std::vector<const SurfaceCells::Leaf*> found_;  // in them
  std::vector<NearLeaf> near_;
};

}  // namespace particle_surface_tracker
