#include "line_signs.h"

#include <algorithm>

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;

openvdb::Coord column_origin(const openvdb::Coord& node) {
  return {node.x() & ~(kWidth - 1), node.y() & ~(kWidth - 1), 0};
}

std::size_t row_of(const openvdb::Coord& node) {
  return static_cast<std::size_t>(kWidth * (node.x() & (kWidth - 1)) + (node.y() & (kWidth - 1)));
}

/// Signs that a field has at the nodes of a leaf.
struct FieldLeaf {
  openvdb::Coord origin;
  LeafWords active{};
  LeafWords inside{};
};

FieldLeaf read_leaf(const openvdb::FloatTree::LeafNodeType& leaf) {
  FieldLeaf signs{leaf.origin()};
  const float* values = leaf.buffer().data();
  for (int x = 0; x < kWidth; ++x) {
    signs.active[x] = leaf.getValueMask().getWord<openvdb::Index64>(x);
    for_each_bit(signs.active[x],
                 [&](int bit) { signs.inside[x] |= static_cast<std::uint64_t>(values[64 * x + bit] < 0.0f) << bit; });
  }
  return signs;
}

}  // namespace

LineSigns::LineSigns(const std::vector<Crossing>& crossings) : index_(64) {
  std::vector<std::uint32_t> column_of(crossings.size());
  for (std::size_t n = 0; n < crossings.size(); ++n) {
    const openvdb::Coord origin = column_origin(crossings[n].node);
    std::uint32_t number =
        n > 0 && column_origin(crossings[n - 1].node) == origin ? column_of[n - 1] : index_.find(origin);
    if (number == LeafIndex::none) {
      number = static_cast<std::uint32_t>(columns_.size());
      index_.insert(origin, number);
      columns_.push_back({});
    }
    column_of[n] = number;
    ++columns_[number][row_of(crossings[n].node)];
  }
  // From counts to beginnings; each is moved on while its line is filled, and so ends where the next one begins.
  std::uint32_t count = 0;
  for (Column& column : columns_) {
    for (std::uint32_t& begin : column) {
      const std::uint32_t size = begin;
      begin = count;
      count += size;
    }
  }
  std::vector<Crossing> sorted(crossings.size());
  std::vector<Column> next = columns_;
  for (std::size_t n = 0; n < crossings.size(); ++n) {
    sorted[next[column_of[n]][row_of(crossings[n].node)]++] = crossings[n];
  }
  places_.resize(sorted.size());
  windings_.resize(sorted.size());
  const auto is_before = [](const Crossing& a, const Crossing& b) { return a.node.z() < b.node.z(); };
  for (const Column& column : columns_) {
    for (int row = 0; row < kRows; ++row) {
      const auto begin = sorted.begin() + column[row];
      // A column has one entry more than rows, which cppcheck does not see.
      // cppcheck-suppress containerOutOfBounds
      const auto end = sorted.begin() + column[row + 1];
      if (!std::is_sorted(begin, end, is_before)) std::stable_sort(begin, end, is_before);
      std::int32_t winding = 0;
      for (std::uint32_t n = column[row]; n < column[row + 1]; ++n) {
        winding += sorted[n].step;
        places_[n] = sorted[n].node.z();
        windings_[n] = winding;
      }
    }
  }
}

LineSigns::Leaf LineSigns::leaf(const openvdb::Coord& origin) const {
  Leaf result;
  const std::uint32_t number = index_.find(column_origin(origin));
  if (number == LeafIndex::none) return result;
  const Column& column = columns_[number];
  for (int row = 0; row < kRows; ++row) {
    const std::uint32_t begin = column[row];
    // cppcheck-suppress containerOutOfBounds
    const std::uint32_t end = column[row + 1];
    if (begin == end) continue;
    auto next = static_cast<std::uint32_t>(
        std::lower_bound(places_.begin() + begin, places_.begin() + end, origin.z()) - places_.begin());
    std::int32_t winding = next == begin ? 0 : windings_[next - 1];
    if (winding == 0 && (next == end || places_[next] >= origin.z() + kWidth)) continue;
    const int x = row / kWidth;
    const int first_bit = kWidth * (row % kWidth);
    for (int z = 0; z < kWidth; ++z) {
      const std::uint64_t bit = std::uint64_t{1} << (first_bit + z);
      if (winding >= 1) result.inside[x] |= bit;
      if (winding != 0 && winding != 1) result.tangled[x] |= bit;
      for (; next < end && places_[next] == origin.z() + z; ++next) winding = windings_[next];
    }
  }
  return result;
}

LineSigns make_mesh_signs(const MeshLattice& lattice) {
  constexpr int kAlongZ = 2;
  std::vector<LineSigns::Crossing> crossings;
  for (const EdgeCrossing& crossing : lattice.crossings()) {
    if (crossing.edge.axis == kAlongZ) crossings.push_back({crossing.edge.node, crossing.step});
  }
  return LineSigns(crossings);
}

LineSigns make_field_signs(const ImplicitSurface& surface) {
  const openvdb::FloatTree& tree = surface.field->tree();
  std::vector<FieldLeaf> leaves;
  LeafIndex index(tree.leafCount());
  for (auto leaf = tree.cbeginLeaf(); leaf; ++leaf) {
    index.insert(leaf->origin(), static_cast<std::uint32_t>(leaves.size()));
    leaves.push_back(read_leaf(*leaf));
  }
  // Both ends of a lattice edge that the isosurface crosses have a value, so no crossing is overlooked.
  std::vector<LineSigns::Crossing> crossings;
  const FieldLeaf nothing{};
  for (const FieldLeaf& leaf : leaves) {
    const std::uint32_t above = index.find(leaf.origin.offsetBy(0, 0, kWidth));
    const FieldLeaf& next = above == LeafIndex::none ? nothing : leaves[above];
    for (int x = 0; x < kWidth; ++x) {
      const std::uint64_t inside_next = from_next_z(leaf.inside[x], next.inside[x]);
      const std::uint64_t active_next = from_next_z(leaf.active[x], next.active[x]);
      for_each_bit((leaf.inside[x] ^ inside_next) & leaf.active[x] & active_next, [&](int bit) {
        const int step = (leaf.inside[x] >> bit & 1) != 0 ? -1 : 1;
        crossings.push_back({leaf.origin.offsetBy(x, bit >> 3, bit & 7), step});
      });
    }
  }
  return LineSigns(crossings);
}

}  // namespace particle_surface_tracker
