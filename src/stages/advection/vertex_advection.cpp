#include "vertex_advection.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace particle_surface_tracker {

namespace {

constexpr double kGroupWidth = 2.0;  // [cells of the particles' grid]
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

double VertexAdvection::group_size(const ParticleGrid& particles) {
  return kGroupWidth * particles.cell_size();
}

void VertexAdvection::advect_group(const LatticeCoord& cell, const std::uint32_t* begin, const std::uint32_t* end,
                                   const std::vector<Vec3f>& vertices, std::vector<Vec3f>& advected) {
  const Vec3f center = (group_size(motion_.grid()) * Vec3d(cell[0], cell[1], cell[2])).cast<float>();
  pending_.clear();
  for (const std::uint32_t* v = begin; v != end; ++v) {
    Pending pending;
    pending.vertex = *v;
    pending.position = vertices[*v] - center;
    pending_.push_back(pending);
  }
  for (double radius = parameters_.advection_radius; !pending_.empty(); radius = next_radius(radius)) {
    gather(center, radius);
    std::size_t kept = 0;
    for (std::size_t first = 0; first < pending_.size(); first += MotionBatch::lanes) {
      evaluate(first, radius);
      for (int lane = 0; lane < batch_.used; ++lane) {
        Pending& pending = pending_[first + lane];
        const Vec3d vertex = vertices[pending.vertex].cast<double>();
        Vec3d displacement;
        if (settle(lane, radius, vertex, pending, displacement)) {
          advected[pending.vertex] = (vertex + displacement).cast<float>();
        } else {
          pending_[kept++] = pending;
        }
      }
    }
    pending_.resize(kept);
  }
}

void VertexAdvection::gather(const Vec3f& center, double radius) {
  Vec3f lower = pending_.front().position;
  Vec3f upper = lower;
  for (const Pending& pending : pending_) {
    lower = lower.cwiseMin(pending.position);
    upper = upper.cwiseMax(pending.position);
  }
  around_.gather(motion_, kernel_, center, lower, upper, radius * r_);
}

void VertexAdvection::evaluate(std::size_t first, double radius) {
  batch_.used = static_cast<int>(std::min<std::size_t>(MotionBatch::lanes, pending_.size() - first));
  for (int lane = 0; lane < batch_.used; ++lane) {
    for (int axis = 0; axis < 3; ++axis) batch_.vertex[axis][lane] = pending_[first + lane].position[axis];
  }
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
