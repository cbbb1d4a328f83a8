#include "file_check.h"

#include <utility>

#include "particle_surface_tracker/io/raw_mesh_reader.h"

namespace particle_surface_tracker {

FileCheck check_file(const std::string& path) {
  const RawMesh mesh = read_raw_mesh(path);
  const WeldedTriangles welded = weld_by_position(mesh.positions, mesh.triangles);
  // Vertices that were joined to others are unused then, which is no defect.
  MeshCheckOptions joined;
  joined.unused_vertices = false;

  FileCheck check;
  check.path = path;
  check.has_indices = mesh.has_indices;
  if (!mesh.has_indices) {
    check.mesh = check_mesh(mesh.positions, welded.triangles, joined);
    return check;
  }
  check.mesh = check_mesh(mesh.positions, mesh.triangles);
  check.merged_vertices = welded.merged_vertices;
  if (welded.merged_vertices > 0) check.welded = check_mesh(mesh.positions, welded.triangles, joined);
  return check;
}

bool is_sound(const FileCheck& check, double max_self_intersecting_share) {
  return check.mesh.triangles > 0 && check.mesh.is_sound(max_self_intersecting_share) &&
         (!check.welded || check.welded->is_sound(max_self_intersecting_share));
}

}  // namespace particle_surface_tracker
