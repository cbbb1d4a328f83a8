#include "byte_source.h"

#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

FileBytes::FileBytes(const std::string& path) : file_(path, std::ios::binary) {
  if (!file_) throw InputError(fmt::format("cannot open '{}': {}", path, std::strerror(errno)));
  // A folder opens like a file, but its end cannot be found.
  const auto end = file_.seekg(0, std::ios::end).tellg();
  if (!file_ || !file_.seekg(0) || file_.peek() == std::ifstream::traits_type::eof()) {
    throw InputError(fmt::format("cannot read '{}': it is empty or no file", path));
  }
  size_ = static_cast<std::uint64_t>(end);
}

bool FileBytes::read(std::uint64_t position, std::uint64_t count, void* out) const {
  if (!has(position, count)) return false;
  file_.clear();
  file_.seekg(static_cast<std::streamoff>(position));
  file_.read(static_cast<char*>(out), static_cast<std::streamsize>(count));
  return static_cast<bool>(file_);
}

MemoryBytes::MemoryBytes(std::vector<std::uint8_t> bytes) : bytes_(std::move(bytes)) {}

bool MemoryBytes::read(std::uint64_t position, std::uint64_t count, void* out) const {
  if (!has(position, count)) return false;
  if (count != 0) std::memcpy(out, bytes_.data() + position, count);
  return true;
}

}  // namespace particle_surface_tracker
