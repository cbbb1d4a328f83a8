#pragma once

#include <cstddef>
#include <memory>

namespace particle_surface_tracker {

/// Squared distances of the nodes of some leaves of 8³ [cells²], z fastest. All are in one array, so that a register of
/// them can be read and written at once, whatever leaves they are in.
class SquaredDistances {
 public:
  static constexpr std::size_t leaf_size = 512;

  /// All distances are SignedDistanceField::absent.
  explicit SquaredDistances(std::size_t leaf_count);

  float* data() { return values_.get(); }
  float* leaf(std::size_t n) { return values_.get() + n * leaf_size; }
  const float* leaf(std::size_t n) const { return values_.get() + n * leaf_size; }

 private:
  std::unique_ptr<float[]> values_;
};

}  // namespace particle_surface_tracker
