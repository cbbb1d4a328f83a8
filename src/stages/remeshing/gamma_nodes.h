#pragma once

#include <unordered_map>
#include <vector>

#include "particle_surface_tracker/stages/mesh_lattice.h"

namespace particle_surface_tracker::remeshing {

/// Γ at its nodes: what topology matching made of it, and the signed distance of the mesh elsewhere.
class GammaNodes {
 public:
  /// \param nodes where Γ was given a new value, sorted; \param gamma the values [m], negative inside.
  GammaNodes(const MeshLattice& lattice, const std::vector<openvdb::Coord>& nodes, const std::vector<float>& gamma);

  const MeshLattice& lattice() const { return lattice_; }

  /// Nodes that are inside by the mesh and outside by the new Γ, or the other way round; sorted.
  const std::vector<openvdb::Coord>& changed() const { return changed_; }
  bool has_changed(const openvdb::Coord& node) const;

  bool is_inside(const openvdb::Coord& node);

  /// True where topology matching gave a value.
  bool is_matched(const openvdb::Coord& node) const;

  /// Corners of a cell that are inside, as bits.
  unsigned inside_corners(const openvdb::Coord& cell);

  /// Makes sure that value() knows these nodes; in any order, also more than once.
  void measure(std::vector<openvdb::Coord> nodes);

  /// Γ at a node that was measured [m]; its sign is that of is_inside(), also where the distance is 0.
  double value(const openvdb::Coord& node) const { return values_.at(node); }

 private:
  const MeshLattice& lattice_;
  const std::vector<openvdb::Coord>& nodes_;
  const std::vector<float>& gamma_;
  std::vector<openvdb::Coord> changed_;
  std::unordered_map<openvdb::Coord, bool> inside_;
  std::unordered_map<openvdb::Coord, double> values_;
};

}  // namespace particle_surface_tracker::remeshing
