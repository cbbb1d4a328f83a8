#include "node_lattice.h"

#include <algorithm>

namespace particle_surface_tracker::implicit {

namespace {

constexpr std::uint64_t kRow = 0xFF;                   // y = 0
constexpr std::uint64_t kColumn = 0x0101010101010101;  // z = 0
constexpr std::uint64_t kAll = ~std::uint64_t{0};

LatticeCoord add(const LatticeCoord& a, const LatticeCoord& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// In one x-slice: true where the node, or its upper neighbour in y, in z, or in both, is in the set. The slices beside
/// it in y, z and both supply the neighbours beyond the block.
std::uint64_t any_corner(std::uint64_t slice, std::uint64_t slice_y, std::uint64_t slice_z, std::uint64_t slice_yz) {
  const std::uint64_t in_z = slice | ((slice >> 1) & ~(kColumn << 7)) | ((slice_z & kColumn) << 7);
  const std::uint64_t row = slice_y & kRow;
  const std::uint64_t row_in_z = row | (row >> 1) | ((slice_yz & 1) << 7);
  return in_z | (in_z >> 8) | (row_in_z << 56);
}

/// Cells of which any corner is in a set of nodes. Neighbour n of the block lies one up in x, y, z where bit 2, 1, 0 of
/// n is set; neighbour 0 is the block itself.
NodeMask cells_with_any_corner(const std::array<NodeMask, 8>& sets) {
  std::array<std::uint64_t, 9> slices;
  for (int x = 0; x < 8; ++x) slices[x] = any_corner(sets[0][x], sets[2][x], sets[1][x], sets[3][x]);
  slices[8] = any_corner(sets[4][0], sets[6][0], sets[5][0], sets[7][0]);
  NodeMask cells;
  for (int x = 0; x < 8; ++x) cells[x] = slices[x] | slices[x + 1];
  return cells;
}

/// True where a mask has a node whose coordinates are 0 along every axis that `offset` is not 0 along.
bool touches_lower_side(const NodeMask& mask, const LatticeCoord& offset) {
  std::uint64_t nodes = mask[0];
  if (offset[0] == 0) {
    for (int x = 1; x < 8; ++x) nodes |= mask[x];
  }
  if (offset[1] != 0) nodes &= kRow;
  if (offset[2] != 0) nodes &= kColumn;
  return nodes != 0;
}

}  // namespace

bool any(const NodeMask& mask) {
  return std::any_of(mask.begin(), mask.end(), [](std::uint64_t word) { return word != 0; });
}

NodeMask corners_in_block(const NodeMask& cells, const LatticeCoord& offset) {
  NodeMask nodes = {};
  for (int x = 0; x < 8; ++x) {
    const std::uint64_t in_z =
        offset[2] == 0 ? cells[x] | ((cells[x] & ~(kColumn << 7)) << 1) : (cells[x] >> 7) & kColumn;
    const std::uint64_t in_yz = offset[1] == 0 ? in_z | (in_z << 8) : in_z >> 56;
    if (offset[0] == 0) nodes[x] |= in_yz;
    if (offset[0] == 0 && x < 7) nodes[x + 1] |= in_yz;
    if (offset[0] != 0 && x == 7) nodes[0] |= in_yz;
  }
  return nodes;
}

std::uint32_t NodeLattice::touch(const LatticeCoord& coord) {
  const std::uint32_t number = index_.find_or_insert(coord);
  if (number == blocks_.size()) {
    blocks_.emplace_back();
    blocks_.back().coord = coord;
    if (presume_outside_) blocks_.back().known.fill(kAll);
  }
  return number;
}

NodeMask NodeLattice::mixed_cells(std::uint32_t index) const {
  std::array<NodeMask, 8> inside;
  std::array<NodeMask, 8> outside;
  for (int n = 0; n < 8; ++n) {
    const NodeBlock* block =
        n == 0 ? &blocks_[index] : find(add(blocks_[index].coord, {(n >> 2) & 1, (n >> 1) & 1, n & 1}));
    for (int x = 0; x < 8; ++x) {
      inside[n][x] = block == nullptr ? 0 : block->known[x] & block->negative[x];
      outside[n][x] = block == nullptr ? (presume_outside_ ? kAll : 0) : block->known[x] & ~block->negative[x];
    }
  }
  NodeMask mixed = cells_with_any_corner(inside);
  if (!any(mixed)) return mixed;
  const NodeMask with_outside = cells_with_any_corner(outside);
  for (int x = 0; x < 8; ++x) mixed[x] &= with_outside[x];
  return mixed;
}

std::vector<NodeMask> NodeLattice::corners_of_mixed_cells() const {
  std::vector<NodeMask> corners(blocks_.size(), NodeMask{});
  for (std::uint32_t index = 0; index < blocks_.size(); ++index) {
    const NodeMask mixed = mixed_cells(index);
    if (!any(mixed)) continue;
    for (int n = 0; n < 8; ++n) {
      const LatticeCoord offset = {(n >> 2) & 1, (n >> 1) & 1, n & 1};
      const NodeMask in_block = corners_in_block(mixed, offset);
      if (!any(in_block)) continue;
      const std::uint32_t target = index_.find(add(blocks_[index].coord, offset));
      if (target == LatticeIndex::none) continue;
      for (int x = 0; x < 8; ++x) corners[target][x] |= in_block[x];
    }
  }
  return corners;
}

void NodeLattice::request_corners(std::uint32_t index, const NodeMask& cells) {
  const LatticeCoord coord = blocks_[index].coord;
  for (int n = 0; n < 8; ++n) {
    const LatticeCoord offset = {(n >> 2) & 1, (n >> 1) & 1, n & 1};
    const NodeMask corners = corners_in_block(cells, offset);
    if (!any(corners)) continue;
    const std::uint32_t target = n == 0 ? index : touch(add(coord, offset));
    NodeBlock& block = blocks_[target];
    for (int x = 0; x < 8; ++x) block.requested[x] |= corners[x] & ~block.evaluated[x];
  }
}

std::vector<std::uint32_t> NodeLattice::blocks_with_requests() const {
  std::vector<std::uint32_t> blocks;
  for (std::uint32_t index = 0; index < blocks_.size(); ++index) {
    if (any(blocks_[index].requested)) blocks.push_back(index);
  }
  return blocks;
}

std::vector<std::uint32_t> NodeLattice::blocks_with_cells_around(const std::vector<std::uint32_t>& blocks) {
  std::vector<std::uint32_t> around = blocks;
  for (const std::uint32_t index : blocks) {
    for (int n = 1; n < 8; ++n) {
      const LatticeCoord offset = {-((n >> 2) & 1), -((n >> 1) & 1), -(n & 1)};
      const LatticeCoord coord = add(blocks_[index].coord, offset);
      const std::uint32_t number = index_.find(coord);
      if (number != LatticeIndex::none) {
        around.push_back(number);
      } else if (touches_lower_side(blocks_[index].negative, offset)) {
        around.push_back(touch(coord));
      }
    }
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  return around;
}

}  // namespace particle_surface_tracker::implicit
