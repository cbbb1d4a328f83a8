#include "particle_surface_tracker/stages/projection.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "foot_point.h"
#include "surface_search.h"

namespace particle_surface_tracker {

namespace {

/// A vertex that would move by less than this stays, so that nothing creeps at rest [r].
constexpr double kRestDistance = 1e-5;

/// Below this the two directions cancel, and only the normal counts.
constexpr double kSmallestBlend = 1e-3;

/// The signed distance that the search travelled: |x − x*|, negative inside.
double signed_distance(const Vec3d& x, const SurfacePoint& surface) {
  return std::copysign((x - surface.position).norm(), surface.start_value);
}

/// The direction along which a vertex is put at the distance δ from x*: the paper's, from x* to x, as far as it is to
/// be trusted, else the outward normal.
Vec3d projection_direction(const Vec3d& x, const SurfacePoint& surface, double distance, double delta) {
  const bool same_side = (distance < 0.0) == (delta < 0.0);
  const double length = std::abs(distance);
  if (!same_side || length == 0.0 || delta == 0.0) return surface.normal;
  const double w = std::min(1.0, length / std::abs(delta));
  const Vec3d outward = (x - surface.position) / distance;
  const Vec3d blended = w * outward + (1.0 - w) * surface.normal;
  const double norm = blended.norm();
  return norm < kSmallestBlend ? surface.normal : Vec3d(blended / norm);
}

/// x_proj of one vertex from what its search found.
Vec3d projected_position(const Vec3d& x, const SurfacePoint& surface, double delta, ProjectionMethod method,
                         float& distance) {
  if (method == ProjectionMethod::kOneStep) {  // equation 1
    distance = surface.start_value;
    return x - surface.normal * (surface.start_value - delta);
  }
  const double from_surface = signed_distance(x, surface);
  distance = static_cast<float>(from_surface);
  return surface.position + delta * projection_direction(x, surface, from_surface, delta);
}

/// The one-step projection trusts φ and its gradient at x: a search that ends where it begins.
SearchLimits search_limits(const Parameters& parameters, double dx) {
  const auto epsilon = static_cast<float>(parameters.epsilon);
  if (parameters.projection == ProjectionMethod::kOneStep) return {epsilon, std::numeric_limits<float>::infinity(), 0};
  return {epsilon, static_cast<float>(parameters.projection_tolerance * dx), parameters.projection_max_steps};
}

}  // namespace

Projection project(const std::vector<Vec3f>& vertices, const std::vector<float>& delta,
                   const SignedDistanceField& field, const Parameters& parameters) {
  Projection result;
  result.positions = vertices;
  result.distances.resize(vertices.size());
  result.status.resize(vertices.size());
  std::vector<SurfacePoint> found(vertices.size());
  const SearchLimits limits = search_limits(parameters, field.dx);
  const FieldLeaves leaves(field);
  const double rest = kRestDistance * parameters.particle_spacing;
  constexpr std::size_t grain = 1024;
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, vertices.size(), grain), [&](const tbb::blocked_range<std::size_t>& range) {
        SurfaceSearch search(field, leaves, limits);
        search.find(vertices, range.begin(), range.end(), found);
        slide_to_foot_points(vertices, range.begin(), range.end(), parameters.particle_spacing, search, found);
        for (std::size_t v = range.begin(); v != range.end(); ++v) {
          result.status[v] = found[v].status;
          if (found[v].status != ProjectionStatus::kFound) continue;
          const Vec3d x = vertices[v].cast<double>();
          const Vec3d target = projected_position(x, found[v], delta[v], parameters.projection, result.distances[v]);
          if ((target - x).squaredNorm() >= rest * rest) result.positions[v] = target.cast<float>();
        }
      });
  return result;
}

std::vector<float> measure_delta(const std::vector<Vec3f>& vertices, const SignedDistanceField& field,
                                 const Parameters& parameters, std::vector<ProjectionStatus>& status) {
  Projection measured = project(vertices, std::vector<float>(vertices.size(), 0.0f), field, parameters);
  status = std::move(measured.status);
  return std::move(measured.distances);
}

}  // namespace particle_surface_tracker
