#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "editable_surface.h"

namespace particle_surface_tracker {

/// Finds the triangles near a place. Lattices of cells that double in size, each triangle in one cell of the lattice
/// whose cells are just larger than it: entering one is a single step however large it is, and a search
/// looks at a few cells of each lattice in use. What is there from the start lies in the order of the cells, so that a
/// row of cells is read at once; what is entered later hangs in chains.
class Surroundings {
 public:
  /// Enters all triangles of a surface.
  /// \param smallest_cell side of the finest cells [m].
  Surroundings(const EditableSurface& surface, double smallest_cell);

  /// Enters a triangle that is new or has changed.
  void enter(std::uint32_t triangle);

  /// Calls visit(triangle) for triangles whose box meets `box`, and for a few that have moved since; some maybe twice,
  /// in no order that means anything.
  template <typename Visit>
  void for_each_near(const Eigen::AlignedBox3f& box, Visit&& visit) const {
    for (std::size_t level = 0; level < kLevels; ++level) {
      if (!level_in_use_[level]) continue;
      // A triangle reaches from its cell into the next at most.
      const Cell first = cell_of(box.min(), level), last = cell_of(box.max(), level);
      if (has_more_cells_than_entries(first, last)) {
        for (const Entry& entry : first_entries_) visit_entry(entry, box, visit);
        for (const Link& link : later_entries_) visit_entry(link.entry, box, visit);
        return;
      }
      for (std::int64_t y = first[1] - 1; y <= last[1]; ++y) {
        for (std::int64_t z = first[2] - 1; z <= last[2]; ++z) {
          const std::size_t begin = slot_of(row_of(y, z, level), first[0] - 1);
          const std::size_t count = std::min(static_cast<std::size_t>(last[0] - first[0] + 2), heads_.size());
          visit_slots(begin, std::min(begin + count, heads_.size()), box, visit);
          // The table is a ring.
          if (begin + count > heads_.size()) visit_slots(0, begin + count - heads_.size(), box, visit);
        }
      }
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::size_t kLevels = 40;
  static constexpr std::uint32_t kEnd = 0xffffffffU;

  struct Entry {
    Eigen::AlignedBox3f box;  // when it was entered; a triangle that has changed is entered anew
    std::uint32_t triangle;
  };

  struct Link {
    Entry entry;
    std::uint32_t next;
  };

  /// An entry, and where it belongs.
  struct Placed {
    Entry entry;
    std::size_t slot;
    std::size_t level;
  };

  template <typename Visit>
  void visit_entry(const Entry& entry, const Eigen::AlignedBox3f& box, Visit& visit) const {
    if (entry.box.intersects(box) && surface_.is_alive(entry.triangle)) visit(entry.triangle);
  }

  template <typename Visit>
  void visit_slots(std::size_t begin, std::size_t end, const Eigen::AlignedBox3f& box, Visit& visit) const {
    for (std::uint32_t e = begins_[begin]; e < begins_[end]; ++e) visit_entry(first_entries_[e], box, visit);
    for (std::size_t slot = begin; slot < end; ++slot) {
      for (std::uint32_t e = heads_[slot]; e != kEnd; e = later_entries_[e].next) {
        visit_entry(later_entries_[e].entry, box, visit);
      }
    }
  }

  void enter_first();
  Placed placed(std::uint32_t triangle) const;
  bool has_more_cells_than_entries(const Cell& first, const Cell& last) const;
  Cell cell_of(const Vec3f& position, std::size_t level) const;
  /// Cells that follow each other along x have slots that follow each other: a search reads a row of them at once.
  std::size_t slot_of(std::uint64_t row, std::int64_t x) const {
    return (row + static_cast<std::uint64_t>(x)) & (heads_.size() - 1);
  }
  static std::uint64_t row_of(std::int64_t y, std::int64_t z, std::size_t level);

  const EditableSurface& surface_;
  std::array<double, kLevels> inverse_cell_size_{};
  std::array<bool, kLevels> level_in_use_{};
  std::vector<std::uint32_t> begins_;  // in first_entries_, one per slot of a hash table and one more
  std::vector<Entry> first_entries_;
  std::vector<std::uint32_t> heads_;  // of chains of later entries, one per slot
  std::vector<Link> later_entries_;
};

}  // namespace particle_surface_tracker
