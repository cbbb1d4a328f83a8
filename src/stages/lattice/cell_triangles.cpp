#include "cell_triangles.h"

#include <algorithm>
#include <array>

#include "triangle_blocks.h"
#include "triangle_slicer.h"

namespace particle_surface_tracker {

namespace {

using openvdb::Coord;

constexpr int kWidth = 8;
constexpr std::uint32_t kCellsPerLeaf = 512;

/// Instead of the place of a cell: all cells of the leaf that the triangle's bounding box meets.
constexpr std::uint32_t kWholeBox = kCellsPerLeaf;

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

openvdb::CoordBBox box_of(const LatticeMesh& mesh, std::uint32_t triangle) {
  const auto& [a, b, c] = mesh.triangle(triangle);
  return {Coord::minComponent(Coord::minComponent(mesh.cells[a], mesh.cells[b]), mesh.cells[c]),
          Coord::maxComponent(Coord::maxComponent(mesh.cells[a], mesh.cells[b]), mesh.cells[c])};
}

/// The cells of a box that are in a leaf, from its lowest cell.
openvdb::CoordBBox part_in(const Coord& leaf, openvdb::CoordBBox box) {
  box.intersect(openvdb::CoordBBox::createCube(leaf, kWidth));
  box.translate(-leaf);
  return box;
}

/// \param box as from part_in().
void add_box(const openvdb::CoordBBox& box, LeafWords& words) {
  const std::uint64_t row = (std::uint64_t{2} << box.max().z()) - (std::uint64_t{1} << box.min().z());
  std::uint64_t slice = 0;
  for (std::int32_t y = box.min().y(); y <= box.max().y(); ++y) slice |= row << (kWidth * y);
  for (std::int32_t x = box.min().x(); x <= box.max().x(); ++x) words[x] |= slice;
}

/// Where the triangles of a block are.
struct Meetings {
  struct Meeting {
    std::uint32_t triangle;
    std::uint32_t leaf;  ///< Its number in `in_use`.
    std::uint32_t place;
  };

  void append_box(std::uint32_t triangle, const Coord& leaf, const openvdb::CoordBBox& box) {
    all.push_back({triangle, in_use.number_of(leaf), kWholeBox});
    add_box(part_in(leaf, box), in_use.words_at(leaf));
  }

  void append_cell(std::uint32_t triangle, const Coord& cell) {
    all.push_back({triangle, in_use.number_of(leaf_of(cell)), place_in_leaf(cell)});
    in_use.insert(cell);
  }

  NodeMasks in_use{16};  ///< Cells with triangles.
  std::vector<Meeting> all;
};

class LeafFinder {
 public:
  LeafFinder(const LatticeMesh& mesh, Meetings& meetings) : mesh_(mesh), slicer_(mesh), meetings_(meetings) {}

  void append(std::uint32_t triangle) {
    const openvdb::CoordBBox box = box_of(mesh_, triangle);
    const Coord first = leaf_of(box.min()), last = leaf_of(box.max());
    if (size_of(box) > kSmallBox) {
      append_cut_cells(triangle);
    } else if (first == last) {
      meetings_.append_box(triangle, first, box);
    } else {
      for (std::int32_t x = first.x(); x <= last.x(); x += kWidth) {
        for (std::int32_t y = first.y(); y <= last.y(); y += kWidth) {
          for (std::int32_t z = first.z(); z <= last.z(); z += kWidth) {
            meetings_.append_box(triangle, Coord(x, y, z), box);
          }
        }
      }
    }
  }

 private:
  /// Number of cells, or something above kSmallBox if it is more than that.
  static std::int64_t size_of(const openvdb::CoordBBox& box) {
    std::int64_t size = 1;
    for (int axis = 0; axis < 3; ++axis) {
      size *= std::min<std::int64_t>(std::int64_t{box.max()[axis]} - box.min()[axis] + 1, kSmallBox + 1);
    }
    return size;
  }

  void append_cut_cells(std::uint32_t triangle) {
    slicer_.cut(triangle, cut_);
    cells_.assign(cut_.cells.begin(), cut_.cells.end());
    for (const TriangleCut::Segment& segment : cut_.segments) {
      cells_.push_back(segment.face.lower_cell());
      cells_.push_back(segment.face.upper_cell());
    }
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    for (const Coord& cell : cells_) meetings_.append_cell(triangle, cell);
  }

  const LatticeMesh& mesh_;
  TriangleSlicer slicer_;
  Meetings& meetings_;
  TriangleCut cut_;
  std::vector<Coord> cells_;
};

}  // namespace

CellTriangles::CellTriangles(const LatticeMesh& mesh) : mesh_(mesh), in_use_(mesh.triangles->size() / 32) {
  std::vector<Meetings> found(triangle_block_count(mesh));
  for_triangle_blocks(mesh, [&](std::size_t block, std::uint32_t begin, std::uint32_t end) {
    found[block].all.reserve(2 * kTrianglesPerBlock);
    LeafFinder finder(mesh, found[block]);
    for (std::uint32_t t = begin; t < end; ++t) finder.append(t);
  });
  begin_.assign(2, 0);
  for (Meetings& meetings : found) {
    std::vector<std::uint32_t> numbers;
    for (const NodeMasks::Leaf& leaf : meetings.in_use.leaves()) {
      add_words(leaf.words, in_use_.words_at(leaf.origin));
      numbers.push_back(in_use_.number_of(leaf.origin));
    }
    begin_.resize(in_use_.leaves().size() + 2, 0);
    for (Meetings::Meeting& meeting : meetings.all) {
      meeting.leaf = numbers[meeting.leaf];
      ++begin_[std::size_t{meeting.leaf} + 2];
    }
  }
  for (std::size_t n = 2; n < begin_.size(); ++n) begin_[n] += begin_[n - 1];
  entries_.resize(begin_.back());
  for (const Meetings& meetings : found) {
    for (const Meetings::Meeting& m : meetings.all) entries_[begin_[std::size_t{m.leaf} + 1]++] = {m.triangle, m.place};
  }
  sorted_ = std::make_unique<SortedLeaf[]>(in_use_.leaves().size());
}

template <typename Visit>
void CellTriangles::for_each_place(std::uint32_t leaf, const Entry& entry, Visit&& visit) const {
  if (entry.place != kWholeBox) {
    visit(entry.place);
    return;
  }
  const openvdb::CoordBBox box = part_in(in_use_.leaves()[leaf].origin, box_of(mesh_, entry.triangle));
  for (std::int32_t x = box.min().x(); x <= box.max().x(); ++x) {
    for (std::int32_t y = box.min().y(); y <= box.max().y(); ++y) {
      for (std::int32_t z = box.min().z(); z <= box.max().z(); ++z) {
        visit(static_cast<std::uint32_t>((x * kWidth + y) * kWidth + z));
      }
    }
  }
}

void CellTriangles::sort(std::uint32_t leaf, std::vector<std::uint32_t>& data) const {
  const auto first = entries_.begin() + static_cast<std::ptrdiff_t>(begin_[leaf]);
  const auto last = entries_.begin() + static_cast<std::ptrdiff_t>(begin_[leaf + 1]);
  std::array<std::uint32_t, kCellsPerLeaf + 2> ends{};
  for (auto entry = first; entry != last; ++entry) {
    for_each_place(leaf, *entry, [&](std::uint32_t place) { ++ends[place + 2]; });
  }
  ends[0] = ends[1] = kCellsPerLeaf + 1;
  for (std::size_t n = 2; n < ends.size(); ++n) ends[n] += ends[n - 1];
  data.resize(ends.back());
  for (auto entry = first; entry != last; ++entry) {
    for_each_place(leaf, *entry, [&](std::uint32_t place) { data[ends[place + 1]++] = entry->triangle; });
  }
  // What was moved to the end of each cell is where the next one begins.
  std::copy_n(ends.begin(), kCellsPerLeaf + 1, data.begin());
}

const CellTriangles::SortedLeaf& CellTriangles::sorted(std::uint32_t leaf) const {
  SortedLeaf& found = sorted_[leaf];
  if (!found.is_sorted.load(std::memory_order_acquire)) {
    std::call_once(found.sorting, [&] {
      sort(leaf, found.data);
      found.is_sorted.store(true, std::memory_order_release);
    });
  }
  return found;
}

ArrayRange<std::uint32_t> CellTriangles::in_cell(const Coord& cell) const {
  const std::uint32_t leaf = in_use_.find(leaf_of(cell));
  if (leaf == LeafIndex::none) return {};
  const std::uint32_t* data = sorted(leaf).data.data();
  const std::uint32_t place = place_in_leaf(cell);
  return {data + data[place], data + data[place + 1]};
}

std::vector<Coord> CellTriangles::cells_outside(const NodeMasks& set) const {
  std::vector<Coord> cells;
  for (const NodeMasks::Leaf& leaf : in_use_.leaves()) {
    const std::uint32_t known = set.find(leaf.origin);
    for (int x = 0; x < kWidth; ++x) {
      const std::uint64_t taken = known == LeafIndex::none ? 0 : set.leaves()[known].words[x];
      for_each_bit(leaf.words[x] & ~taken,
                   [&](int bit) { cells.push_back(leaf.origin.offsetBy(x, bit >> 3, bit & 7)); });
    }
  }
  return cells;
}

}  // namespace particle_surface_tracker
