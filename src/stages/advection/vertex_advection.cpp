#include "vertex_advection.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "cell_box.h"

namespace particle_surface_tracker {

namespace {

constexpr double kCellWidth = 1.0;  // [cells of the particles' grid]

/// Most cells in a box around a group: the more, the fuller the lanes, and the more particles are gathered for one
/// vertex that do not matter to the others. Few vertices need more than the first radius, so they lie farther apart.
constexpr int kMostCells = 12;
constexpr int kMostCellsLater = 48;

/// For the rounding of places relative to the origin of a tile.
constexpr double kTileSlack = 1.0001;

constexpr double kRadiusGrowth = 1.25;
constexpr double kThreadReach = 2.0;         // times affine_max_radius
constexpr double kLargestCorrection = 0.24;  // [r]
constexpr double kRigidShare = 0.25;         // of affine_max_residual

Vec3d lane_of(const std::array<MotionBatch::Lanes, 3>& values, int lane) {
  return {values[0][lane], values[1][lane], values[2][lane]};
}

/// However well a fit seems to explain a collision, it must not throw a vertex; only motion that is as good as rigid
/// may take it farther from the average than this.
Vec3d bounded_correction(const Vec3d& correction, double unrigidness, double r, const Parameters& parameters) {
  const double rigid = kRigidShare * parameters.affine_max_residual * r;
  const double allowed = kLargestCorrection * r * std::max(1.0, rigid / std::max(unrigidness, 1e-9 * rigid));
  const double length = correction.norm();
  return length > allowed ? Vec3d(correction * (allowed / length)) : correction;
}

/// The weighted average, its radius expanded until there is a particle (Sec. 4), and a little more, so that its weight
/// is not 0. Far from all particles that is the motion of the nearest one; no cell between is looked at.
/// \param far [m]
Vec3d average_around_nearest(const SortedMotion& motion, const Vec3d& vertex, double far) {
  const ParticleGrid& grid = motion.grid();
  const std::size_t nearest = grid.nearest(vertex);
  const double distance = (motion.particles().positions[nearest].cast<double>() - vertex).norm();
  if (distance > far) return motion.particles().displacements[nearest].cast<double>();
  const double radius = kRadiusGrowth * distance;
  const Vec3d extent = Vec3d::Constant(radius);
  Vec3d sum = Vec3d::Zero();
  double weight = 0.0;
  grid.for_each_range(grid.cell_of(vertex - extent), grid.cell_of(vertex + extent),
                      [&](std::uint32_t begin, std::uint32_t end) {
                        for (std::uint32_t n = begin; n < end; ++n) {
                          const Vec3d offset = Vec3d(grid.x()[n], grid.y()[n], grid.z()[n]) - vertex;
                          const double s = 1.0 - offset.squaredNorm() / (radius * radius);
                          if (s <= 0.0) continue;
                          sum += s * s * s * motion.displacement(n).cast<double>();
                          weight += s * s * s;
                        }
                      });
  return sum / weight;
}

}  // namespace

VertexAdvection::VertexAdvection(const SortedMotion& motion, const Parameters& parameters)
    : motion_(motion),
      parameters_(parameters),
      kernel_(active_motion_kernel()),
      r_(parameters.particle_spacing),
      plain_{static_cast<float>(parameters.affine_rank_threshold * r_ * r_),
             static_cast<float>(parameters.affine_max_stretch * parameters.affine_max_stretch)} {}

double VertexAdvection::cell_size(const ParticleGrid& particles) {
  return kCellWidth * particles.cell_size();
}

void VertexAdvection::advect_tile(const ParticleGrid& vertices, const ParticleGrid::Tile& tile,
                                  std::vector<Vec3f>& advected) {
  const auto vertex_at = [&](std::uint32_t n) { return Vec3f(vertices.x()[n], vertices.y()[n], vertices.z()[n]); };
  const Vec3f origin = vertex_at(tile.begin.front());
  pending_.clear();
  ParticleGrid::for_each_cell(tile, [&](const LatticeCoord& cell, std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t n = begin; n < end; ++n) {
      // In place: a whole object copied right after its parts were written would have to wait for them.
      Pending& pending = pending_.emplace_back();
      pending.index = vertices.index()[n];
      pending.cell = cell;
      pending.vertex = vertex_at(n);
      pending.position = pending.vertex - origin;
    }
  });
  int most_cells = kMostCells;
  for (double radius = parameters_.advection_radius; !pending_.empty(); radius = next_radius(radius)) {
    gather(origin, radius);
    std::size_t kept = 0;
    for (Group group{0, 0}; group.end < pending_.size();) {
      group = group_at(group.end, most_cells);
      evaluate(group, radius);
      for (std::size_t n = group.begin; n < group.end; ++n) {
        Pending& pending = pending_[n];
        const Vec3d vertex = pending.vertex.cast<double>();
        Vec3d displacement;
        if (settle(static_cast<int>(n - group.begin), radius, vertex, pending, displacement)) {
          advected[pending.index] = (vertex + displacement).cast<float>();
        } else {
          pending_[kept++] = pending;
        }
      }
    }
    pending_.resize(kept);
    most_cells = kMostCellsLater;
  }
}

VertexAdvection::Group VertexAdvection::group_at(std::size_t begin, int most_cells) const {
  CellBox box{pending_[begin].cell, pending_[begin].cell};
  std::size_t end = begin + 1;
  const std::size_t last = std::min<std::size_t>(begin + MotionBatch::lanes, pending_.size());
  for (; end < last; ++end) {
    const CellBox larger = box.with(pending_[end].cell);
    if (larger.volume() > most_cells) break;
    box = larger;
  }
  return {begin, end};
}

void VertexAdvection::gather(const Vec3f& origin, double radius) {
  Vec3f lower = pending_.front().position;
  Vec3f upper = lower;
  for (const Pending& pending : pending_) {
    lower = lower.cwiseMin(pending.position);
    upper = upper.cwiseMax(pending.position);
  }
  around_tile_.gather(motion_, kernel_, origin, lower, upper, radius * r_ * kTileSlack);
}

void VertexAdvection::evaluate(const Group& group, double radius) {
  const Vec3f origin = pending_[group.begin].position;
  Vec3f lower = Vec3f::Zero();
  Vec3f upper = Vec3f::Zero();
  batch_.used = static_cast<int>(group.end - group.begin);
  for (int lane = 0; lane < batch_.used; ++lane) {
    const Vec3f position = pending_[group.begin + lane].position - origin;
    for (int axis = 0; axis < 3; ++axis) batch_.vertex[axis][lane] = position[axis];
    lower = lower.cwiseMin(position);
    upper = upper.cwiseMax(position);
  }
  around_.gather(around_tile_, kernel_, origin, lower, upper, radius * r_);
  around_.sum(kernel_, radius * r_, batch_);
  kernel_.fit(plain_, batch_);
}

bool VertexAdvection::settle(int lane, double radius, const Vec3d& vertex, Pending& pending, Vec3d& displacement) {
  const double limit = parameters_.affine_max_radius;
  const int neighbors = batch_.neighbors[lane];
  const Vec3d average_here = around_.reference().cast<double>() + lane_of(batch_.average, lane);
  if (!pending.has_average) {
    pending.has_average = true;
    pending.average = neighbors > 0 ? average_here : average_around_nearest(motion_, vertex, limit * r_);
  }
  displacement = pending.average;
  if (parameters_.advection == AdvectionMethod::kAverage) return true;
  if (neighbors < parameters_.affine_min_neighbors && radius < limit) return false;

  if (batch_.is_plain[lane] != 0) {
    const double misfit = std::sqrt(batch_.squared_misfit[lane] * settling_factor(neighbors));
    const Vec3d fitted = average_here + lane_of(batch_.correction, lane);
    const Vec3d correction = trust_in_fit(misfit, r_, parameters_) * (fitted - pending.average);
    if (correction.squaredNorm() <= kLargestCorrection * kLargestCorrection * r_ * r_) {
      displacement += correction;
      return true;
    }
  }
  if (radius < limit && !is_motion_settled(around_.sums_of(batch_, lane), r_, parameters_)) return false;
  const AffineFit fit = fit_affine_motion(around_.sums_of(batch_, lane), r_, parameters_);
  const double reach = fit.rank == 1 ? kThreadReach * limit : limit;
  if (fit.rank < 3 && radius < reach) return false;
  const Vec3d correction = fit.trust * (fit.displacement - pending.average);
  displacement += bounded_correction(correction, fit.unrigidness, r_, parameters_);
  return true;
}

double VertexAdvection::next_radius(double radius) const {
  const double limit = parameters_.affine_max_radius;
  return std::min(radius * kRadiusGrowth, radius < limit ? limit : kThreadReach * limit);
}

}  // namespace particle_surface_tracker
