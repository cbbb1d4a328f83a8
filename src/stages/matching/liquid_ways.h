#pragma once

#include <vector>

#include <openvdb/Types.h>

#include "field_at_nodes.h"
#include "line_signs.h"
#include "particle_surface_tracker/stages/mesh_query.h"

namespace particle_surface_tracker {

/// The nodes of a piece of mesh.
struct PieceNodes {
  std::vector<openvdb::Coord> all;    ///< At its surface, and those that it encloses; sorted.
  std::vector<openvdb::Coord> start;  ///< Of these: where ways to the rest of the mesh begin.
};

/// Finds the ways from liquid that the mesh does not hold to liquid that it does.
class LiquidWays {
 public:
  using Nodes = std::vector<openvdb::Coord>;

  LiquidWays(const MeshQuery& mesh, const FieldAtNodes& field)
      : lattice_(mesh.lattice()), mesh_(mesh.signs()), field_(field) {}

  /// \param cells that a piece of mesh is in.
  PieceNodes nodes_of(const Nodes& cells) const;

  /// Nodes of φ < 0 on the shortest ways from some nodes to the inside of the mesh, both ends included; none where it
  /// is not near. A way goes along lattice edges: the triangulation keeps nodes apart that only share a face or a cell.
  /// \param first sorted.
  /// \param longest [lattice edges].
  Nodes from(const Nodes& first, int longest) const;

  /// The ways from each of many sets of nodes, together: what from() finds for each. The liquid around them is walked
  /// through once, so that a block of new liquid costs no more than its size.
  /// \param starts all of them outside the mesh.
  Nodes from_each(const std::vector<Nodes>& starts, int longest) const;

 private:
  /// Nodes that one part of the mesh encloses.
  struct Body {
    Nodes nodes;           ///< In a box.
    bool goes_on = false;  ///< Whether there are more beyond it.
  };

  Body body_at(const openvdb::Coord& first, const openvdb::CoordBBox& box, NodeMasks& seen) const;
  bool is_inside(const openvdb::Coord& node) const;

  const MeshLattice& lattice_;
  const LineSigns& mesh_;
  const FieldAtNodes& field_;
};

}  // namespace particle_surface_tracker
