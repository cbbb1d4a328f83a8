#pragma once

#include <array>
#include <cstdint>

namespace particle_surface_tracker {

/// Vertices whose steps toward φ = 0 are made together, one per lane: a step of one vertex is a long chain of dependent
/// operations, of many the same chain in wide registers.
struct TricubicBatch {
  static constexpr int lanes = 16;
  using Lanes = std::array<float, lanes>;

  alignas(64) std::array<Lanes, 64> nodes;  ///< φ [m] at the 4 × 4 × 4 nodes around each vertex; x slowest, z fastest.
  alignas(64) std::array<Lanes, 3> place;  ///< Within the cell: 0 at the second, 1 at the third of four nodes.

  alignas(64) Lanes value;                    ///< φ [m], out.
  alignas(64) std::array<Lanes, 3> gradient;  ///< ∇φ [m per cell], out.
  alignas(64) Lanes slope;                    ///< |∇φ| [m per cell], out.
  alignas(64) std::array<Lanes, 3> next;      ///< The place after a step along −∇φ/|∇φ|, within its cell, out.
  alignas(64) std::array<std::array<std::int32_t, lanes>, 3> cells;  ///< By how many cells it is farther, out.
};

/// How far a step goes.
struct StepLength {
  float far;         ///< Over φ: ε over Δx_φ [1/m].
  float near;        ///< The same where |φ| is small [1/m].
  float near_until;  ///< |φ| up to which it is [m].
};

/// Cubic interpolation (Catmull–Rom along each axis) and one step for every lane of a batch (Sec. 5.2).
using TricubicKernel = void (*)(TricubicBatch& batch, const StepLength& step_length);

/// The kernel for the active set of instructions.
TricubicKernel active_tricubic_kernel();

}  // namespace particle_surface_tracker
