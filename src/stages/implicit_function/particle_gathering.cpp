#include "particle_gathering.h"

#include <algorithm>

namespace particle_surface_tracker::implicit {

namespace {

/// Wider by more than what rounding can put on the wrong side [R].
constexpr double kSlack = 1e-5;

/// Cells of one tile between two cells, as local coordinates.
struct LocalCells {
  LocalCells(const LatticeCoord& tile, const LatticeCoord& lower, const LatticeCoord& upper) {
    for (int axis = 0; axis < 3; ++axis) {
      from[axis] = std::max(lower[axis] - 8 * tile[axis], 0);
      to[axis] = std::min(upper[axis] - 8 * tile[axis], 7);
    }
  }

  int from[3];
  int to[3];
};

void append_range(std::uint32_t begin, std::uint32_t end, std::vector<WorldPoints::Range>& ranges) {
  if (begin == end) return;
  if (!ranges.empty() && ranges.back().end == begin) {
    ranges.back().end = end;
  } else {
    ranges.push_back({begin, end});
  }
}

}  // namespace

std::size_t list_particles_near(const ParticleGrid& particles, const Frame& frame, const Box& box, WorldPoints& world) {
  const double radius = 1.0 / frame.inverse_radius;
  Vec3d first;
  Vec3d last;
  for (int axis = 0; axis < 3; ++axis) {
    first[axis] = frame.origin[axis] + (box.lower[axis] - 1.0 - kSlack) * radius;
    last[axis] = frame.origin[axis] + (box.upper[axis] + 1.0 + kSlack) * radius;
  }
  const LatticeCoord lower = particles.cell_of(first);
  const LatticeCoord upper = particles.cell_of(last);
  world.x = &particles.x();
  world.y = &particles.y();
  world.z = &particles.z();
  world.ranges.clear();
  LatticeCoord t;
  for (t[0] = lower[0] >> 3; t[0] <= upper[0] >> 3; ++t[0]) {
    for (t[1] = lower[1] >> 3; t[1] <= upper[1] >> 3; ++t[1]) {
      for (t[2] = lower[2] >> 3; t[2] <= upper[2] >> 3; ++t[2]) {
        const ParticleGrid::Tile* tile = particles.find_tile(t);
        if (tile == nullptr) continue;
        const LocalCells cells(t, lower, upper);
        // Whole rows: looking at a few particles too many is cheaper than very short runs.
        for (int x = cells.from[0]; x <= cells.to[0]; ++x) {
          append_range(tile->begin[64 * x + 8 * cells.from[1]], tile->begin[64 * x + 8 * cells.to[1] + 8],
                       world.ranges);
        }
      }
    }
  }
  std::size_t count = 0;
  for (const WorldPoints::Range& range : world.ranges) count += range.end - range.begin;
  return count;
}

}  // namespace particle_surface_tracker::implicit
