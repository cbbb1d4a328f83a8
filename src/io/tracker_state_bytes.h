#pragma once

#include "particle_surface_tracker/io/byte_stream.h"
#include "particle_surface_tracker/tracker/tracker_state.h"

namespace particle_surface_tracker {

void put_tracker_state(ByteWriter& bytes, const TrackerState& state);

/// \throw InputError if the bytes are no state; \throw ParameterError, MeshError as set_parameter(), TriangleMesh and
/// VertexAttributes. Whether the parts fit each other is for check_tracker_state() to say.
TrackerState read_tracker_state(ByteReader& bytes);

}  // namespace particle_surface_tracker
