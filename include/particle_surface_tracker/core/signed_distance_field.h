#pragma once

#include <openvdb/openvdb.h>

namespace particle_surface_tracker {

/// φ: signed distance to the isosurface on the world-anchored lattice of Δx_φ, negative inside (Sec. 5.1).
///
/// Only the nodes that were asked for are there (the active ones). All others, in the same leaf or not, hold `absent`,
/// so that an interpolation that touches one is far outside the reach and can be recognised without looking at masks.
struct SignedDistanceField {
  static constexpr float absent = 1e30f;

  double dx = 0.0;              ///< Δx_φ [m].
  double reach = 0.0;           ///< Largest |φ| that is stored [m].
  openvdb::FloatGrid::Ptr phi;  ///< [m]; node (i, j, k) is at dx · (i, j, k).
};

}  // namespace particle_surface_tracker
