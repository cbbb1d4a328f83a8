#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <tbb/parallel_invoke.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// A box parallel to the axes; float coordinates are exact here, nothing is computed with them.
struct FloatBox {
  std::array<float, 3> lower, upper;

  bool meets(const FloatBox& other) const {
    return lower[0] <= other.upper[0] && other.lower[0] <= upper[0] && lower[1] <= other.upper[1] &&
           other.lower[1] <= upper[1] && lower[2] <= other.upper[2] && other.lower[2] <= upper[2];
  }
};

/// A tree of boxes over triangles, for finding those whose boxes meet.
class TriangleTree {
 public:
  /// \param members the triangles to hold; their positions must be finite.
  TriangleTree(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
               const std::vector<std::uint32_t>& members);

  /// Calls visit(a, b) once for every two triangles whose closed boxes meet, in any order and from several threads.
  template <typename Visit>
  void for_each_pair(const Visit& visit) const {
    if (!nodes_.empty()) visit_pairs(root(), visit);
  }

  /// Calls visit(t) for every triangle whose closed box meets the ray from a point along +z, in a fixed order.
  template <typename Visit>
  void for_each_above(const Vec3f& point, const Visit& visit) const {
    if (!nodes_.empty()) visit_above(root(), point, visit);
  }

 private:
  static constexpr std::uint32_t kLeafSize = 4;
  /// Pairs of subtrees with fewer triangles are not worth a task.
  static constexpr std::uint32_t kTaskSize = 1024;

  struct Item {
    FloatBox box;
    std::uint32_t triangle;
  };

  /// A node of the tree. Nodes stand in the order of a walk: the left child follows its parent.
  struct Node {
    std::uint32_t place, begin, end;  ///< In nodes_; its items are [begin, end).

    std::uint32_t size() const { return end - begin; }
    bool is_leaf() const { return size() <= kLeafSize; }
    /// Leaves are full but for the last, so that the shape of the tree follows from its size.
    std::uint32_t middle() const { return begin + (leaf_count() / 2) * kLeafSize; }
    std::uint32_t leaf_count() const { return (size() + kLeafSize - 1) / kLeafSize; }
    Node left() const { return {place + 1, begin, middle()}; }
    Node right() const { return {place + 2 * (leaf_count() / 2), middle(), end}; }
  };

  Node root() const { return {0, 0, static_cast<std::uint32_t>(items_.size())}; }
  void build(const Node& node);

  template <typename Visit>
  void visit_pairs(const Node& node, const Visit& visit) const {
    if (node.is_leaf()) {
      for (std::uint32_t i = node.begin; i < node.end; ++i) {
        for (std::uint32_t j = i + 1; j < node.end; ++j) visit_if_met(items_[i], items_[j], visit);
      }
      return;
    }
    const auto pairs_in = [&](const Node& child) { return [this, child, &visit] { visit_pairs(child, visit); }; };
    const auto across = [&] { visit_pairs(node.left(), node.right(), visit); };
    if (node.size() >= kTaskSize) {
      tbb::parallel_invoke(pairs_in(node.left()), pairs_in(node.right()), across);
    } else {
      pairs_in(node.left())();
      pairs_in(node.right())();
      across();
    }
  }

  template <typename Visit>
  void visit_pairs(const Node& a, const Node& b, const Visit& visit) const {
    if (!nodes_[a.place].meets(nodes_[b.place])) return;
    if (a.is_leaf() && b.is_leaf()) {
      for (std::uint32_t i = a.begin; i < a.end; ++i) {
        if (!items_[i].box.meets(nodes_[b.place])) continue;
        for (std::uint32_t j = b.begin; j < b.end; ++j) visit_if_met(items_[i], items_[j], visit);
      }
      return;
    }
    const bool descend_in_a = a.size() >= b.size();
    const Node& larger = descend_in_a ? a : b;
    const Node& other = descend_in_a ? b : a;
    const auto with = [&](const Node& child) {
      return [this, child, &other, &visit] { visit_pairs(child, other, visit); };
    };
    if (larger.size() >= kTaskSize) {
      tbb::parallel_invoke(with(larger.left()), with(larger.right()));
    } else {
      with(larger.left())();
      with(larger.right())();
    }
  }

  template <typename Visit>
  static void visit_if_met(const Item& a, const Item& b, const Visit& visit) {
    if (a.box.meets(b.box)) visit(a.triangle, b.triangle);
  }

  static bool is_below(const FloatBox& box, const Vec3f& point) {
    return point.x() < box.lower[0] || point.x() > box.upper[0] || point.y() < box.lower[1] ||
           point.y() > box.upper[1] || box.upper[2] < point.z();
  }

  template <typename Visit>
  void visit_above(const Node& node, const Vec3f& point, const Visit& visit) const {
    if (is_below(nodes_[node.place], point)) return;
    if (!node.is_leaf()) {
      visit_above(node.left(), point, visit);
      visit_above(node.right(), point, visit);
      return;
    }
    for (std::uint32_t i = node.begin; i < node.end; ++i) {
      if (!is_below(items_[i].box, point)) visit(items_[i].triangle);
    }
  }

  std::vector<Item> items_;
  std::vector<FloatBox> nodes_;
};

}  // namespace particle_surface_tracker
