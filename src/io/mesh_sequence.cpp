#include "particle_surface_tracker/io/mesh_sequence.h"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

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

MeshSequence::MeshSequence(std::string folder, MeshFormat format, std::optional<std::uint64_t> next)
    : folder_(std::move(folder)), format_(format) {
  make_sequence_folder(folder_);
  if (format_ != MeshFormat::kVtp) return;
  if (next) {
    series_.emplace(folder_, *next);
  } else {
    series_.emplace(folder_);
  }
}

void MeshSequence::write(const TriangleMesh& mesh, std::uint64_t frame, std::int64_t stamp_ns) {
  const FileFormat format = file_format(format_);
  const std::string path = frame_file(folder_, frame, format.extension);
  format.write(path, mesh);
  const std::string name = std::filesystem::path(path).filename().string();
  written_.insert(name);
  if (series_) series_->add(name, stamp_ns);
}

std::size_t MeshSequence::count_of_others() const {
  const std::vector<std::string> names = frame_files(folder_, file_format(format_).extension);
  return static_cast<std::size_t>(
      std::count_if(names.begin(), names.end(), [&](const std::string& name) { return written_.count(name) == 0; }));
}

}  // namespace particle_surface_tracker
