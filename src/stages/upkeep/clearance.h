#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Geometry>

#include "editable_surface.h"
#include "patch.h"
#include "surroundings.h"
#include "triangle_crossing.h"

namespace particle_surface_tracker {

/// The guard that keeps operations from making the surface cross itself; one object for many questions.
class Clearance {
 public:
  /// Whether a patch does not cross itself or the triangles around it, unless what it replaces did so already.
  bool stays_clear(const EditableSurface& surface, const PlannedPatch& patch, const Surroundings& surroundings);

 private:
  struct BoxedTriangle {
    BoxedTriangle(const Triangle& vertices, const Corners& corners, const Eigen::AlignedBox3f& box)
        : triangle(place_triangle(vertices, corners)), query(box) {}

    PlacedTriangle triangle;
    BoxQuery query;
  };

  /// Some triangles and the box around them all.
  struct BoxedTriangles {
    std::vector<BoxedTriangle> all;
    Eigen::AlignedBox3f box;

    void clear();
    void add(const Triangle& vertices, const Corners& corners);
  };

  void find_others(const Eigen::AlignedBox3f& box, const PlannedPatch& patch, const Surroundings& surroundings);
  bool crosses(const EditableSurface& surface, const std::vector<BoxedTriangle>& triangles) const;

  // Memory for the search.
  BoxedTriangles planned_, replaced_;
  std::vector<Surroundings::Entry> others_;
};

}  // namespace particle_surface_tracker
