#pragma once

#include <cmath>

namespace particle_surface_tracker::simulator {

/// The cubic spline kernel W(s) of smoothed particle hydrodynamics (Monaghan 1992), 0 from its radius on.
class Kernel {
 public:
  /// \param radius h of the support [m], > 0.
  explicit Kernel(double radius) : radius_(radius), scale_(8.0 / (pi * radius * radius * radius)) {}

  double radius() const { return radius_; }

  /// W at a distance s ≥ 0 [1/m³].
  double value(double distance) const {
    const double q = distance / radius_;
    if (q < 0.5) return scale_ * (6.0 * q * q * (q - 1.0) + 1.0);
    return q < 1.0 ? scale_ * 2.0 * (1.0 - q) * (1.0 - q) * (1.0 - q) : 0.0;
  }

  /// W'(s)/s [1/m⁵]: times the offset between two particles it is the gradient. Finite at 0.
  double slope(double distance) const {
    const double q = distance / radius_;
    const double per_area = scale_ / (radius_ * radius_);
    if (q < 0.5) return per_area * 6.0 * (3.0 * q - 2.0);
    return q < 1.0 ? -per_area * 6.0 * (1.0 - q) * (1.0 - q) / q : 0.0;
  }

 private:
  static constexpr double pi = 3.141592653589793;

  double radius_;
  double scale_;
};

/// The volume [m³] that makes the density of an endless cubic grid of particles equal to the rest density. It is
/// spacing³ within a ten-thousandth where the kernel's radius is two spacings.
double volume_on_grid(const Kernel& kernel, double spacing);

}  // namespace particle_surface_tracker::simulator
