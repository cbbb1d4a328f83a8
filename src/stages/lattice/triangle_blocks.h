#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include <oneapi/tbb/parallel_for.h>

#include "lattice_mesh.h"

namespace particle_surface_tracker {

/// Triangles that are worked on together; their results are put together in this order, whoever makes them.
constexpr std::size_t kTrianglesPerBlock = 2048;

inline std::size_t triangle_block_count(const LatticeMesh& mesh) {
  return (mesh.triangles->size() + kTrianglesPerBlock - 1) / kTrianglesPerBlock;
}

/// Calls task(block, first triangle, last triangle + 1) for every block, several at a time.
template <typename Task>
void for_triangle_blocks(const LatticeMesh& mesh, Task&& task) {
  tbb::parallel_for(std::size_t{0}, triangle_block_count(mesh), [&](std::size_t block) {
    const std::size_t begin = block * kTrianglesPerBlock;
    const std::size_t end = std::min(begin + kTrianglesPerBlock, mesh.triangles->size());
    task(block, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end));
  });
}

}  // namespace particle_surface_tracker
