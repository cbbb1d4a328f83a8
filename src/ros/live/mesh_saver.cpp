#include "ros/live/mesh_saver.h"

#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "ros/live/save_path.h"

namespace particle_surface_tracker {

std::string save_mesh(const std::string& folder, const std::string& name, const TrackedMesh& mesh) {
  std::string path = path_below(folder, name, {".ply", ".obj"});
  make_folders_of(path);
  const TriangleMesh triangles = to_mesh_with_fields(mesh);
  path.compare(path.size() - 4, 4, ".ply") == 0 ? write_ply(path, triangles) : write_obj(path, triangles);
  return path;
}

}  // namespace particle_surface_tracker
