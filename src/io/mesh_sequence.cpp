#include "particle_surface_tracker/io/mesh_sequence.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/gltf_writer.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/io/vtp_writer.h"

namespace particle_surface_tracker {
namespace {

// Asking for permissions is not enough: file systems may be read-only or full, and root may do anything.
void try_writing(const std::filesystem::path& folder) {
  const std::filesystem::path probe = folder / ".write_test";
  std::ofstream file(probe);
  file << "x" << std::flush;
  const bool written = static_cast<bool>(file);
  const int reason = errno;
  file.close();
  std::error_code ignored;
  std::filesystem::remove(probe, ignored);
  if (!written)
    throw OutputError(fmt::format("cannot write in folder '{}': {}", folder.string(), std::strerror(reason)));
}

const char* extension_of(MeshFormat format) {
  switch (format) {
    case MeshFormat::kObj:
      return "obj";
    case MeshFormat::kVtp:
      return "vtp";
    case MeshFormat::kGlb:
      return "glb";
    case MeshFormat::kPly:
    case MeshFormat::kNone:
      break;
  }
  return "ply";
}

}  // namespace

MeshSequence::MeshSequence(std::string folder, MeshFormat format) : folder_(std::move(folder)), format_(format) {
  if (format_ == MeshFormat::kNone) return;
  std::error_code error;
  std::filesystem::create_directories(folder_, error);
  if (error) throw OutputError(fmt::format("cannot make folder '{}': {}", folder_, error.message()));
  try_writing(folder_);
}

std::string MeshSequence::path(std::uint64_t frame) const {
  return (std::filesystem::path(folder_) / fmt::format("frame_{:06}.{}", frame, extension_of(format_))).string();
}

void MeshSequence::write(const TriangleMesh& mesh, std::uint64_t frame) const {
  switch (format_) {
    case MeshFormat::kPly:
      write_ply(path(frame), mesh);
      break;
    case MeshFormat::kObj:
      write_obj(path(frame), mesh);
      break;
    case MeshFormat::kVtp:
      write_vtp(path(frame), mesh);
      break;
    case MeshFormat::kGlb:
      write_glb(path(frame), mesh);
      break;
    case MeshFormat::kNone:
      break;
  }
}

}  // namespace particle_surface_tracker
