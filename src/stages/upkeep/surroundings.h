#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "editable_surface.h"

namespace particle_surface_tracker {

/// Finds the triangles near a place. Lattices of cells that double in size, each triangle in one cell of the lattice
/// whose cells are just larger than it: entering one is a single step however large it is, and a search
/// looks at a few cells of each lattice in use. The cells are slots of a hash table.
class Surroundings {
 public:
  /// Enters all triangles of a surface.
  /// \param smallest_cell side of the finest cells [m].
  Surroundings(const EditableSurface& surface, double smallest_cell);

  /// Enters a triangle that is new or has changed.
  void enter(std::uint32_t triangle);

  /// Calls visit(triangle) for triangles whose box meets `box`, and for a few that have moved since; some maybe twice.
  template <typename Visit>
  void for_each_near(const Eigen::AlignedBox3f& box, Visit&& visit) const {
    for (std::size_t level = 0; level < kLevels; ++level) {
      if (!level_in_use_[level]) continue;
      // A triangle reaches from its cell into the next at most.
      const Cell first = cell_of(box.min(), level), last = cell_of(box.max(), level);
      if (has_more_cells_than_entries(first, last)) {
        for (const Entry& entry : first_entries_) visit_entry(entry, box, visit);
        for (const LaterEntry& later : later_entries_) visit_entry(later.entry, box, visit);
        return;
      }
      for (std::int64_t y = first[1] - 1; y <= last[1]; ++y) {
        for (std::int64_t z = first[2] - 1; z <= last[2]; ++z) {
          const std::uint64_t row = row_of(y, z, level);
          for (std::int64_t x = first[0] - 1; x <= last[0]; ++x) visit_slot(slot_of(row, x), box, visit);
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

  struct LaterEntry {
    Entry entry;
    std::uint32_t next;  // in the same slot, or kEnd
  };

  struct Slot {
    std::uint32_t begin;  // of the first entries; they end where the next slot's begin
    std::uint32_t later;  // the last entered of the others, or kEnd
  };

  struct Place {
    Entry entry;
    std::uint32_t level;
    std::uint32_t slot;
  };

  Place place_of(std::uint32_t triangle) const;

  template <typename Visit>
  void visit_slot(std::size_t slot, const Eigen::AlignedBox3f& box, Visit& visit) const {
    for (std::uint32_t e = slots_[slot].begin; e != slots_[slot + 1].begin; ++e) {
      visit_entry(first_entries_[e], box, visit);
    }
    for (std::uint32_t e = slots_[slot].later; e != kEnd; e = later_entries_[e].next) {
      visit_entry(later_entries_[e].entry, box, visit);
    }
  }

  template <typename Visit>
  void visit_entry(const Entry& entry, const Eigen::AlignedBox3f& box, Visit& visit) const {
    if (entry.box.intersects(box) && surface_.is_alive(entry.triangle)) visit(entry.triangle);
  }

  bool has_more_cells_than_entries(const Cell& first, const Cell& last) const;
  Cell cell_of(const Vec3f& position, std::size_t level) const;
  /// Cells that follow each other along x have slots that follow each other: a search reads a row of them at once.
  std::size_t slot_of(std::uint64_t row, std::int64_t x) const {
    return (row + static_cast<std::uint64_t>(x)) & slot_mask_;
  }
  static std::uint64_t row_of(std::int64_t y, std::int64_t z, std::size_t level);

  const EditableSurface& surface_;
  std::array<double, kLevels> inverse_cell_size_{};
  std::array<bool, kLevels> level_in_use_{};
  std::uint64_t slot_mask_;
  std::vector<Slot> slots_;  // and one more, where the first entries end
  /// Those of the constructor, by slot: what is searched together lies together.
  std::vector<Entry> first_entries_;
  std::vector<LaterEntry> later_entries_;
};

}  // namespace particle_surface_tracker
