#include "matching_region.h"

#include <algorithm>
#include <cstdlib>

namespace particle_surface_tracker {

namespace {

const LeafWords kNothing{};

/// The words of a set's leaf, zeros where it is not there.
const LeafWords& words_of(const NodeMasks& set, const openvdb::Coord& origin) {
  const std::uint32_t number = set.find(origin);
  return number == LeafIndex::none ? kNothing : set.leaves()[number].words;
}

}  // namespace

NodeMasks nodes_at_cells(const std::vector<openvdb::Coord>& cells) {
  NodeMasks nodes;
  for (const openvdb::Coord& cell : cells) nodes.insert(cell);
  nodes.dilate(0, 1);
  return nodes;
}

void unite(NodeMasks& set, const NodeMasks& other) {
  for (const NodeMasks::Leaf& leaf : other.leaves()) add_words(leaf.words, set.words_at(leaf.origin));
}

void remove_nodes(NodeMasks& set, const NodeMasks& removed) {
  for (const NodeMasks::Leaf& leaf : removed.leaves()) {
    if (set.find(leaf.origin) == LeafIndex::none) continue;
    LeafWords& words = set.words_at(leaf.origin);
    for (int x = 0; x < 8; ++x) words[x] &= ~leaf.words[x];
  }
}

bool is_empty(const NodeMasks& set) {
  return std::all_of(set.leaves().begin(), set.leaves().end(),
                     [](const NodeMasks::Leaf& leaf) { return is_zero(leaf.words); });
}

NodeMasks nodes_next_to_other_side(const NodeMasks& set, const LineSigns& signs) {
  NodeMasks ring = set;
  ring.dilate(1, 1);
  NodeMasks inside(ring.leaves().size());
  NodeMasks outside(ring.leaves().size());
  for (const NodeMasks::Leaf& leaf : ring.leaves()) {
    const LeafWords is_inside = signs.leaf(leaf.origin).inside;
    LeafWords& inside_words = inside.words_at(leaf.origin);
    LeafWords& outside_words = outside.words_at(leaf.origin);
    for (int x = 0; x < 8; ++x) {
      inside_words[x] = leaf.words[x] & is_inside[x];
      outside_words[x] = leaf.words[x] & ~is_inside[x];
    }
  }
  NodeMasks near_inside = inside;
  NodeMasks near_outside = outside;
  near_inside.dilate(1, 1);
  near_outside.dilate(1, 1);
  NodeMasks result(set.leaves().size());
  for (const NodeMasks::Leaf& leaf : set.leaves()) {
    const LeafWords& is_inside = words_of(inside, leaf.origin);
    const LeafWords& by_inside = words_of(near_inside, leaf.origin);
    const LeafWords& by_outside = words_of(near_outside, leaf.origin);
    LeafWords& words = result.words_at(leaf.origin);
    for (int x = 0; x < 8; ++x) {
      words[x] = leaf.words[x] & ((is_inside[x] & by_outside[x]) | (~is_inside[x] & by_inside[x]));
    }
  }
  return result;
}

MatchingNodes classify_nodes(const NodeMasks& region, const NodeMasks& flagged, const LineSigns& mesh) {
  MatchingNodes nodes{NodeMasks(region.leaves().size()), nodes_next_to_other_side(region, mesh)};
  for (const NodeMasks::Leaf& leaf : region.leaves()) {
    const LeafWords tangled = mesh.leaf(leaf.origin).tangled;
    const LeafWords& is_flagged = words_of(flagged, leaf.origin);
    LeafWords& fixed = nodes.fixed.words_at(leaf.origin);
    LeafWords& unknown = nodes.unknown.words_at(leaf.origin);
    for (int x = 0; x < 8; ++x) {
      fixed[x] &= ~(is_flagged[x] | tangled[x]);
      unknown[x] = leaf.words[x] & ~fixed[x];
    }
  }
  return nodes;
}

bool is_near_rim(const NodeMasks& region, const openvdb::Coord& node) {
  for (int x = -2; x <= 2; ++x) {
    for (int y = -2; y <= 2; ++y) {
      for (int z = -2; z <= 2; ++z) {
        if (std::abs(x) + std::abs(y) + std::abs(z) <= 2 && !region.contains(node.offsetBy(x, y, z))) return true;
      }
    }
  }
  return false;
}

void settle(std::vector<openvdb::Coord>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

NodeMasks masks_of(const std::vector<openvdb::Coord>& nodes) {
  NodeMasks masks;
  for (const openvdb::Coord& node : nodes) masks.insert(node);
  return masks;
}

NodeMasks masks_of(const std::vector<std::vector<openvdb::Coord>>& lists) {
  NodeMasks masks;
  for (const std::vector<openvdb::Coord>& list : lists) {
    for (const openvdb::Coord& node : list) masks.insert(node);
  }
  return masks;
}

}  // namespace particle_surface_tracker
