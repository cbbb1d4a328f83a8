#include "wall_profile.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace particle_surface_tracker::simulator {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr std::size_t kIntervals = 256;
constexpr int kIntegrationSteps = 400;  // Even, for Simpson's rule.

// The half-space beyond the distance d is cut into spherical shells around the particle: at radius s the wall leaves
// the cap with cosines c = d/s … 1 to the normal.
WallProfile::Values shell(const Kernel& kernel, double d, double s) {
  const double c = s > 0.0 ? std::min(1.0, d / s) : 0.0;
  const double whole = 1.0 - c;                       // ∫ dc
  const double along_normal = (1.0 - c * c * c) / 3;  // ∫ c² dc
  const double area = 2.0 * kPi * s * s;
  const double drag = -viscosity_factor * kernel.slope(s) * area;
  WallProfile::Values values;
  values.density = kernel.value(s) * area * whole;
  values.density_slope = -2.0 * kPi * kernel.value(s) * s;
  values.normal_drag = drag * along_normal;
  values.tangential_drag = drag * 0.5 * (whole - along_normal);
  return values;
}

void add(WallProfile::Values& sum, double weight, const WallProfile::Values& values) {
  sum.density += weight * values.density;
  sum.density_slope += weight * values.density_slope;
  sum.normal_drag += weight * values.normal_drag;
  sum.tangential_drag += weight * values.tangential_drag;
}

// By Simpson's rule over the shells that reach behind the wall.
WallProfile::Values integrate(const Kernel& kernel, double d) {
  const double step = (kernel.radius() - d) / kIntegrationSteps;
  WallProfile::Values sum;
  for (int n = 0; n <= kIntegrationSteps; ++n) {
    const bool end = n == 0 || n == kIntegrationSteps;
    const double weight = end ? 1.0 : (n % 2 == 1 ? 4.0 : 2.0);
    add(sum, weight * step / 3.0, shell(kernel, d, d + n * step));
  }
  return sum;
}

}  // namespace

WallProfile::WallProfile(const Kernel& kernel) : step_(kernel.radius() / kIntervals) {
  for (std::size_t n = 0; n <= kIntervals; ++n) table_.push_back(integrate(kernel, static_cast<double>(n) * step_));
}

WallProfile::Values WallProfile::at(double distance) const {
  const double place = std::max(0.0, distance) / step_;
  if (!(place < static_cast<double>(kIntervals))) return {};
  const auto below = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(below);
  Values values;
  add(values, 1.0 - part, table_[below]);
  add(values, part, table_[below + 1]);
  return values;
}

}  // namespace particle_surface_tracker::simulator
