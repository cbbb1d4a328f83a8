#include "field_sampler.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <tbb/parallel_for.h>

#include "particle_gathering.h"

namespace particle_surface_tracker::implicit {

namespace {

/// A cube of 2 × 2 × 2 nodes of a block with requested ones among them: the place of its first node in the block (64 x
/// + 8 y + z), and the coordinates of that node from the first node of the unit of work.
struct LocalCube {
  std::uint16_t place;
  std::uint8_t x, y, z;
  std::uint8_t requested;  ///< As in Cube.
};

/// Cubes that share a list of particles: those in a cube of 4 × 4 × 4 nodes of one block.
struct Part {
  std::uint32_t block;
  std::size_t begin, end;
};

/// A node and the block it is in.
struct Target {
  std::uint32_t block;
  std::uint16_t place;
};

/// The first nodes of the cubes of a block (64 x + 8 y + z); runs of eight make up cubes of 4 × 4 × 4 nodes.
constexpr std::array<std::uint16_t, 64> make_curve() {
  std::array<std::uint16_t, 64> curve = {};
  for (int n = 0; n < 64; ++n) {
    const int x = 2 * ((n >> 2) & 1) + 4 * ((n >> 5) & 1);
    const int y = 2 * ((n >> 1) & 1) + 4 * ((n >> 4) & 1);
    const int z = 2 * (n & 1) + 4 * ((n >> 3) & 1);
    curve[n] = static_cast<std::uint16_t>(64 * x + 8 * y + z);
  }
  return curve;
}

constexpr std::array<std::uint16_t, 64> kCurve = make_curve();

/// Bit 4 i + 2 j + k is set where node (i, j, k) of the cube at a place is in a set.
std::uint8_t cube_bits(const NodeMask& nodes, int place) {
  const auto square = [&](int slice) {
    const std::uint64_t bits = (nodes[slice] >> (place & 63)) & 0x303;
    return static_cast<unsigned>(bits | (bits >> 6)) & 0xF;
  };
  return static_cast<std::uint8_t>(square(place >> 6) | (square((place >> 6) + 1) << 4));
}

/// The smallest box around nodes, in steps of the lattice.
struct NodeBox {
  std::array<int, 3> lower = {255, 255, 255};
  std::array<int, 3> upper = {0, 0, 0};

  void extend(const LocalCube& cube) {
    constexpr std::array<int, 3> kUpperNodes = {0xF0, 0xCC, 0xAA};
    const std::array<int, 3> first = {cube.x, cube.y, cube.z};
    for (int axis = 0; axis < 3; ++axis) {
      const bool has_lower = (cube.requested & ~kUpperNodes[axis]) != 0;
      const bool has_upper = (cube.requested & kUpperNodes[axis]) != 0;
      lower[axis] = std::min(lower[axis], has_lower ? first[axis] : first[axis] + 1);
      upper[axis] = std::max(upper[axis], has_upper ? first[axis] + 1 : first[axis]);
    }
  }

  void extend(const NodeBox& box) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], box.lower[axis]);
      upper[axis] = std::max(upper[axis], box.upper[axis]);
    }
  }

  /// \param step of the lattice [R].
  Box times(double step) const {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      box.lower[axis] = static_cast<float>(lower[axis] * step);
      box.upper[axis] = static_cast<float>(upper[axis] * step);
    }
    return box;
  }

  /// Holds all that is nearer than R to the nodes. Not much more if they are few: and who is in a ball is told faster
  /// than who is near a box.
  Ball ball_around(double step) const {
    Ball ball;
    double squared_diagonal = 0.0;
    for (int axis = 0; axis < 3; ++axis) {
      const double width = (upper[axis] - lower[axis]) * step;
      ball.center[axis] = static_cast<float>(lower[axis] * step + 0.5 * width);
      squared_diagonal += width * width;
    }
    ball.radius = static_cast<float>(1.0 + 0.5 * std::sqrt(squared_diagonal));
    return ball;
  }
};

NodeBox box_around(const std::vector<LocalCube>& cubes, std::size_t begin, std::size_t end) {
  NodeBox box;
  for (std::size_t n = begin; n < end; ++n) box.extend(cubes[n]);
  return box;
}

Cube make_cube(const LocalCube& local, double step) {
  const auto at = [step](int n) { return static_cast<float>(n * step); };
  return {
      {at(local.x), at(local.x + 1)}, {at(local.y), at(local.y + 1)}, {at(local.z), at(local.z + 1)}, local.requested};
}

}  // namespace

struct FieldSampler::Scratch {
  WorldPoints world;
  Points near_unit;
  Points near_block;
  Points near_part;
  Points near_cube;
  std::vector<LocalCube> cubes;  ///< Part after part.
  std::vector<Part> parts;
  std::array<NodeSums[kBatchSize], 2> sums = {};  ///< Of the batch being filled, and of what did not fit into it.
  std::array<Target, 2 * kBatchSize> targets;
  std::size_t pending = 0;  ///< Nodes listed in `targets` so far, modulo its size.

  void list_requested_cubes(const NodeBlock& block, std::uint32_t index, const LatticeCoord& origin);

  /// End of the parts that are in one block with a part.
  std::size_t end_of_block(std::size_t part) const;

  NodeBox box_around_parts(std::size_t first, std::size_t last) const {
    return box_around(cubes, parts[first].begin, parts[last - 1].end);
  }
};

std::size_t FieldSampler::Scratch::end_of_block(std::size_t part) const {
  std::size_t end = part + 1;
  while (end < parts.size() && parts[end].block == parts[part].block) ++end;
  return end;
}

void FieldSampler::Scratch::list_requested_cubes(const NodeBlock& block, std::uint32_t index,
                                                 const LatticeCoord& origin) {
  const std::array<int, 3> offset = {8 * (block.coord[0] - origin[0]), 8 * (block.coord[1] - origin[1]),
                                     8 * (block.coord[2] - origin[2])};
  for (int first = 0; first < 64; first += 8) {
    const std::size_t begin = cubes.size();
    for (int n = first; n < first + 8; ++n) {
      const int place = kCurve[n];
      const std::uint8_t requested = cube_bits(block.requested, place);
      if (requested == 0) continue;
      cubes.push_back({kCurve[n], static_cast<std::uint8_t>(offset[0] + (place >> 6)),
                       static_cast<std::uint8_t>(offset[1] + ((place >> 3) & 7)),
                       static_cast<std::uint8_t>(offset[2] + (place & 7)), requested});
    }
    if (cubes.size() != begin) parts.push_back({index, begin, cubes.size()});
  }
}

FieldSampler::FieldSampler(const ParticleGrid& particles, const Parameters& parameters)
    : particles_(particles), kernel_(active_kernel()) {
  const double r = parameters.particle_spacing;
  constants_.influence_radius = parameters.influence_radius * r;
  constants_.surface_radius = parameters.surface_radius * r;
  constants_.eigenvalue_high = parameters.eigenvalue_high;
  constants_.eigenvalue_scale = 1.0 / (parameters.eigenvalue_high - parameters.eigenvalue_low);
  constants_.outside = constants_.influence_radius;
}

void FieldSampler::evaluate(NodeLattice& lattice, const std::vector<std::uint32_t>& blocks, double spacing) const {
  // Work comes in units about R wide that share one list of particles: one block, or 2 × 2 × 2 blocks.
  const int shift = 8.0 * spacing > constants_.influence_radius ? 0 : 1;
  std::vector<std::pair<LatticeCoord, std::uint32_t>> order;
  order.reserve(blocks.size());
  for (const std::uint32_t index : blocks) {
    const LatticeCoord& coord = lattice.blocks()[index].coord;
    order.push_back({{coord[0] >> shift, coord[1] >> shift, coord[2] >> shift}, index});
  }
  std::sort(order.begin(), order.end());
  std::vector<std::size_t> begin;
  for (std::size_t n = 0; n < order.size(); ++n) {
    if (n == 0 || order[n].first != order[n - 1].first) begin.push_back(n);
  }
  begin.push_back(order.size());

  tbb::parallel_for(std::size_t{0}, begin.size() - 1, [&](std::size_t unit) {
    thread_local Scratch scratch;
    scratch.cubes.clear();
    scratch.parts.clear();
    const LatticeCoord& coord = order[begin[unit]].first;
    const int width = 1 << shift;
    const LatticeCoord origin = {coord[0] * width, coord[1] * width, coord[2] * width};
    for (std::size_t n = begin[unit]; n < begin[unit + 1]; ++n) {
      scratch.list_requested_cubes(lattice.blocks()[order[n].second], order[n].second, origin);
    }
    evaluate_unit(lattice, origin, spacing, scratch);
  });
}

void FieldSampler::evaluate_unit(NodeLattice& lattice, const LatticeCoord& origin, double spacing,
                                 Scratch& scratch) const {
  const double width = 8.0 * spacing;
  const Frame frame = {{width * origin[0], width * origin[1], width * origin[2]}, 1.0 / constants_.influence_radius};
  const double step = spacing / constants_.influence_radius;
  const Box box = box_around(scratch.cubes, 0, scratch.cubes.size()).times(step);
  scratch.near_unit.reserve(list_particles_near(particles_, frame, box, scratch.world));
  kernel_.localize(scratch.world, frame, box, scratch.near_unit);
  for (std::size_t first = 0, last; first < scratch.parts.size(); first = last) {
    last = scratch.end_of_block(first);
    kernel_.select_near(scratch.near_unit, scratch.box_around_parts(first, last).times(step), scratch.near_block);
    for (std::size_t p = first; p < last; ++p) {
      const Part& part = scratch.parts[p];
      kernel_.select_in(scratch.near_block, box_around(scratch.cubes, part.begin, part.end).ball_around(step),
                        scratch.near_part);
      for (std::size_t n = part.begin; n < part.end; ++n) {
        kernel_.select_in(scratch.near_part, box_around(scratch.cubes, n, n + 1).ball_around(step), scratch.near_cube);
        evaluate_cube(lattice, part.block, make_cube(scratch.cubes[n], step), scratch.cubes[n].place, scratch);
      }
    }
  }
  if (scratch.pending % kBatchSize != 0) finish_batch(lattice, scratch.pending, scratch);
  scratch.pending = 0;
}

void FieldSampler::evaluate_cube(NodeLattice& lattice, std::uint32_t block, const Cube& cube, int place,
                                 Scratch& scratch) const {
  std::array<NodeSums*, 8> sums;
  const std::size_t begin = scratch.pending;
  std::size_t end = begin;
  for (std::uint32_t nodes = cube.requested; nodes != 0; nodes &= nodes - 1, ++end) {
    const int node = __builtin_ctz(nodes);
    const std::size_t slot = end % (2 * kBatchSize);
    scratch.targets[slot] = {block,
                             static_cast<std::uint16_t>(place + 64 * (node >> 2) + 8 * ((node >> 1) & 1) + (node & 1))};
    sums[end - begin] = &scratch.sums[slot / kBatchSize][slot % kBatchSize];
  }
  kernel_.accumulate(scratch.near_cube, cube, sums.data());
  scratch.pending = end;
  const std::size_t full = end / kBatchSize * kBatchSize;
  if (full > begin) finish_batch(lattice, full, scratch);
}

void FieldSampler::finish_batch(NodeLattice& lattice, std::size_t end, Scratch& scratch) const {
  const std::size_t begin = (end - 1) / kBatchSize * kBatchSize;
  float values[kBatchSize];
  kernel_.finish(scratch.sums[begin / kBatchSize % 2], constants_, values);
  for (std::size_t n = begin; n < end; ++n) {
    const Target& target = scratch.targets[n % (2 * kBatchSize)];
    lattice.blocks()[target.block].accept_value(target.place, values[n - begin]);
  }
}

}  // namespace particle_surface_tracker::implicit
