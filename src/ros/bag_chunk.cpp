#include "bag_chunk.h"

#include <limits>
#include <utility>
#include <vector>

#include <bzlib.h>
#include <fmt/format.h>
#include <roslz4/lz4s.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

using Bytes = std::vector<std::uint8_t>;

[[noreturn]] void fail(const BagChunk& chunk, const std::string& reason) {
  throw InputError(fmt::format("the chunk at byte {} of the bag is damaged: {}", chunk.data_begin, reason));
}

// Both libraries take char and lengths that must fit an int, and say how much they wrote.
template <typename Unpack>
Bytes unpacked(const BagChunk& chunk, Bytes& stored, Unpack&& unpack) {
  constexpr std::uint32_t largest = std::numeric_limits<int>::max();
  if (chunk.size > largest || chunk.stored_size > largest) fail(chunk, "its size is absurd");
  Bytes out(chunk.size);
  unsigned int written = chunk.size;
  const bool good = unpack(reinterpret_cast<char*>(stored.data()), static_cast<unsigned int>(stored.size()),
                           reinterpret_cast<char*>(out.data()), &written);
  if (!good || written != chunk.size) fail(chunk, fmt::format("it does not unpack ({})", chunk.compression));
  return out;
}

bool unpack_bz2(char* in, unsigned int in_size, char* out, unsigned int* out_size) {
  return BZ2_bzBuffToBuffDecompress(out, out_size, in, in_size, /*small*/ 0, /*verbosity*/ 0) == BZ_OK;
}

bool unpack_lz4(char* in, unsigned int in_size, char* out, unsigned int* out_size) {
  return roslz4_buffToBuffDecompress(in, in_size, out, out_size) == ROSLZ4_OK;
}

}  // namespace

MemoryBytes read_chunk(const ByteSource& file, const BagChunk& chunk) {
  if (!file.has(chunk.data_begin, chunk.stored_size)) fail(chunk, "it reaches beyond the end of the file");
  Bytes stored(chunk.stored_size);
  if (!file.read(chunk.data_begin, stored.size(), stored.data())) fail(chunk, "it cannot be read");
  if (chunk.compression == "none") return MemoryBytes(std::move(stored));
  if (chunk.compression == "bz2") return MemoryBytes(unpacked(chunk, stored, unpack_bz2));
  if (chunk.compression == "lz4") return MemoryBytes(unpacked(chunk, stored, unpack_lz4));
  fail(chunk, fmt::format("its compression '{}' is none of none, bz2, lz4", chunk.compression));
}

}  // namespace particle_surface_tracker
