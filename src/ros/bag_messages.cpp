#include "bag_messages.h"

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

const MemoryBytes& BagMessages::unpacked(std::size_t chunk) {
  if (chunk != unpacked_chunk_) {
    unpacked_chunk_ = BagMessage::outside;
    unpacked_bytes_ = read_chunk(file_, index_.chunks[chunk]);
    unpacked_chunk_ = chunk;
  }
  return unpacked_bytes_;
}

std::vector<std::uint8_t> BagMessages::read(const BagMessage& message) {
  const bool in_chunk = message.chunk != BagMessage::outside;
  const ByteSource& source = in_chunk ? static_cast<const ByteSource&>(unpacked(message.chunk)) : file_;
  const auto record = read_record(source, message.position);
  if (!record || message_time(*record) != message.time_ns ||
      record->fields.number<std::uint32_t>("conn") != message.connection) {
    throw InputError("the message is not where the index of the bag says");
  }
  if (!source.has(record->data_begin, record->data_size)) {
    throw InputError("the message reaches beyond the end of its chunk");
  }
  std::vector<std::uint8_t> bytes(record->data_size);
  if (!source.read(record->data_begin, bytes.size(), bytes.data())) throw InputError("the message cannot be read");
  return bytes;
}

}  // namespace particle_surface_tracker
