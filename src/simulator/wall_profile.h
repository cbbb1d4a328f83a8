#pragma once

#include <vector>

#include "kernel.h"

namespace particle_surface_tracker::simulator {

/// What liquid at rest that fills the half-space behind a flat wall would do to a particle in front of it: integrals of
/// the kernel over that half-space, so that walls need no particles (density maps, Koschier and Bender 2017).
class WallProfile {
 public:
  struct Values {
    double density = 0.0;          ///< Its share of the particle's density, relative to the rest density.
    double density_slope = 0.0;    ///< The derivative of that by the distance [1/m].
    double normal_drag = 0.0;      ///< Drag per viscosity against motion along the normal [1/m²].
    double tangential_drag = 0.0;  ///< ... and along the wall [1/m²].
  };

  explicit WallProfile(const Kernel& kernel);

  /// \param distance from the particle to the wall [m]; behind it counts as on it, and beyond the kernel's radius all
  /// values are 0.
  Values at(double distance) const;

 private:
  double step_;
  std::vector<Values> table_;
};

/// The factor of Monaghan's viscosity in three dimensions, 2 (d + 2).
inline constexpr double viscosity_factor = 10.0;

}  // namespace particle_surface_tracker::simulator
