#pragma once

#include <cstdint>

namespace particle_surface_tracker {

/// Squared distances [cells²] of the nodes around the cells of a leaf: 16³, those of the leaf in the middle. There are
/// two of each node, so that across any lattice axis neighbours lie in a run: in the first z runs fastest and x
/// slowest, in the second y fastest and z slowest.
struct DistanceBlock {
  static constexpr int width = 16;
  static constexpr int margin = 4;  ///< Nodes before those of the leaf, and behind them.
  static constexpr int size = width * width * width;

  alignas(64) float squared[2 * size];
};

/// How patches lie in a block.
struct PatchAxes {
  int slice;                     ///< The axis that their slices lie across.
  int row, column;               ///< The axes within a slice.
  int begin;                     ///< Where the nodes they are among begin in the block.
  int slice_stride, row_stride;  ///< From a node to the next one along these axes; along the columns' it is 1.
};

/// The patches with slices across an axis.
constexpr PatchAxes patch_axes(int slice) {
  constexpr int width = DistanceBlock::width;
  if (slice == 0) return {0, 1, 2, 0, width * width, width};
  if (slice == 1) return {1, 0, 2, 0, width, width * width};
  return {2, 0, 1, DistanceBlock::size, width * width, width};
}

/// Up to 4 × 4 nodes of one slice, whose distances to a cell are computed together.
struct Patch {
  static constexpr int width = 4;

  float slice, row, column;  ///< Of the node with the smallest coordinates, relative to the cell's corner [cells].
  std::int32_t node;         ///< Its place in the block.
  std::int32_t rows;         ///< Those that are asked for; there is room for `width` of them.
};

/// The triangles of one cell as functions that are affine in the place p of a node relative to the cell's corner. A
/// face has four: the height over its plane, and on which side of the planes through its edges and along its normal p
/// is. An edge from a to b has two: where p falls on it, from 0 to 1, and |p − a|² − |p|².
struct CellFunctions {
  static constexpr int max_faces = 8;
  static constexpr int max_edges = 24;
  static constexpr int max_functions = 4 * max_faces + 2 * max_edges;

  int faces = 0;
  int edges = 0;
  /// Those of the faces first. The value at p is constant + gradient · p.
  alignas(64) float constant[max_functions];
  alignas(64) float gradient[3][max_functions];
  float squared_length[max_edges];

  int count() const { return 4 * faces + 2 * edges; }
};

/// Lowers the values of a block's nodes on some patches to the squared distances to a cell's triangles; rounding may
/// take them a little below 0.
using PatchKernel = void (*)(const CellFunctions& cell, const PatchAxes& axes, const Patch* patches, int count,
                             DistanceBlock& block);

/// The kernel for the active set of instructions.
PatchKernel active_patch_kernel();

}  // namespace particle_surface_tracker
