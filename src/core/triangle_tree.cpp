#include "triangle_tree.h"

#include <limits>

namespace particle_surface_tracker {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();

FloatBox empty_box() {
  return {{kInfinity, kInfinity, kInfinity}, {-kInfinity, -kInfinity, -kInfinity}};
}

void extend(FloatBox& box, const FloatBox& other) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    box.lower[axis] = std::min(box.lower[axis], other.lower[axis]);
    box.upper[axis] = std::max(box.upper[axis], other.upper[axis]);
  }
}

FloatBox box_of(const std::vector<Vec3f>& positions, const Triangle& triangle) {
  FloatBox box = empty_box();
  for (const std::uint32_t vertex : triangle) {
    const Vec3f& p = positions[vertex];
    extend(box, {{p.x(), p.y(), p.z()}, {p.x(), p.y(), p.z()}});
  }
  return box;
}

}  // namespace

TriangleTree::TriangleTree(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                           const std::vector<std::uint32_t>& members) {
  if (members.empty()) return;
  items_.reserve(members.size());
  for (const std::uint32_t t : members) items_.push_back({box_of(positions, triangles[t]), t});
  nodes_.resize(2 * static_cast<std::size_t>(root().leaf_count()) - 1);
  build(root());
}

void TriangleTree::build(const Node& node) {
  FloatBox box = empty_box();
  for (std::uint32_t i = node.begin; i < node.end; ++i) extend(box, items_[i].box);
  nodes_[node.place] = box;
  if (node.is_leaf()) return;

  const auto extent = [&box](std::size_t axis) {
    return static_cast<double>(box.upper[axis]) - static_cast<double>(box.lower[axis]);
  };
  std::size_t axis = extent(1) > extent(0) ? 1 : 0;
  if (extent(2) > extent(axis)) axis = 2;
  // Twice the middle of a box; ties by the triangle, so that the tree is always the same.
  const auto is_lower = [axis](const Item& a, const Item& b) {
    const double a_place = static_cast<double>(a.box.lower[axis]) + static_cast<double>(a.box.upper[axis]);
    const double b_place = static_cast<double>(b.box.lower[axis]) + static_cast<double>(b.box.upper[axis]);
    return a_place != b_place ? a_place < b_place : a.triangle < b.triangle;
  };
  std::nth_element(items_.begin() + node.begin, items_.begin() + node.middle(), items_.begin() + node.end, is_lower);
  if (node.size() >= kTaskSize) {
    tbb::parallel_invoke([&] { build(node.left()); }, [&] { build(node.right()); });
  } else {
    build(node.left());
    build(node.right());
  }
}

}  // namespace particle_surface_tracker
