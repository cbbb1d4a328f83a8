#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace particle_surface_tracker::implicit {

/// Positions as one array per coordinate. The arrays are longer than `size` by what the widest variant reads or writes
/// beyond the end.
struct Points {
  std::vector<float> x, y, z;
  std::size_t size = 0;

  /// Makes room for `count` points and keeps those that are there.
  void reserve(std::size_t count);
};

/// Some runs of points of three arrays of coordinates [m].
struct WorldPoints {
  struct Range {
    std::uint32_t begin, end;
  };

  const std::vector<float>* x;
  const std::vector<float>* y;
  const std::vector<float>* z;
  std::vector<Range> ranges;
};

/// Where the coordinates that the kernel works with come from: (p − origin) / R.
struct Frame {
  double origin[3];       ///< [m]
  double inverse_radius;  ///< 1 / R [1/m].
};

/// An axis-aligned box [R].
struct Box {
  float lower[3];
  float upper[3];
};

/// A ball [R].
struct Ball {
  float center[3];
  float radius;
};

/// The corners of a cube of 2 × 2 × 2 nodes. They share most of their particles and of their differences to them.
struct Cube {
  float x[2];  ///< The two coordinates of the corners along x [R], and so on.
  float y[2];
  float z[2];
  std::uint32_t requested;  ///< Bit 4 i + 2 j + k for the corner at x[i], y[j], z[k].
};

/// Sums over the particles around a node: of k, k d, g d and g d⊗d, where d = (p − x) / R, k = (1 − d²)³ and
/// g = (1 − d²)².
enum Sum { kK, kKx, kKy, kKz, kGx, kGy, kGz, kGxx, kGyy, kGzz, kGxy, kGxz, kGyz, kSums };

/// Parts that every sum is added up in, each over every 16th particle: the lanes of the widest registers. Every variant
/// keeps to them, so that all give the same bytes.
constexpr int kSumLanes = 16;

struct NodeSums {
  alignas(64) float lanes[kSums][kSumLanes];
};

/// Nodes whose sums become values together: a multiple of eight.
constexpr int kBatchSize = 16;

/// What turns sums over particles into φ̃.
struct KernelConstants {
  double influence_radius;  ///< R [m].
  double surface_radius;    ///< r̄ [m].
  double eigenvalue_high;   ///< t_high.
  double eigenvalue_scale;  ///< 1 / (t_high − t_low).
  double outside;           ///< φ̃ where no particle is within R [m].
};

/// The loops that take nearly all of the time, compiled for one set of instructions.
struct Kernel {
  /// Converts points [m] to a frame and keeps those nearer than R to a box, in their order, padded. There must be room.
  void (*localize)(const WorldPoints& world, const Frame& frame, const Box& box, Points& kept);

  /// Keeps those of some padded points [R] that are nearer than R to a box, in their order, padded.
  void (*select_near)(const Points& points, const Box& box, Points& kept);

  /// Keeps those of some padded points [R] that are in a ball, in their order, padded.
  void (*select_in)(const Points& points, const Ball& ball, Points& kept);

  /// The sums of the requested corners of a cube, in the order of their bits, over padded points [R].
  void (*accumulate)(const Points& points, const Cube& cube, NodeSums* const* sums);

  /// φ̃ from the sums of nodes [m].
  void (*finish)(const NodeSums (&nodes)[kBatchSize], const KernelConstants& constants, float (&values)[kBatchSize]);
};

/// The loops for the active set of instructions.
const Kernel& active_kernel();

}  // namespace particle_surface_tracker::implicit
