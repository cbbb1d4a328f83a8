#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "affine_motion.h"

namespace particle_surface_tracker {

/// The particles that matter to a group of vertices: those near a box around them.
struct GroupBox {
  std::array<float, 3> origin;  ///< Of the group, in the coordinates of the particles [m].
  std::array<float, 3> lower;   ///< Relative to the origin [m].
  std::array<float, 3> upper;
  float squared_reach;  ///< Particles nearer to the box than its root are near [m²].
};

/// Particles and their displacements, one array per coordinate [m].
struct MotionArrays {
  std::array<const float*, 3> position;
  std::array<const float*, 3> displacement;
  std::size_t size;
};

/// Particles near a group of vertices, one array per number. The arrays have room for as many numbers more as there are
/// lanes.
struct NearParticles {
  std::array<float*, 3> position;      ///< Relative to the group's origin [m].
  std::array<float*, 3> displacement;  ///< Minus the group's reference [m].
  float* squared_displacement;         ///< |displacement|² [m²].
};

/// Vertices whose motion is found together, one per lane. Every lane is as if it were alone.
struct MotionBatch {
  static constexpr int lanes = 16;
  using Lanes = std::array<float, lanes>;

  int used = 0;                               ///< Lanes from 0 that hold a vertex.
  alignas(64) std::array<Lanes, 3> vertex{};  ///< Relative to the group's origin [m].

  alignas(64) std::array<Lanes, MotionSums::size> sums;   ///< Out: as in MotionSums.
  alignas(64) std::array<std::int32_t, lanes> neighbors;  ///< Out: particles with a weight.

  alignas(64) std::array<Lanes, 3> average;              ///< Out: ū [m].
  alignas(64) std::array<Lanes, 3> correction;           ///< Out: what the fit adds to the average at the vertex [m].
  alignas(64) Lanes squared_misfit;                      ///< Out: without the settling factor [m²].
  alignas(64) std::array<std::int32_t, lanes> is_plain;  ///< Out: −1 where the fit needs no more care, else 0.
};

/// Bounds of the plain case.
struct PlainFit {
  float smallest_variance;         ///< The particles must spread by more than this in all directions [m²].
  float largest_squared_gradient;  ///< Squared Frobenius norm of A up to which no stretch can be beyond its bound.
};

/// Numbers that MotionKernel::sum() keeps for each particle: its weight and the weighted offset, for all lanes.
constexpr std::size_t kWeightNumbers = 4 * MotionBatch::lanes;

/// All for one set of instructions.
struct MotionKernel {
  /// Appends those of the particles [begin, end) that are near a box, in their order, with their displacements as they
  /// are.
  /// \param near holds `count` so far and has room for as many more as there are particles.
  /// \return how many it holds then.
  std::size_t (*gather)(const MotionArrays& particles, std::size_t begin, std::size_t end, const GroupBox& box,
                        const NearParticles& near, std::size_t count);

  /// Subtracts a reference from the displacements, and squares them.
  void (*refer)(const std::array<float, 3>& reference, const NearParticles& near, std::size_t count);

  /// Sums over the particles, weighted by poly6 without its constant, which cancels.
  /// \param weights scratch for kWeightNumbers values per particle.
  void (*sum)(const NearParticles& particles, std::size_t count, float inverse_squared_radius, float* weights,
              MotionBatch& batch);

  /// The fit of docs/advection.md from the sums, where the particles spread in all directions and no bound is met.
  void (*fit)(const PlainFit& bounds, MotionBatch& batch);
};

/// The kernel for the active set of instructions.
const MotionKernel& active_motion_kernel();

}  // namespace particle_surface_tracker
