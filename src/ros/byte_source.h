#pragma once

#include <cstdint>
#include <fstream>
#include <string>
#include <vector>

namespace particle_surface_tracker {

/// Bytes that can be read at any position, with every read checked against their number.
class ByteSource {
 public:
  virtual ~ByteSource() = default;

  virtual std::uint64_t size() const = 0;

  /// \return false if there are no `count` bytes at `position`.
  virtual bool read(std::uint64_t position, std::uint64_t count, void* out) const = 0;

  bool has(std::uint64_t position, std::uint64_t count) const {
    return position <= size() && count <= size() - position;
  }
};

/// A file.
class FileBytes : public ByteSource {
 public:
  /// \throw InputError if it cannot be opened.
  explicit FileBytes(const std::string& path);

  std::uint64_t size() const override { return size_; }
  bool read(std::uint64_t position, std::uint64_t count, void* out) const override;

 private:
  mutable std::ifstream file_;
  std::uint64_t size_ = 0;
};

/// A block of memory.
class MemoryBytes : public ByteSource {
 public:
  MemoryBytes() = default;
  explicit MemoryBytes(std::vector<std::uint8_t> bytes);

  std::uint64_t size() const override { return bytes_.size(); }
  bool read(std::uint64_t position, std::uint64_t count, void* out) const override;

 private:
  std::vector<std::uint8_t> bytes_;
};

}  // namespace particle_surface_tracker
