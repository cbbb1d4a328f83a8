#include "particle_surface_tracker/stages/isosurface_query.h"

#include <utility>

#include "component_labels.h"
#include "field_at_nodes.h"

namespace particle_surface_tracker {

IsosurfaceQuery::IsosurfaceQuery(const ImplicitSurface& surface, double h, std::shared_ptr<const SurfaceCells> cells)
    : surface_(surface), h_(h), cells_(std::move(cells)) {}

IsosurfaceQuery::~IsosurfaceQuery() = default;

const FieldAtNodes& IsosurfaceQuery::field() const {
  if (!field_) field_ = std::make_unique<FieldAtNodes>(surface_, h_, cells_);
  return *field_;
}

const ComponentLabels& IsosurfaceQuery::components() const {
  if (!components_) components_ = std::make_unique<ComponentLabels>(surface_);
  return *components_;
}

}  // namespace particle_surface_tracker
