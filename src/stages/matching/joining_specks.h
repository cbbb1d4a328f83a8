#pragma once

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

#include "component_labels.h"
#include "particle_surface_tracker/core/types.h"
#include "particle_surface_tracker/core/vertex_components.h"

namespace particle_surface_tracker {

/// Specks of φ = 0 through which a piece of the mesh leads from one body to another. A speck alone may come and go, but
/// bodies that have come apart must not hang together by one.
class JoiningSpecks {
 public:
  /// \param triangles those with corners at different components of φ = 0.
  /// \param pieces of the mesh.
  /// \param components of φ = 0.
  /// \param labels the component of φ = 0 of every vertex.
  JoiningSpecks(const std::vector<Triangle>& triangles, const VertexComponents& pieces,
                const ComponentLabels& components, const std::vector<std::int32_t>& labels);

  /// \param piece component of the mesh.
  bool contain(std::uint32_t piece, std::int32_t label) const { return joining_.count({piece, label}) > 0; }

 private:
  std::set<std::pair<std::uint32_t, std::int32_t>> joining_;
};

}  // namespace particle_surface_tracker
