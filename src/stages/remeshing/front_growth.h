#pragma once

#include "cell_set.h"
#include "face_paths.h"

namespace particle_surface_tracker::remeshing {

/// Lets a set of marked cells grow until its front (the faces between marked and unmarked cells) can be cut: every face
/// and every edge on it is simple. The least such set is reached, in whatever order cells were marked.
class FrontGrowth {
 public:
  FrontGrowth(CellSet& marked, FaceTracer& tracer) : marked_(marked), tracer_(tracer) {}

  /// Goes on from where it ended last; cells may have been marked in between.
  void run();

 private:
  void look_at_front(const openvdb::Coord& beyond, const LatticeFace& face);

  CellSet& marked_;
  FaceTracer& tracer_;
  std::size_t next_ = 0;
};

}  // namespace particle_surface_tracker::remeshing
