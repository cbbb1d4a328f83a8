#pragma once

#include <particle_surface_tracker/TrackedMesh.h>
#include <std_msgs/Header.h>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// The message that carries a tracked mesh, with its colours and texture coordinates where it has them.
TrackedMesh to_tracked_mesh(const std_msgs::Header& header, const TriangleMesh& mesh, std::uint32_t topology_version);

}  // namespace particle_surface_tracker
