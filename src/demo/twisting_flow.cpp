#include "twisting_flow.h"

#include <cmath>

namespace particle_surface_tracker::demo {
namespace {

constexpr double kPi = 3.141592653589793;

// What the flow adds up to from time 0 to 1.
constexpr double kStretch = 0.26;  // Natural logarithm of the stretch along x.
constexpr double kTwist = 1.5;     // [rad/m]
constexpr double kSaddle = 0.35;   // [1/m]
constexpr double kSpin = 0.6;      // [rad], around z

}  // namespace

Vec3d TwistingFlow::velocity(const Vec3d& position, double time) const {
  const double x = position.x();
  const double y = position.y();
  const double z = position.z();
  const Vec3d stretch = kStretch * Vec3d(x, -0.5 * y, -0.5 * z);
  const Vec3d twist = kTwist * x * Vec3d(0.0, -z, y);
  const Vec3d saddle(0.0, 0.0, kSaddle * (x * x - y * y));
  const Vec3d spin = kSpin * Vec3d(-y, x, 0.0);
  // Starts and ends at rest; the mean over the time from 0 to 1 is 1.
  const double pace = 1.0 - std::cos(2.0 * kPi * time);
  return pace * (stretch + twist + saddle + spin);
}

Vec3d TwistingFlow::follow(Vec3d position, double time, double duration, int steps) const {
  const double h = duration / steps;
  for (int step = 0; step < steps; ++step) {
    const double t = time + step * h;
    const Vec3d k1 = velocity(position, t);
    const Vec3d k2 = velocity(position + 0.5 * h * k1, t + 0.5 * h);
    const Vec3d k3 = velocity(position + 0.5 * h * k2, t + 0.5 * h);
    const Vec3d k4 = velocity(position + h * k3, t + h);
    position += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
  }
  return position;
}

}  // namespace particle_surface_tracker::demo
