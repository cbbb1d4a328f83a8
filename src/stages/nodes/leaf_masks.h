#pragma once

#include <array>
#include <cstdint>

namespace particle_surface_tracker {

/// One bit per node of a leaf of 8³ nodes, laid out as OpenVDB's masks are: word x, bit 8y + z.
using LeafWords = std::array<std::uint64_t, 8>;

/// Adds the nodes of a mask to another.
inline void add_words(const LeafWords& words, LeafWords& to) {
  for (int x = 0; x < 8; ++x) to[x] |= words[x];
}

/// Masks of a leaf and of its seven neighbours towards larger coordinates; neighbour n is the next one along x, y, z
/// where bits 0, 1, 2 of n are set. Those that are not there are zeros.
using ForwardWords = std::array<const LeafWords*, 8>;

constexpr std::uint64_t kLowestZ = 0x0101010101010101ull;   ///< z = 0 in every row.
constexpr std::uint64_t kHighestZ = 0x8080808080808080ull;  ///< z = 7 in every row.

/// A slice whose bits have moved down by one along z; the bits that come in are those of the next leaf's slice.
constexpr std::uint64_t from_next_z(std::uint64_t word, std::uint64_t next) {
  return (word >> 1 & ~kHighestZ) | (next & kLowestZ) << 7;
}

/// The same along y.
constexpr std::uint64_t from_next_y(std::uint64_t word, std::uint64_t next) {
  return word >> 8 | next << 56;
}

/// For the nodes (y, z) of one slice x in 0 .. 8: the bits of the nodes (y, z), (y + 1, z), (y, z + 1), (y + 1, z + 1).
using SliceCorners = std::array<std::uint64_t, 4>;

inline SliceCorners slice_corners(const ForwardWords& words, int x) {
  const int n = x >> 3;
  const std::uint64_t here = (*words[n])[x & 7];
  const std::uint64_t next_y = (*words[n | 2])[x & 7];
  const std::uint64_t next_z = (*words[n | 4])[x & 7];
  const std::uint64_t up_z = from_next_z(here, next_z);
  const std::uint64_t next_y_up_z = from_next_z(next_y, (*words[n | 6])[x & 7]);
  return {here, from_next_y(here, next_y), up_z, from_next_y(up_z, next_y_up_z)};
}

/// Calls visit(bit) for every bit that is set, from the lowest.
template <typename Visit>
void for_each_bit(std::uint64_t word, Visit&& visit) {
  for (; word != 0; word &= word - 1) visit(__builtin_ctzll(word));
}

}  // namespace particle_surface_tracker
