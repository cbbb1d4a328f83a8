#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "stages/nodes/leaf_index.h"
#include "stages/nodes/leaf_masks.h"

namespace particle_surface_tracker {

/// How often a closed surface winds around nodes of a lattice, however far they are from it: counted along the lattice
/// lines in the direction of z, from where it is 0. Enclosed air is outside, as nothing is flooded.
class LineSigns {
 public:
  /// Between a node and the next one along z the winding number changes.
  struct Crossing {
    openvdb::Coord node;
    int step;
  };

  /// \param crossings in any order.
  explicit LineSigns(const std::vector<Crossing>& crossings);

  /// What is known of the 8³ nodes of a leaf.
  struct Leaf {
    LeafWords inside{};   ///< The winding number is at least 1.
    LeafWords tangled{};  ///< It is neither 0 nor 1.
  };
  Leaf leaf(const openvdb::Coord& origin) const;

 private:
  static constexpr int kRows = 64;

  /// The lines through a leaf, 8x + y: where their crossings begin.
  using Column = std::array<std::uint32_t, kRows + 1>;

  LeafIndex index_;
  std::vector<Column> columns_;
  std::vector<std::int32_t> places_;    // z of the node before each crossing
  std::vector<std::int32_t> windings_;  // winding number behind it
};

/// Of the mesh, on the lattice of Γ.
LineSigns make_mesh_signs(const MeshLattice& lattice);

/// Of the isosurface, on the lattice of φ: 1 inside and 0 outside.
LineSigns make_field_signs(const ImplicitSurface& surface);

}  // namespace particle_surface_tracker
