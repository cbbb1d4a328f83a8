#pragma once

#include <memory>
#include <vector>

#include <openvdb/Types.h>

#include "line_signs.h"
#include "particle_surface_tracker/core/implicit_surface.h"
#include "stages/distance_field/surface_cells.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// φ at nodes of Γ, by linear interpolation between the nodes of φ's own lattice (Alg. 1). Its sign is right anywhere.
/// Not to be shared by threads.
class FieldAtNodes {
 public:
  /// \param surface must live as long as this.
  /// \param h Δx_Γ [m].
  /// \param cells those of the surface, or null: then they are made when distances are asked for.
  FieldAtNodes(const ImplicitSurface& surface, double h, std::shared_ptr<const SurfaceCells> cells = nullptr);

  /// The sides of φ's own nodes.
  const LineSigns& signs() const { return signs_; }

  /// The nodes of a set where φ < 0.
  NodeMasks liquid(const NodeMasks& set) const;

  /// \param reach beyond this φ is ±reach [m].
  /// \return φ [m], one per node.
  std::vector<float> distances(const std::vector<openvdb::Coord>& nodes, double reach) const;

 private:
  const ImplicitSurface& surface_;
  double h_;
  LineSigns signs_;
  mutable std::shared_ptr<const SurfaceCells> cells_;  // sides can be had without
};

}  // namespace particle_surface_tracker
