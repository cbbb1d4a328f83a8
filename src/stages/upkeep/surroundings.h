#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "editable_surface.h"
#include "packed_box.h"

namespace particle_surface_tracker {

/// Finds the triangles near a place. Lattices of cells that double in size, each triangle in one cell of the lattice
/// whose cells are just larger than it: entering one is a single step however large it is, and a search
/// looks at a few cells of each lattice in use. Blocks of 4³ cells are slots of a hash table: a search, which has few
/// of them, finds what it needs side by side in memory.
class Surroundings {
 public:
  struct Entry {
    PackedBox box;  ///< When it was entered; a triangle that changes is entered anew.
    std::uint32_t triangle;
  };

  /// Enters all triangles of a surface.
  /// \param smallest_cell side of the finest cells [m].
  Surroundings(const EditableSurface& surface, double smallest_cell);

  /// Enters a triangle that is new or has changed.
  void enter(std::uint32_t triangle);

  /// Calls visit(entry) for all entries whose box meets `box`, now and then twice, also for those of triangles that
  /// have changed since they were entered or are gone.
  template <typename Visit>
  void for_each_near(const Eigen::AlignedBox3f& box, Visit&& visit) const {
    const BoxQuery query(box);
    for (std::size_t level = 0; level < kLevels; ++level) {
      if (!level_in_use_[level]) continue;
      // A triangle reaches from its cell into the next at most.
      const Cell first = cell_of(box.min(), level), last = cell_of(box.max(), level);
      if (has_more_cells_than_entries(first, last)) {
        for (const Entry& entry : first_entries_) visit_entry(entry, query, visit);
        for (const LaterEntry& later : later_entries_) visit_entry(later.entry, query, visit);
        return;
      }
      for_each_row({first[0] - 1, first[1] - 1, first[2] - 1}, last, level,
                   [&](std::size_t slot, std::size_t length) { visit_slots(slot, length, query, visit); });
    }
  }

 private:
  using Cell = std::array<std::int64_t, 3>;
  static constexpr std::size_t kLevels = 40;
  static constexpr std::uint32_t kEnd = 0xffffffffU;

  /// Cells of a block along an axis, as a power of 2.
  static constexpr int kBlockBits = 2;
  static constexpr std::int64_t kBlockSide = std::int64_t{1} << kBlockBits;

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
  Entry& entry_at(std::uint32_t index);

  /// Calls visit(first slot, number of slots) for the rows of cells along x in each block, for a box of cells.
  template <typename Visit>
  void for_each_row(const Cell& first, const Cell& last, std::size_t level, Visit&& visit) const {
    // Shifts of signed numbers round down.
    for (std::int64_t z0 = first[2] >> kBlockBits; z0 <= last[2] >> kBlockBits; ++z0) {
      for (std::int64_t y0 = first[1] >> kBlockBits; y0 <= last[1] >> kBlockBits; ++y0) {
        for (std::int64_t x0 = first[0] >> kBlockBits; x0 <= last[0] >> kBlockBits; ++x0) {
          const std::size_t slot = first_slot_of({x0, y0, z0}, level);
          const Cell begin = {x0 * kBlockSide, y0 * kBlockSide, z0 * kBlockSide};
          const std::int64_t x = std::max(first[0], begin[0]), x_end = std::min(last[0] + 1, begin[0] + kBlockSide);
          const std::int64_t z_end = std::min(last[2] + 1, begin[2] + kBlockSide);
          const std::int64_t y_end = std::min(last[1] + 1, begin[1] + kBlockSide);
          for (std::int64_t z = std::max(first[2], begin[2]); z < z_end; ++z) {
            for (std::int64_t y = std::max(first[1], begin[1]); y < y_end; ++y) {
              visit(slot + slot_in_block({x, y, z}), static_cast<std::size_t>(x_end - x));
            }
          }
        }
      }
    }
  }

  template <typename Visit>
  void visit_slots(std::size_t slot, std::size_t count, const BoxQuery& query, Visit& visit) const {
    for (std::uint32_t e = slots_[slot].begin; e != slots_[slot + count].begin; ++e) {
      visit_entry(first_entries_[e], query, visit);
    }
    for (std::size_t s = slot; s < slot + count; ++s) {
      for (std::uint32_t e = slots_[s].later; e != kEnd; e = later_entries_[e].next) {
        visit_entry(later_entries_[e].entry, query, visit);
      }
    }
  }

  template <typename Visit>
  void visit_entry(const Entry& entry, const BoxQuery& query, Visit& visit) const {
    if (query.meets(entry.box)) visit(entry);
  }

  bool has_more_cells_than_entries(const Cell& first, const Cell& last) const;
  Cell cell_of(const Vec3f& position, std::size_t level) const;
  /// \param block position in units of blocks.
  std::size_t first_slot_of(const Cell& block, std::size_t level) const;
  static std::size_t slot_in_block(const Cell& cell);

  const EditableSurface& surface_;
  std::array<double, kLevels> inverse_cell_size_{};
  std::array<bool, kLevels> level_in_use_{};
  std::uint64_t block_mask_;
  std::vector<Slot> slots_;  // and one more, where the first entries end
  /// Those of the constructor, by slot: what is searched together lies together.
  std::vector<Entry> first_entries_;
  std::vector<LaterEntry> later_entries_;

  /// Where the last entry of each triangle is.
  struct LastEntry {
    std::uint32_t slot;
    std::uint32_t index;  // of the first entries, then of the later ones
  };
  std::vector<LastEntry> last_entries_;
};

}  // namespace particle_surface_tracker
