#include "sequences/ring_shape.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <set>

#include <Eigen/Geometry>

#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker::test {

namespace {

constexpr double kParticleRadius = 3.0;   // [r]
constexpr double kInfluenceRadius = 4.0;  // Of φ: particles that bend the isosurface at a vertex [r].
constexpr double kRigidRms = 0.02;        // [r]
constexpr std::size_t kFewestPoints = 4;

using Points = Eigen::Matrix3Xd;

Points gather(const std::vector<Vec3f>& positions, const std::vector<std::uint32_t>& which) {
  Points points(3, static_cast<Eigen::Index>(which.size()));
  for (std::size_t n = 0; n < which.size(); ++n) {
    points.col(static_cast<Eigen::Index>(n)) = positions[which[n]].cast<double>();
  }
  return points;
}

/// RMS distance [m] that the best rigid motion of `from` leaves to `to`.
double rigid_residual(const Points& from, const Points& to) {
  const Eigen::Matrix4d motion = Eigen::umeyama(from, to, /*with_scaling=*/false);
  const Points moved = (motion.topLeftCorner<3, 3>() * from).colwise() + motion.topRightCorner<3, 1>();
  return std::sqrt((moved - to).squaredNorm() / static_cast<double>(from.cols()));
}

/// The particles of the first frame that the later one has too, with their places in both.
struct CommonParticles {
  std::vector<Vec3f> first, later;
};

CommonParticles match(const ParticleFrame& first, const ParticleFrame& later) {
  CommonParticles common;
  for (std::size_t n = 0; n < first.size(); ++n) {
    const auto found = std::lower_bound(later.ids.begin(), later.ids.end(), first.ids[n]);
    if (found == later.ids.end() || *found != first.ids[n]) continue;
    common.first.push_back(first.positions[n]);
    common.later.push_back(later.positions[static_cast<std::size_t>(found - later.ids.begin())]);
  }
  return common;
}

void add_within(const ParticleGrid& grid, const std::vector<Vec3f>& positions, const Vec3d& center, double radius,
                std::set<std::uint32_t>& found) {
  const auto visit = [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t n = begin; n < end; ++n) {
      const std::uint32_t particle = grid.index()[n];
      if ((positions[particle].cast<double>() - center).norm() <= radius) found.insert(particle);
    }
  };
  grid.for_each_range(grid.cell_of(center.array() - radius), grid.cell_of(center.array() + radius), visit);
}

constexpr auto kGone = std::numeric_limits<std::uint32_t>::max();

/// Where the vertices of the first frame stand in the later one.
std::vector<std::uint32_t> places_of_first(std::size_t count, const std::vector<std::uint32_t>& later_ids) {
  std::vector<std::uint32_t> place(count, kGone);
  for (std::uint32_t n = 0; n < later_ids.size(); ++n) {
    if (later_ids[n] < count) place[later_ids[n]] = n;
  }
  return place;
}

}  // namespace

std::vector<double> ring_shape_changes(const std::vector<Triangle>& triangles, const std::vector<Vec3f>& first,
                                       const std::vector<Vec3f>& later, const std::vector<std::uint32_t>& later_ids,
                                       const ParticleFrame& first_particles, const ParticleFrame& later_particles,
                                       double r) {
  const std::vector<std::uint32_t> place = places_of_first(first.size(), later_ids);
  const CommonParticles particles = match(first_particles, later_particles);
  const ParticleGrid first_grid(particles.first, r);
  const ParticleGrid later_grid(particles.later, r);
  std::vector<std::set<std::uint32_t>> rings(first.size());
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) rings[v].insert(t.begin(), t.end());
  }
  std::vector<double> changes;
  for (std::size_t v = 0; v < first.size(); ++v) {
    const std::vector<std::uint32_t> ring(rings[v].begin(), rings[v].end());
    std::vector<std::uint32_t> later_ring;
    for (const std::uint32_t w : ring) later_ring.push_back(place[w]);
    if (std::count(later_ring.begin(), later_ring.end(), kGone) > 0) continue;
    std::set<std::uint32_t> around;
    add_within(first_grid, particles.first, first[v].cast<double>(), kParticleRadius * r, around);
    add_within(later_grid, particles.later, later[place[v]].cast<double>(), kInfluenceRadius * r, around);
    const std::vector<std::uint32_t> near(around.begin(), around.end());
    if (near.size() < kFewestPoints) continue;
    if (rigid_residual(gather(particles.first, near), gather(particles.later, near)) > kRigidRms * r) continue;
    changes.push_back(rigid_residual(gather(first, ring), gather(later, later_ring)) / r);
  }
  return changes;
}

RingShapeSummary summarize(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const auto last = static_cast<double>(values.size() - 1);
  const auto at = [&](double share) { return values[static_cast<std::size_t>(std::round(share * last))]; };
  return {at(0.5), at(0.95), values.back()};
}

}  // namespace particle_surface_tracker::test
