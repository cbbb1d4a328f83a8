#pragma once

#include <particle_surface_tracker/TrackedMesh.h>
#include <std_msgs/Header.h>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// The message that carries a tracked mesh, with its colours and texture coordinates where it has them.
TrackedMesh to_tracked_mesh(const std_msgs::Header& header, const TriangleMesh& mesh, std::uint32_t topology_version);

/// The mesh that a message carries, with what to_tracked_mesh() puts into it.
/// \throw InputError if the arrays of the message do not fit each other.
/// \throw MeshError as TriangleMesh.
TriangleMesh to_triangle_mesh(const TrackedMesh& message);

/// The mesh of a message as files hold it: with everything else that the message has as attributes. These are `normal`,
/// `vertex_velocity` [m/s], and the interpolated fields under their own names, or with `particle_` before it where the
/// mesh has something of that name itself; of their characters, those but letters, digits, `.` and `-` become `_`.
/// \throw InputError, MeshError as to_triangle_mesh().
TriangleMesh to_mesh_with_fields(const TrackedMesh& message);

}  // namespace particle_surface_tracker
