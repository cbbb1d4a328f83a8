#include "ros/live/input_place.h"

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/byte_stream.h"

namespace particle_surface_tracker {

std::string to_bytes(const InputPlace& place) {
  ByteWriter bytes;
  place.sequence.put(bytes);
  bytes.put(place.run);
  bytes.put(place.start.stamp_ns);
  bytes.put(place.start.checksum);
  return bytes.bytes();
}

InputPlace input_place_from(const std::string& bytes) try {
  ByteReader reader(bytes);
  InputPlace place;
  place.sequence = InputSequence::take(reader);
  place.run = reader.number<std::uint32_t>("number of the run");
  place.start.stamp_ns = reader.number<std::int64_t>("stamp of the first frame");
  place.start.checksum = reader.number<std::uint32_t>("checksum of the first frame");
  reader.expect_end();
  return place;
} catch (const InputError& error) {
  throw InputError(fmt::format("the checkpoint's place in the input is damaged: {}", error.what()));
}

}  // namespace particle_surface_tracker
