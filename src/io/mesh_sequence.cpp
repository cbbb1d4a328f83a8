#include "particle_surface_tracker/io/mesh_sequence.h"

#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/gltf_writer.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/io/vtp_writer.h"
#include "sequence_folder.h"

namespace particle_surface_tracker {
namespace {

struct FileFormat {
  const char* extension;
  void (*write)(const std::string& path, const TriangleMesh& mesh);
};

FileFormat file_format(MeshFormat format) {
  switch (format) {
    case MeshFormat::kPly:
      return {"ply", write_ply};
    case MeshFormat::kObj:
      return {"obj", write_obj};
    case MeshFormat::kVtp:
      return {"vtp", write_vtp};
    case MeshFormat::kGlb:
      return {"glb", write_glb};
  }
  throw OutputError(fmt::format("there is no mesh format {}", static_cast<int>(format)));
}

}  // namespace

MeshSequence::MeshSequence(std::string folder, MeshFormat format) : folder_(std::move(folder)), format_(format) {
  make_sequence_folder(folder_);
}

std::string MeshSequence::path(std::uint64_t frame) const {
  return frame_file(folder_, frame, file_format(format_).extension);
}

void MeshSequence::write(const TriangleMesh& mesh, std::uint64_t frame) const {
  file_format(format_).write(path(frame), mesh);
}

}  // namespace particle_surface_tracker
