#pragma once

#include <cstdint>
#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/signed_distance_field.h"
#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// What the search for the isosurface found for one vertex.
enum class ProjectionStatus : std::uint8_t {
  kFound,     ///< |φ(x*)| is below the tolerance.
  kNotFound,  ///< The steps ran out before that, or the gradient vanished.
  kAbsent     ///< φ is not known where the search went: the isosurface is out of reach.
};

/// Where the vertices belong: on φ = δ.
struct Projection {
  std::vector<Vec3f> positions;  ///< x_proj [m]; x itself where the search did not end well.
  std::vector<float> distances;  ///< Signed |x − x*| before the projection [m]: φ(x) by the search that projects.
  std::vector<ProjectionStatus> status;
};

/// Projects vertices onto φ = δ (Sec. 5.2): the closest point x* on φ = 0 is found in steps of ε, with cubic
/// interpolation of φ, and the vertex is put at the distance δ from it. Along which direction, and why, is in
/// docs/projection.md.
///
/// With φ and x as they were when δ was measured, this is the identity: a vertex that would move by less than 1e-5 r
/// stays.
/// \param delta δ of each vertex [m], negative inside.
Projection project(const std::vector<Vec3f>& vertices, const std::vector<float>& delta,
                   const SignedDistanceField& field, const Parameters& parameters);

/// Measures δ of vertices where they are [m] (Sec. 5.2, t = 0 and every new vertex): the signed |x − x*| of the very
/// search that projects. `status` tells where that failed; δ is 0 there.
std::vector<float> measure_delta(const std::vector<Vec3f>& vertices, const SignedDistanceField& field,
                                 const Parameters& parameters, std::vector<ProjectionStatus>& status);

}  // namespace particle_surface_tracker
