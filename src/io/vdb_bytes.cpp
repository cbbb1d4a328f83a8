#include "vdb_bytes.h"

#include <openvdb/io/Stream.h>

#include <cstdint>
#include <sstream>
#include <string_view>

#include <fmt/format.h>

namespace particle_surface_tracker {
namespace {

std::uint64_t fnv1a(std::string_view bytes, std::uint64_t start) {
  std::uint64_t hash = start;
  for (const char byte : bytes) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3ULL;
  return hash;
}

/// OpenVDB puts a random id into every file, by which a reader knows that a file has changed. Made from the content, it
/// does the same, and the same content has the same bytes.
void settle_id(std::string& bytes) {
  constexpr std::size_t kBegin = 21, kLength = 36;  // Behind magic number, three versions and a flag.
  if (bytes.size() < kBegin + kLength || bytes[kBegin + 8] != '-' || bytes[kBegin + 23] != '-') return;
  const std::string_view content = std::string_view(bytes).substr(kBegin + kLength);
  const std::uint64_t first = fnv1a(content, 0xcbf29ce484222325ULL), second = fnv1a(content, ~0xcbf29ce484222325ULL);
  const std::string id = fmt::format("{:08x}-{:04x}-{:04x}-{:04x}-{:012x}", first >> 32, (first >> 16) & 0xffff,
                                     first & 0xffff, second >> 48, second & 0xffffffffffffULL);
  bytes.replace(kBegin, kLength, id);
}

}  // namespace

std::string vdb_bytes(const openvdb::GridCPtrVec& grids) {
  std::ostringstream stream(std::ios::binary);
  openvdb::io::Stream(stream).write(grids);
  std::string bytes = stream.str();
  settle_id(bytes);
  return bytes;
}

}  // namespace particle_surface_tracker
