#include "particle_surface_tracker/core/particle_frame.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker {

namespace {

void check_finite(const std::vector<Vec3f>& values, const std::vector<std::uint32_t>& ids, const char* what) {
  std::size_t bad = 0;
  std::size_t first = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i].allFinite()) continue;
    if (bad++ == 0) first = i;
  }
  if (bad == 0) return;
  const Vec3f& value = values[first];
  throw ParticleError(fmt::format("{} of {} particles have a {} that is not finite; the first is id {} at ({}, {}, {})",
                                  bad, values.size(), what, ids[first], value.x(), value.y(), value.z()));
}

void check_unique(const std::vector<std::uint32_t>& sorted_ids) {
  std::size_t repeated = 0;
  std::size_t first = 0;
  for (std::size_t i = 1; i < sorted_ids.size(); ++i) {
    if (sorted_ids[i] == sorted_ids[i - 1] && repeated++ == 0) first = i;
  }
  if (repeated == 0) return;
  throw ParticleError(
      fmt::format("{} particles repeat the id of another one in the same frame; the lowest such id is {}. "
                  "Every particle needs an id of its own that stays with it",
                  repeated, sorted_ids[first]));
}

template <typename T>
void permute(std::vector<T>& values, const std::vector<std::uint32_t>& order) {
  std::vector<T> sorted;
  sorted.reserve(values.size());
  for (const std::uint32_t i : order) sorted.push_back(values[i]);
  values = std::move(sorted);
}

}  // namespace

ParticleFrame make_particle_frame(std::int64_t stamp_ns, std::vector<Vec3f> positions, std::vector<std::uint32_t> ids,
                                  std::vector<Vec3f> velocities) {
  if (ids.size() != positions.size() || (!velocities.empty() && velocities.size() != positions.size())) {
    throw ParticleError(
        fmt::format("{} positions, {} ids and {} velocities: there must be one id per position, and one "
                    "velocity per position or none at all",
                    positions.size(), ids.size(), velocities.size()));
  }
  check_finite(positions, ids, "position");
  check_finite(velocities, ids, "velocity");
  if (!std::is_sorted(ids.begin(), ids.end())) {
    std::vector<std::uint32_t> order(ids.size());
    std::iota(order.begin(), order.end(), 0u);
    std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return ids[a] < ids[b]; });
    permute(positions, order);
    permute(ids, order);
    if (!velocities.empty()) permute(velocities, order);
  }
  check_unique(ids);
  return {stamp_ns, std::move(positions), std::move(ids), std::move(velocities)};
}

namespace {

/// Cell size for a first look at particles whose spacing is not known: as if they filled their bounding box.
double first_cell_size(const std::vector<Vec3f>& positions) {
  Vec3d lower = positions.front().cast<double>();
  Vec3d upper = lower;
  for (const Vec3f& p : positions) {
    lower = lower.cwiseMin(p.cast<double>());
    upper = upper.cwiseMax(p.cast<double>());
  }
  const Vec3d extent = (upper - lower).cwiseMax(1e-6 * (upper - lower).maxCoeff());
  return std::cbrt(extent.prod() / static_cast<double>(positions.size()));
}

/// Squared distance from a particle to the nearest other one; the cells around it are searched in growing boxes.
double squared_nearest_distance(const ParticleGrid& grid, const Vec3f& position) {
  const LatticeCoord cell = grid.cell_of(position.cast<double>());
  double best = INFINITY;
  for (int width = 1;; width *= 2) {
    const LatticeCoord lower = {cell[0] - width, cell[1] - width, cell[2] - width};
    const LatticeCoord upper = {cell[0] + width, cell[1] + width, cell[2] + width};
    std::size_t seen = 0;
    grid.for_each_range(lower, upper, [&](std::uint32_t begin, std::uint32_t end) {
      seen += end - begin;
      for (std::uint32_t i = begin; i < end; ++i) {
        const Vec3f other(grid.x()[i], grid.y()[i], grid.z()[i]);
        const double squared = (other - position).cast<double>().squaredNorm();
        if (squared > 0.0) best = std::min(best, squared);
      }
    });
    const double covered = (width - 0.5) * grid.cell_size();
    if (best <= covered * covered || seen == grid.size()) return best;
  }
}

}  // namespace

double estimate_particle_spacing(const ParticleFrame& frame) {
  if (frame.size() < 2) {
    throw ParticleError(
        fmt::format("the particle spacing cannot be estimated from {} particles; give it as a number", frame.size()));
  }
  const double cell_size = first_cell_size(frame.positions);
  if (!(cell_size > 0.0)) {
    throw ParticleError(
        "the particle spacing cannot be estimated: all particles are at one place; give it as a number");
  }
  const ParticleGrid grid(frame.positions, cell_size);
  std::vector<double> squared(frame.size());
  for (std::size_t i = 0; i < frame.size(); ++i) squared[i] = squared_nearest_distance(grid, frame.positions[i]);
  const auto median = squared.begin() + static_cast<std::ptrdiff_t>(squared.size() / 2);
  std::nth_element(squared.begin(), median, squared.end());
  return std::sqrt(*median);
}

}  // namespace particle_surface_tracker
