#pragma once

#include <cstdint>

#include "cell_shape.h"
#include "cell_tube.h"

namespace particle_surface_tracker {

/// A node around a leaf as one number: 5 bits for each of its coordinates from the leaf's corner, plus 8; x highest.
constexpr int kCodeBits = 5;
constexpr int kCodeOffset = 8;

/// Nodes around the leaf along each axis whose distances its cells may lower: less than half a leaf to either side, so
/// that leaves two apart share none.
constexpr int kFirstAround = -4;
constexpr int kLastAround = 11;

/// Scratch: nodes, and what is read or written beyond the end of the list.
struct NodeList {
  static constexpr int most = 16 * 16 * 16;
  alignas(64) std::int32_t code[most + 16];
  int size = 0;
};

/// Where the squared distances of the nodes around a leaf are [cells²]: in leaves of 8³, z fastest, all in one array.
/// The leaf (i, j, k) from the one in the middle begins at the entry of 9 (i + 1) + 3 (j + 1) + k + 1.
struct LeafTargets {
  static constexpr int size = 3 * 3 * 3;
  static constexpr std::int32_t unwanted = -1;  ///< Where no node of a leaf is wanted.
  alignas(64) std::int32_t begin[32];           ///< `size` of them; whole registers are read.
  float* squared;
};

/// Lowers the squared distances of the nodes in a cell's tube to those to the cell's triangles.
using CellKernel = void (*)(const CellShape& shape, const CellTube& tube, NodeList& list, const LeafTargets& targets);

/// The kernel for the active set of instructions.
CellKernel active_cell_kernel();

}  // namespace particle_surface_tracker
