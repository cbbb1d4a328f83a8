#pragma once

#include <memory>

#include "particle_surface_tracker/core/implicit_surface.h"

namespace particle_surface_tracker {

class ComponentLabels;
class FieldAtNodes;
class SurfaceCells;

/// What the topology of a mesh is compared with: φ at the nodes of Γ, and the components of φ = 0. Both are worked out
/// when they are first asked for, and then serve all stages of a frame. Not to be shared by threads.
class IsosurfaceQuery {
 public:
  /// \param surface must live as long as this.
  /// \param h Δx_Γ [m].
  /// \param cells those of the surface, where they are at hand; else they are made when distances are asked for.
  IsosurfaceQuery(const ImplicitSurface& surface, double h, std::shared_ptr<const SurfaceCells> cells = nullptr);
  ~IsosurfaceQuery();
  IsosurfaceQuery(const IsosurfaceQuery&) = delete;
  IsosurfaceQuery& operator=(const IsosurfaceQuery&) = delete;

  const ImplicitSurface& surface() const { return surface_; }
  const FieldAtNodes& field() const;
  const ComponentLabels& components() const;

 private:
  const ImplicitSurface& surface_;
  double h_;
  std::shared_ptr<const SurfaceCells> cells_;
  mutable std::unique_ptr<FieldAtNodes> field_;
  mutable std::unique_ptr<ComponentLabels> components_;
};

}  // namespace particle_surface_tracker
