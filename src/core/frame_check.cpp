#include "particle_surface_tracker/core/frame_check.h"

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_check.h"

namespace particle_surface_tracker {

void check_frame(const TriangleMesh& mesh, FrameReport& report) {
  const MeshCheck check = check_mesh(mesh.positions(), mesh.triangles());
  if (!check.defects.none()) {
    throw TrackingError("the tracked mesh has defects: " + describe(list_defects(check.defects)));
  }
  report.self_intersecting_triangles = check.self_intersecting_share();
  const std::string nesting = describe(list_nesting_defects(check));
  if (!nesting.empty()) report.warnings.push_back(nesting);
}

}  // namespace particle_surface_tracker
