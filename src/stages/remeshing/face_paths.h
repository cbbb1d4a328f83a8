#pragma once

#include <unordered_map>
#include <vector>

#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "triangle_cuts.h"

namespace particle_surface_tracker::remeshing {

/// Where the mesh meets a face of the lattice.
struct FacePaths {
  /// No edge of the face is crossed twice, and the mesh meets the face in disjoint open paths between its edges: none,
  /// one or two. Otherwise the face is complex and has no paths here.
  bool simple = false;
  /// The points of each path, directed so that seen from the front of the mesh the lower cell is on the left.
  std::vector<std::vector<LatticePoint>> paths;
};

/// Follows the mesh across single faces; each face is looked at once.
class FaceTracer {
 public:
  explicit FaceTracer(TriangleCuts& cuts) : cuts_(cuts) {}

  const MeshLattice& lattice() const { return cuts_.lattice(); }

  /// Valid as long as this object.
  const FacePaths& paths_on(const LatticeFace& face);

 private:
  FacePaths trace(const LatticeFace& face);

  TriangleCuts& cuts_;
  std::unordered_map<LatticeFace, FacePaths, LatticeHash> faces_;
};

}  // namespace particle_surface_tracker::remeshing
