#include "particle_surface_tracker/stages/isosurface_query.h"

#include "component_labels.h"
#include "field_at_nodes.h"

namespace particle_surface_tracker {

IsosurfaceQuery::IsosurfaceQuery(const ImplicitSurface& surface, double h) : surface_(surface), h_(h) {}

IsosurfaceQuery::~IsosurfaceQuery() = default;

const FieldAtNodes& IsosurfaceQuery::field() const {
  if (!field_) field_ = std::make_unique<FieldAtNodes>(surface_, h_);
  return *field_;
}

const ComponentLabels& IsosurfaceQuery::components() const {
  if (!components_) components_ = std::make_unique<ComponentLabels>(surface_);
  return *components_;
}

}  // namespace particle_surface_tracker
