#pragma once

#include <vector>

#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker::test {

/// How much the one-rings of vertices changed their shape between two frames, where the liquid itself did not: for
/// every vertex whose particles moved rigidly to 0.02 r RMS, the RMS of what the best rigid motion leaves of the motion
/// of the vertex and its neighbours [r]. Its particles are those within 3 r of it in the first frame, and those within
/// 4 r of it in the later one, so that a place where other liquid came near and bends the isosurface is left out; four
/// at least.
///
/// \param first positions of the vertices in the first frame [m].
/// \param later positions of the later frame's vertices [m].
/// \param later_ids their ids, increasing: index of the vertex in the first frame. Rings that have lost a vertex are left
/// out.
/// \param r particle spacing [m].
/// \return one number per such vertex.
std::vector<double> ring_shape_changes(const std::vector<Triangle>& triangles, const std::vector<Vec3f>& first,
                                       const std::vector<Vec3f>& later, const std::vector<std::uint32_t>& later_ids,
                                       const ParticleFrame& first_particles, const ParticleFrame& later_particles,
                                       double r);

/// Of a set of numbers; all 0 if it is empty.
struct RingShapeSummary {
  double median = 0.0;
  double percentile_95 = 0.0;
  double largest = 0.0;
};

RingShapeSummary summarize(std::vector<double> values);

}  // namespace particle_surface_tracker::test
