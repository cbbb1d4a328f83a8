#include "ros/live/mesh_saver.h"

#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "ros/live/save_path.h"

namespace particle_surface_tracker {
namespace {

/// The mesh with the interpolated fields as attributes, as far as their names are free.
TriangleMesh mesh_to_write(const TrackedMesh& message) {
  TriangleMesh mesh = to_triangle_mesh(message);
  for (const InterpolatedField& field : message.interpolated) {
    if (mesh.attributes().find(field.name) != VertexAttributes::none) continue;
    const std::size_t index =
        mesh.attributes().add(field.name, field.components, std::vector<float>(field.components, 0.0f));
    mesh.attributes()[index].values = field.values;
  }
  return mesh;
}

}  // namespace

std::string save_mesh(const std::string& folder, const std::string& name, const TrackedMesh& mesh) {
  std::string path = path_below(folder, name, {".ply", ".obj"});
  make_folders_of(path);
  const TriangleMesh triangles = mesh_to_write(mesh);
  path.compare(path.size() - 4, 4, ".ply") == 0 ? write_ply(path, triangles) : write_obj(path, triangles);
  return path;
}

}  // namespace particle_surface_tracker
