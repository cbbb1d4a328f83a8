#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "bag_index.h"

namespace particle_surface_tracker {

/// The messages of a bag, as bytes.
class BagMessages {
 public:
  /// \throw InputError as FileBytes and read_bag_index().
  explicit BagMessages(const std::string& path) : file_(path), index_(read_bag_index(file_)) {}

  const BagIndex& index() const { return index_; }

  /// \param message of index().
  /// \throw InputError if it cannot be read.
  std::vector<std::uint8_t> read(const BagMessage& message);

 private:
  const MemoryBytes& unpacked(std::size_t chunk);

  FileBytes file_;
  BagIndex index_;
  std::size_t unpacked_chunk_ = BagMessage::outside;
  MemoryBytes unpacked_bytes_;
};

}  // namespace particle_surface_tracker
