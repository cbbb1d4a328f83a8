#pragma once

#include <cstdint>
#include <string>

#include "bag_record.h"

namespace particle_surface_tracker {

/// A block of a bag that holds messages, as a whole compressed or not.
struct BagChunk {
  std::uint64_t data_begin = 0;  ///< In the file.
  std::uint32_t stored_size = 0;
  std::uint32_t size = 0;  ///< Once unpacked.
  std::string compression;
};

/// Unpacks a chunk.
/// \throw InputError that says what is wrong with it.
MemoryBytes read_chunk(const ByteSource& file, const BagChunk& chunk);

}  // namespace particle_surface_tracker
