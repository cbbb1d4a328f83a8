#include "cell_triangles.h"

#include <algorithm>

#include "triangle_blocks.h"
#include "triangle_slicer.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;

constexpr int kWidth = 8;
constexpr std::uint32_t kCellsPerLeaf = 512;

/// Of triangles that span no more cells than this, all cells of the bounding box count: cutting them costs more than
/// the cells that they do not meet.
constexpr std::int64_t kSmallBox = 12;

Coord leaf_of(const Coord& cell) {
  return cell & ~(kWidth - 1);
}

std::uint32_t place_in_leaf(const Coord& cell) {
  const Coord place = cell & (kWidth - 1);
  return static_cast<std::uint32_t>((place.x() * kWidth + place.y()) * kWidth + place.z());
}

/// The cells that the triangles of a block meet, with leaves numbered in the order of their first occurrence.
class Meetings {
 public:
  void reserve() {
    constexpr std::size_t cells_per_triangle = 6;
    cells.reserve(cells_per_triangle * kTrianglesPerBlock);
    ends.reserve(kTrianglesPerBlock);
  }

  void append(const Coord& cell) { cells.push_back(kCellsPerLeaf * number_of(leaf_of(cell)) + place_in_leaf(cell)); }

  void append_box(const Coord& lower, const Coord& upper) {
    if (leaf_of(lower) != leaf_of(upper)) {
      for_each_in(lower, upper, [&](const Coord& cell) { append(cell); });
      return;
    }
    const std::uint32_t first = kCellsPerLeaf * number_of(leaf_of(lower));
    for_each_in(lower, upper, [&](const Coord& cell) { cells.push_back(first + place_in_leaf(cell)); });
  }

  void end_triangle() { ends.push_back(static_cast<std::uint32_t>(cells.size())); }

  std::vector<Coord> leaves;
  std::vector<std::uint32_t> cells;  ///< Number of the leaf times kCellsPerLeaf, plus the place; triangle by triangle.
  std::vector<std::uint32_t> ends;   ///< Where those of each triangle end.

 private:
  template <typename Visit>
  static void for_each_in(const Coord& lower, const Coord& upper, Visit&& visit) {
    for (std::int32_t i = lower.x(); i <= upper.x(); ++i) {
      for (std::int32_t j = lower.y(); j <= upper.y(); ++j) {
        for (std::int32_t k = lower.z(); k <= upper.z(); ++k) visit(Coord(i, j, k));
      }
    }
  }

  std::uint32_t number_of(const Coord& leaf) {
    if (!leaves.empty() && leaf == leaves[last_]) return last_;
    last_ = index_.find(leaf);
    if (last_ == LeafIndex::none) {
      last_ = static_cast<std::uint32_t>(leaves.size());
      index_.insert(leaf, last_);
      leaves.push_back(leaf);
    }
    return last_;
  }

  LeafIndex index_{16};
  std::uint32_t last_ = 0;
};

class CellFinder {
 public:
  explicit CellFinder(const LatticeMesh& mesh) : mesh_(mesh), slicer_(mesh) {}

  void append_cells(std::uint32_t triangle, Meetings& meetings) {
    const auto& [a, b, c] = mesh_.triangle(triangle);
    const Coord lower = Coord::minComponent(Coord::minComponent(mesh_.cells[a], mesh_.cells[b]), mesh_.cells[c]);
    const Coord upper = Coord::maxComponent(Coord::maxComponent(mesh_.cells[a], mesh_.cells[b]), mesh_.cells[c]);
    if (box_size(lower, upper) > kSmallBox) {
      append_cut_cells(triangle, meetings);
    } else {
      meetings.append_box(lower, upper);
    }
    meetings.end_triangle();
  }

 private:
  /// Number of cells from lower to upper, or something above kSmallBox if it is more than that.
  static std::int64_t box_size(const Coord& lower, const Coord& upper) {
    std::int64_t size = 1;
    for (int axis = 0; axis < 3; ++axis) {
      size *= std::min<std::int64_t>(std::int64_t{upper[axis]} - lower[axis] + 1, kSmallBox + 1);
    }
    return size;
  }

  void append_cut_cells(std::uint32_t triangle, Meetings& meetings) {
    slicer_.cut(triangle, cut_);
    cells_.assign(cut_.cells.begin(), cut_.cells.end());
    for (const TriangleCut::Segment& segment : cut_.segments) {
      cells_.push_back(segment.face.lower_cell());
      cells_.push_back(segment.face.upper_cell());
    }
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    for (const Coord& cell : cells_) meetings.append(cell);
  }

  const LatticeMesh& mesh_;
  TriangleSlicer slicer_;
  TriangleCut cut_;
  std::vector<Coord> cells_;
};

}  // namespace

CellTriangles::CellTriangles(const LatticeMesh& mesh) : index_(mesh.triangles->size() / 32) {
  std::vector<Meetings> found(triangle_block_count(mesh));
  for_triangle_blocks(mesh, [&](std::size_t block, std::uint32_t begin, std::uint32_t end) {
    CellFinder finder(mesh);
    found[block].reserve();
    for (std::uint32_t t = begin; t < end; ++t) finder.append_cells(t, found[block]);
  });
  std::size_t count = 0;
  for (Meetings& meetings : found) {
    count += meetings.cells.size();
    std::vector<std::uint32_t> first_cells;
    for (const Coord& leaf : meetings.leaves) {
      std::uint32_t number = index_.find(leaf);
      if (number == LeafIndex::none) {
        number = static_cast<std::uint32_t>(leaves_.size());
        index_.insert(leaf, number);
        leaves_.push_back(leaf);
      }
      first_cells.push_back(kCellsPerLeaf * number);
    }
    for (std::uint32_t& cell : meetings.cells) cell = first_cells[cell / kCellsPerLeaf] + cell % kCellsPerLeaf;
  }
  begin_.assign(leaves_.size() * kCellsPerLeaf + 2, 0);
  for (const Meetings& meetings : found) {
    for (const std::uint32_t cell : meetings.cells) ++begin_[std::size_t{cell} + 2];
  }
  for (std::size_t n = 2; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  triangles_.resize(count);
  std::uint32_t triangle = 0;
  for (const Meetings& meetings : found) {
    std::uint32_t n = 0;
    for (const std::uint32_t end : meetings.ends) {
      for (; n < end; ++n) triangles_[begin_[std::size_t{meetings.cells[n]} + 1]++] = triangle;
      ++triangle;
    }
  }
}

ArrayRange<std::uint32_t> CellTriangles::in_cell(const Coord& cell) const {
  const std::uint32_t leaf = index_.find(leaf_of(cell));
  if (leaf == LeafIndex::none) return {};
  const std::size_t n = std::size_t{leaf} * kCellsPerLeaf + place_in_leaf(cell);
  return {triangles_.data() + begin_[n], triangles_.data() + begin_[n + 1]};
}

std::vector<Coord> CellTriangles::cells() const {
  std::vector<Coord> cells;
  for (std::size_t leaf = 0; leaf < leaves_.size(); ++leaf) {
    for (std::uint32_t place = 0; place < kCellsPerLeaf; ++place) {
      const std::size_t n = leaf * kCellsPerLeaf + place;
      if (begin_[n] == begin_[n + 1]) continue;
      const auto p = static_cast<std::int32_t>(place);
      cells.push_back(leaves_[leaf].offsetBy(p / 64, p / 8 % 8, p % 8));
    }
  }
  return cells;
}

}  // namespace particle_surface_tracker
