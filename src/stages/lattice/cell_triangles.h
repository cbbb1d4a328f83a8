#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "lattice_mesh.h"
#include "stages/nodes/node_masks.h"

namespace particle_surface_tracker {

/// The triangles of each cell. First they are only sorted into leaves of 8³ cells; those of a leaf are sorted into its
/// cells when one of them is asked for, since most leaves never are. Safe to ask from several threads at once.
class CellTriangles {
 public:
  /// \param mesh must outlive this object.
  explicit CellTriangles(const LatticeMesh& mesh);

  /// Increasing indices of the triangles that meet a cell, and of small ones whose bounding box does.
  ArrayRange<std::uint32_t> in_cell(const openvdb::Coord& cell) const;

  /// Cells with triangles, but for those of a set.
  std::vector<openvdb::Coord> cells_outside(const NodeMasks& set) const;

 private:
  /// A triangle in a leaf.
  struct Entry {
    std::uint32_t triangle;
    std::uint32_t place;  ///< Of the cell in the leaf, or kWholeBox.
  };

  /// The triangles of a leaf, cell by cell, behind 513 numbers that say where those of each cell begin.
  struct SortedLeaf {
    std::atomic<bool> is_sorted{false};
    std::once_flag sorting;
    std::vector<std::uint32_t> data;
  };

  const SortedLeaf& sorted(std::uint32_t leaf) const;
  void sort(std::uint32_t leaf, std::vector<std::uint32_t>& data) const;
  /// Calls visit(place) for the cells of an entry.
  template <typename Visit>
  void for_each_place(std::uint32_t leaf, const Entry& entry, Visit&& visit) const;

  const LatticeMesh& mesh_;
  NodeMasks in_use_;                // cells with triangles
  std::vector<std::size_t> begin_;  // per leaf: of its entries; and where the last ones end
  std::vector<Entry> entries_;
  std::unique_ptr<SortedLeaf[]> sorted_;  // per leaf
};

}  // namespace particle_surface_tracker
