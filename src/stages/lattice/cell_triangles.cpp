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

/// A triangle meets a cell of a leaf.
struct Meeting {
  std::uint32_t leaf;
  std::uint32_t place;
  std::uint32_t triangle;
};

/// The cells that some triangles meet, with leaves numbered in the order of their first occurrence.
class Meetings {
 public:
  void append(const Coord& cell, std::uint32_t triangle) {
    const Coord leaf = leaf_of(cell);
    if (leaves.empty() || leaf != leaves[last_]) {
      last_ = index_.find(leaf);
      if (last_ == LeafIndex::none) {
        last_ = static_cast<std::uint32_t>(leaves.size());
        index_.insert(leaf, last_);
        leaves.push_back(leaf);
      }
    }
    all.push_back({last_, place_in_leaf(cell), triangle});
  }

  std::vector<Coord> leaves;
  std::vector<Meeting> all;

 private:
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
      return;
    }
    for (std::int32_t i = lower.x(); i <= upper.x(); ++i) {
      for (std::int32_t j = lower.y(); j <= upper.y(); ++j) {
        for (std::int32_t k = lower.z(); k <= upper.z(); ++k) meetings.append(Coord(i, j, k), triangle);
      }
    }
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
    for (const Coord& cell : cells_) meetings.append(cell, triangle);
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
    for (std::uint32_t t = begin; t < end; ++t) finder.append_cells(t, found[block]);
  });
  std::size_t count = 0;
  for (Meetings& meetings : found) {
    count += meetings.all.size();
    std::vector<std::uint32_t> numbers;
    for (const Coord& leaf : meetings.leaves) {
      numbers.push_back(index_.find(leaf));
      if (numbers.back() != LeafIndex::none) continue;
      numbers.back() = static_cast<std::uint32_t>(leaves_.size());
      index_.insert(leaf, numbers.back());
      leaves_.push_back(leaf);
    }
    for (Meeting& meeting : meetings.all) meeting.leaf = numbers[meeting.leaf];
  }
  begin_.assign(leaves_.size() * kCellsPerLeaf + 2, 0);
  for (const Meetings& meetings : found) {
    for (const Meeting& m : meetings.all) ++begin_[std::size_t{m.leaf} * kCellsPerLeaf + m.place + 2];
  }
  for (std::size_t n = 2; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  triangles_.resize(count);
  for (const Meetings& meetings : found) {
    for (const Meeting& m : meetings.all) {
      triangles_[begin_[std::size_t{m.leaf} * kCellsPerLeaf + m.place + 1]++] = m.triangle;
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
