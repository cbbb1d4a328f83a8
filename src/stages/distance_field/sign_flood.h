#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "stages/nodes/leaf_masks.h"

namespace particle_surface_tracker {

/// The nodes of a leaf whose signs are carried to its neighbours.
struct SignLeaf {
  std::array<std::uint32_t, 6> neighbors{};  ///< Leaves at −x, +x, −y, +y, −z, +z, or LeafIndex::none.
  LeafWords unknown{};                       ///< Nodes that a sign may reach.
  LeafWords inside{};                        ///< Nodes that are known to be negative.
  LeafWords outside{};                       ///< Nodes that are known to be positive.
};

/// Carries signs along lattice edges until no unknown node has a known neighbour. What is reached does not depend on
/// the order as long as no unknown node is connected to both signs.
void flood_signs(std::vector<SignLeaf>& leaves);

}  // namespace particle_surface_tracker
