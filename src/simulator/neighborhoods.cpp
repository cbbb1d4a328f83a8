#include "neighborhoods.h"

#include <cmath>

#include "wall_profile.h"

namespace particle_surface_tracker::simulator {

void Neighborhoods::find(const ParticleGrid& grid) {
  ranges_.resize(grid.size());
  blocks_.resize(block_count(grid.size()));
  for_each_block(grid.size(), [&](std::size_t block, std::size_t begin, std::size_t end) {
    std::vector<Neighbor>& found = blocks_[block];
    found.clear();
    for (std::size_t i = begin; i < end; ++i) {
      ranges_[i].begin = static_cast<std::uint32_t>(found.size());
      append(grid, i, found);
      ranges_[i].end = static_cast<std::uint32_t>(found.size());
    }
  });
}

void Neighborhoods::append(const ParticleGrid& grid, std::size_t particle, std::vector<Neighbor>& found) const {
  const float x = grid.x()[particle];
  const float y = grid.y()[particle];
  const float z = grid.z()[particle];
  const auto squared_radius = static_cast<float>(kernel_.radius() * kernel_.radius());
  const LatticeCoord cell = grid.cell_of(Vec3d(x, y, z));
  const LatticeCoord lower = {cell[0] - 1, cell[1] - 1, cell[2] - 1};
  const LatticeCoord upper = {cell[0] + 1, cell[1] + 1, cell[2] + 1};
  grid.for_each_range(lower, upper, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t j = begin; j < end; ++j) {
      const Vec3f offset(x - grid.x()[j], y - grid.y()[j], z - grid.z()[j]);
      const float squared = offset.x() * offset.x() + offset.y() * offset.y() + offset.z() * offset.z();
      if (!(squared < squared_radius) || j == particle) continue;
      const auto slope = static_cast<float>(volume_ * kernel_.slope(std::sqrt(squared)));
      // Particles at the same place do not drag each other: nothing says in which direction.
      const float drag = squared > 0.0F ? static_cast<float>(-viscosity_factor) * slope / squared : 0.0F;
      found.push_back({j, offset, slope, drag});
    }
  });
}

}  // namespace particle_surface_tracker::simulator
