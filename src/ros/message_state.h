#pragma once

#include <cstdint>
#include <string>

#include <std_msgs/Header.h>

#include "vertex_velocities.h"

namespace particle_surface_tracker {

/// What the message of a tracked frame says beside the mesh, and what that of the next frame needs to know.
struct MessageState {
  std_msgs::Header header;             ///< Of the last cloud.
  double seconds = 0.0;                ///< Between the last frame and the one before; 0 if there is none.
  VertexPlaces before;                 ///< Of the frame before the last.
  std::uint32_t topology_version = 0;  ///< Of the last message.
};

/// Name of the section of a checkpoint.
constexpr const char* message_section = "message";

std::string to_bytes(const MessageState& state);

/// \throw InputError if the bytes are none of to_bytes().
MessageState message_state_from(const std::string& bytes);

}  // namespace particle_surface_tracker
