#pragma once

#include <string>

#include <openvdb/Grid.h>

namespace particle_surface_tracker {

/// The content of an OpenVDB file; the same grids give the same bytes.
std::string vdb_bytes(const openvdb::GridCPtrVec& grids);

}  // namespace particle_surface_tracker
