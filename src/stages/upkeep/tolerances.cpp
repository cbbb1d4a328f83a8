#include "tolerances.h"

#include <cmath>

namespace particle_surface_tracker {

namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
/// A fold that was there at birth must grow by this [rad] before it counts.
constexpr double kFoldGrowth = 20.0 * kRadiansPerDegree;
/// A small angle that was there at birth must shrink to this part of it before it counts.
constexpr double kAngleShrinkage = 0.5;

}  // namespace

Tolerances::Tolerances(const BirthRecords& births, const Parameters& parameters)
    : births_(births),
      split_length_(parameters.split_length * parameters.dx_gamma * parameters.particle_spacing),
      split_growth_(parameters.split_growth),
      collapse_length_(parameters.collapse_length * parameters.dx_gamma * parameters.particle_spacing),
      collapse_shrinkage_(parameters.collapse_shrinkage),
      remeshed_length_(parameters.remeshed_length * parameters.dx_gamma * parameters.particle_spacing),
      squared_longest_short_edge_(std::pow(std::max(collapse_length_, remeshed_length_), 2)),
      fold_angle_(parameters.fold_angle * kRadiansPerDegree),
      cosine_of_fold_angle_(std::cos(fold_angle_)),
      sine_of_sliver_angle_(std::sin(parameters.sliver_angle * kRadiansPerDegree)) {}

double Tolerances::longest_edge(std::uint32_t a, std::uint32_t b) const {
  return std::max(split_growth_ * births_.longest_edge(a, b), split_length_);
}

double Tolerances::shortest_edge(std::uint32_t a, std::uint32_t b) const {
  if (births_.is_remeshed(a) && births_.is_remeshed(b)) return remeshed_length_;
  return std::min(collapse_shrinkage_ * births_.shortest_edge(a, b), collapse_length_);
}

bool Tolerances::is_folded_back(std::uint32_t a, std::uint32_t b, const Vec3d& normal, const Vec3d& other_normal,
                                double dot) const {
  // Cheaper than the angle itself.
  if (dot >= cosine_of_fold_angle_ * std::sqrt(normal.squaredNorm() * other_normal.squaredNorm())) return false;
  return fold_between(normal, other_normal) > std::max(fold_angle_, births_.largest_fold(a, b) + kFoldGrowth);
}

bool Tolerances::is_sliver(const Triangle& triangle, double sine) const {
  return sine < sine_of_sliver_angle_ && std::asin(sine) < kAngleShrinkage * births_.smallest_angle(triangle);
}

}  // namespace particle_surface_tracker
