#include "particle_surface_tracker/io/vdb_sequence.h"

#include <openvdb/tools/SignedFloodFill.h>

#include <utility>

#include <fmt/format.h>

#include "file_bytes.h"
#include "sequence_folder.h"
#include "vdb_bytes.h"

namespace particle_surface_tracker {
namespace {

openvdb::FloatGrid::Ptr level_set_of(const ImplicitSurface& surface) {
  openvdb::FloatGrid::Ptr grid = surface.field->deepCopy();
  grid->setName("phi");
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(surface.dx));
  // The nodes well inside are not there; readers want them to be negative.
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

}  // namespace

void write_vdb(const std::string& path, const ImplicitSurface& surface) {
  openvdb::initialize();
  write_file_whole(path, vdb_bytes({level_set_of(surface)}));
}

VdbSequence::VdbSequence(std::string folder) : folder_(std::move(folder)) {
  make_sequence_folder(folder_);
}

void VdbSequence::write(const ImplicitSurface& surface, std::uint64_t frame) const {
  write_vdb(frame_file(folder_, frame, "vdb"), surface);
}

}  // namespace particle_surface_tracker
