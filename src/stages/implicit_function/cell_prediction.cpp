#include "cell_prediction.h"

#include <array>
#include <cstdint>
#include <vector>

#include "fine_cells.h"
#include "halved_cells.h"
#include "node_requester.h"

namespace particle_surface_tracker::implicit {

namespace {

/// Corner n of a cell is one up in x, y, z where bit 2, 1, 0 of n is set.
LatticeCoord corner(const LatticeCoord& cell, int n) {
  return {cell[0] + ((n >> 2) & 1), cell[1] + ((n >> 1) & 1), cell[2] + (n & 1)};
}

int place_in_block(const LatticeCoord& node) {
  return 64 * (node[0] & 7) + 8 * (node[1] & 7) + (node[2] & 7);
}

/// The first node of a block whose coordinates are multiples of `ratio`.
LatticeCoord first_multiples(const LatticeCoord& block, int ratio) {
  LatticeCoord first;
  for (int axis = 0; axis < 3; ++axis) {
    const int begin = 8 * block[axis];
    first[axis] = begin + ((-begin) % ratio + ratio) % ratio;
  }
  return first;
}

/// Signs of the coarse nodes, remembering the block that was looked at last.
class SignReader {
 public:
  explicit SignReader(const NodeLattice& lattice) : lattice_(lattice) {}

  bool is_inside(const LatticeCoord& node) {
    const LatticeCoord coord = block_of(node);
    if (!is_valid_ || coord != coord_) {
      block_ = lattice_.find(coord);
      coord_ = coord;
      is_valid_ = true;
    }
    const int place = place_in_block(node);
    return block_ != nullptr && ((block_->negative[place >> 6] >> (place & 63)) & 1) != 0;
  }

  /// True where a node is inside or any of the 26 around it.
  bool is_near_inside(const LatticeCoord& node) {
    for (int n = 0; n < 27; ++n) {
      if (is_inside({node[0] + n / 9 - 1, node[1] + n / 3 % 3 - 1, node[2] + n % 3 - 1})) return true;
    }
    return false;
  }

 private:
  const NodeLattice& lattice_;
  const NodeBlock* block_ = nullptr;
  LatticeCoord coord_ = {};
  bool is_valid_ = false;
};

/// Requests what `Cells` (FineCells or HalvedCells) predicts in the mixed coarse cells.
template <typename Cells>
void request_cells(const NodeLattice& coarse, int ratio, Cells cells, NodeLattice& fine) {
  NodeRequester requester(fine, ratio + 1);
  for (std::uint32_t index = 0; index < coarse.blocks().size(); ++index) {
    const NodeMask mixed = coarse.mixed_cells(index);
    if (!any(mixed)) continue;
    const LatticeCoord& coord = coarse.blocks()[index].coord;
    requester.move_to({coord[0] * ratio, coord[1] * ratio, coord[2] * ratio});
    std::array<const NodeBlock*, 8> neighbors;
    for (int n = 0; n < 8; ++n) neighbors[n] = coarse.find(corner(coord, n));
    for (int x = 0; x < 8; ++x) {
      for (std::uint64_t rest = mixed[x]; rest != 0; rest &= rest - 1) {
        const int bit = __builtin_ctzll(rest);
        const LatticeCoord cell = {x, bit >> 3, bit & 7};
        std::array<float, 8> values;
        for (int n = 0; n < 8; ++n) {
          const LatticeCoord node = corner(cell, n);
          const NodeBlock* block = neighbors[4 * (node[0] >> 3) + 2 * (node[1] >> 3) + (node[2] >> 3)];
          values[n] = block->values[place_in_block(node)];
        }
        cells.interpolate(values);
        cells.request_mixed({8 * coord[0] + cell[0], 8 * coord[1] + cell[1], 8 * coord[2] + cell[2]}, requester);
      }
    }
  }
}

}  // namespace

void request_predicted_cells(const NodeLattice& coarse, int ratio, double margin, NodeLattice& fine) {
  if (ratio == 2) {
    request_cells(coarse, ratio, HalvedCells(static_cast<float>(margin)), fine);
  } else {
    request_cells(coarse, ratio, FineCells(ratio, static_cast<float>(margin)), fine);
  }
}

void request_around_stray_particles(const ParticleGrid& particles, const NodeLattice& coarse, int ratio, int reach,
                                    NodeLattice& fine) {
  SignReader signs(coarse);
  NodeRequester requester(fine, reach / 4 + 2);
  const double fine_cell = particles.cell_size() / ratio;
  for (const ParticleGrid::Tile& tile : particles.tiles()) {
    const NodeBlock* block = coarse.find(tile.coord);
    for (int cell = 0; cell < 512; ++cell) {
      if (tile.begin[cell] == tile.begin[cell + 1]) continue;
      if (block != nullptr && ((block->negative[cell >> 6] >> (cell & 63)) & 1) != 0) continue;
      const LatticeCoord node = {8 * tile.coord[0] + (cell >> 6), 8 * tile.coord[1] + ((cell >> 3) & 7),
                                 8 * tile.coord[2] + (cell & 7)};
      if (signs.is_near_inside(node)) continue;
      for (std::uint32_t n = tile.begin[cell]; n < tile.begin[cell + 1]; ++n) {
        const Vec3d position(particles.x()[n], particles.y()[n], particles.z()[n]);
        const Eigen::Vector3i middle = (position / fine_cell).array().round().cast<int>();
        requester.request_cube({middle.x(), middle.y(), middle.z()}, reach);
      }
    }
  }
}

void request_around_shallow_nodes(const NodeLattice& coarse, int ratio, double depth, NodeLattice& fine) {
  const std::vector<NodeMask> explained = coarse.corners_of_mixed_cells();
  NodeRequester requester(fine, ratio / 4 + 2);
  for (std::uint32_t index = 0; index < explained.size(); ++index) {
    const NodeBlock& block = coarse.blocks()[index];
    for (int x = 0; x < 8; ++x) {
      for (std::uint64_t rest = block.evaluated[x] & block.negative[x] & ~explained[index][x]; rest != 0;
           rest &= rest - 1) {
        const int bit = __builtin_ctzll(rest);
        if (block.values[64 * x + bit] < -depth) continue;
        requester.request_cube({(8 * block.coord[0] + x) * ratio, (8 * block.coord[1] + (bit >> 3)) * ratio,
                                (8 * block.coord[2] + (bit & 7)) * ratio},
                               ratio);
      }
    }
  }
}

void share_values(const NodeLattice& coarse, int ratio, NodeLattice& fine) {
  for (NodeBlock& block : fine.blocks()) {
    const LatticeCoord first = first_multiples(block.coord, ratio);
    const LatticeCoord end = {8 * block.coord[0] + 8, 8 * block.coord[1] + 8, 8 * block.coord[2] + 8};
    const NodeBlock* source = nullptr;
    LatticeCoord node;
    for (node[0] = first[0]; node[0] < end[0]; node[0] += ratio) {
      for (node[1] = first[1]; node[1] < end[1]; node[1] += ratio) {
        for (node[2] = first[2]; node[2] < end[2]; node[2] += ratio) {
          const LatticeCoord coarse_node = {node[0] / ratio, node[1] / ratio, node[2] / ratio};
          const LatticeCoord coord = block_of(coarse_node);
          // Fine blocks have all of their nodes in one coarse block: 8 × 8 × 8 coarse cells are `ratio`³ fine blocks.
          if (source == nullptr) source = coarse.find(coord);
          if (source == nullptr) break;
          const int place = place_in_block(coarse_node);
          const bool is_known = ((source->evaluated[place >> 6] >> (place & 63)) & 1) != 0;
          if (is_known) block.accept_value(place_in_block(node), source->values[place]);
        }
      }
    }
  }
}

}  // namespace particle_surface_tracker::implicit
