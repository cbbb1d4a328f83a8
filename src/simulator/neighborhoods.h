#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "kernel.h"
#include "parallel_blocks.h"
#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker::simulator {

/// One particle within the kernel's radius of another.
struct Neighbor {
  std::uint32_t index;
  Vec3f offset;  ///< From it to the particle [m].
  float slope;   ///< slope · offset is the gradient of its share of the particle's relative density [1/m²].
  float drag;    ///< drag · offset offsetᵀ is its drag per viscosity (Monaghan 2005, Eq. 4.2) [1/m⁴].
};

/// The neighbours of every particle, without itself. What two particles are to each other is equal and opposite to the
/// last bit, which is what conserves momentum.
class Neighborhoods {
 public:
  /// \param volume of a particle at rest [m³].
  Neighborhoods(const Kernel& kernel, double volume) : kernel_(kernel), volume_(volume) {}

  const Kernel& kernel() const { return kernel_; }
  double volume() const { return volume_; }

  /// \param grid of cells as large as the kernel's radius. Particles are named by their places in it.
  void find(const ParticleGrid& grid);

  std::size_t size() const { return ranges_.size(); }

  struct Range {
    const Neighbor* first;
    const Neighbor* last;
    const Neighbor* begin() const { return first; }
    const Neighbor* end() const { return last; }
  };

  /// The neighbours of one particle, in the order of the grid. Valid until find().
  Range of(std::size_t particle) const {
    const Neighbor* found = blocks_[particle / block_size].data();
    return {found + ranges_[particle].begin, found + ranges_[particle].end};
  }

 private:
  struct Places {
    std::uint32_t begin, end;  // In the particle's block.
  };

  void append(const ParticleGrid& grid, std::size_t particle, std::vector<Neighbor>& found) const;

  Kernel kernel_;
  double volume_;
  std::vector<std::vector<Neighbor>> blocks_;  // Each is filled by one task and keeps its memory.
  std::vector<Places> ranges_;
};

}  // namespace particle_surface_tracker::simulator
