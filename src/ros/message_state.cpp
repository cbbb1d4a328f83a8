#include "message_state.h"

#include <cmath>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/byte_stream.h"

namespace particle_surface_tracker {

std::string to_bytes(const MessageState& state) {
  ByteWriter bytes;
  bytes.put(state.header.seq);
  bytes.put(state.header.stamp.sec);
  bytes.put(state.header.stamp.nsec);
  bytes.put(std::string_view(state.header.frame_id));
  bytes.put(state.seconds);
  bytes.put(state.before.ids);
  bytes.put(state.before.positions);
  bytes.put(state.topology_version);
  return bytes.bytes();
}

MessageState message_state_from(const std::string& bytes) {
  ByteReader reader(bytes);
  MessageState state;
  state.header.seq = reader.number<std::uint32_t>("sequence number");
  state.header.stamp.sec = reader.number<std::uint32_t>("stamp");
  state.header.stamp.nsec = reader.number<std::uint32_t>("stamp");
  state.header.frame_id = reader.text("frame_id");
  state.seconds = reader.number<double>("time between frames");
  state.before.ids = reader.numbers<std::uint32_t>("id");
  state.before.positions = reader.triples<Vec3f, float>("position");
  state.topology_version = reader.number<std::uint32_t>("topology version");
  reader.expect_end();
  if (state.before.ids.size() != state.before.positions.size() || !std::isfinite(state.seconds)) {
    throw InputError("the checkpoint's message state does not fit together");
  }
  return state;
}

}  // namespace particle_surface_tracker
