#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "bag_chunk.h"

namespace particle_surface_tracker {

struct BagConnection {
  std::string topic;
  std::string type;
  std::string md5sum;
};

/// Where a message is.
struct BagMessage {
  static constexpr std::size_t outside = static_cast<std::size_t>(-1);

  std::int64_t time_ns = 0;  ///< When it was recorded.
  std::uint32_t connection = 0;
  std::size_t chunk = outside;  ///< `outside`: not in a whole chunk.
  std::uint64_t position = 0;   ///< Of its record, in the unpacked chunk or in the file.
};

/// What a bag holds.
struct BagIndex {
  std::map<std::uint32_t, BagConnection> connections;
  std::vector<BagChunk> chunks;
  std::vector<BagMessage> messages;  ///< In the order of the file.
  std::vector<std::string> damage;   ///< What could not be read, in words.
};

/// Walks through the records of a bag of format 2.0. Chunks are unpacked only where the bag's own index does not say
/// what they hold, so for a bag that was closed properly this takes no time; for one that was not, all chunks before
/// the cut are still found. Unlike rosbag's own reader this one believes no length that it has not checked.
/// \throw InputError if the file is not such a bag, or encrypted.
BagIndex read_bag_index(const ByteSource& file);

/// The time of a message record, as in BagMessage, or nothing if the record is not one.
std::optional<std::int64_t> message_time(const BagRecord& record);

}  // namespace particle_surface_tracker
