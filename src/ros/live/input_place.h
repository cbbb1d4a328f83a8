#pragma once

#include <cstdint>
#include <string>

#include "ros/input_sequence.h"

namespace particle_surface_tracker {

/// How far a run of the live node has got in its input.
struct InputPlace {
  InputSequence sequence;
  std::uint32_t run = 0;  ///< As in TrackerStatus.

  /// The frame that the run began with.
  struct Start {
    std::int64_t stamp_ns = 0;
    std::uint32_t checksum = 0;  ///< CRC-32 of the data of its cloud.
  };
  Start start;
};

/// Name of the section of a checkpoint.
constexpr const char* input_section = "node";

std::string to_bytes(const InputPlace& place);

/// \throw InputError if the bytes are none of to_bytes().
InputPlace input_place_from(const std::string& bytes);

}  // namespace particle_surface_tracker
