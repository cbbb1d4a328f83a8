#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// The connected components of a mesh, numbered in the order of their lowest vertex.
struct VertexComponents {
  std::vector<std::uint32_t> of_vertex;
  std::size_t count = 0;
};

/// Finds what triangles connect. A vertex that none of them uses is a component of its own.
VertexComponents vertex_components(std::size_t vertex_count, const std::vector<Triangle>& triangles);

}  // namespace particle_surface_tracker
