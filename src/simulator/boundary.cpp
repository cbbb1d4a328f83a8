#include "boundary.h"

#include <algorithm>
#include <limits>

namespace particle_surface_tracker::simulator {

Boundary::Boundary(const SimulatorParameters& parameters)
    : obstacles_(parameters.obstacles),
      half_width_(parameters.tank_half_width),
      smallest_clearance_(0.5 * parameters.spacing) {}

Boundary::Wall Boundary::wall(std::size_t index, const Vec3d& position) const {
  if (index < obstacles_.size()) {
    const Sphere& sphere = obstacles_[index];
    const Vec3d offset = position - sphere.center;
    const double length = offset.norm();
    const Vec3d normal = length > 0.0 ? Vec3d(offset / length) : Vec3d(Vec3d::UnitZ());
    return {length - sphere.radius, normal};
  }
  switch (index - obstacles_.size()) {
    case 0:
      return {position.z(), Vec3d::UnitZ()};
    case 1:
      return {position.x() + half_width_, Vec3d::UnitX()};
    case 2:
      return {half_width_ - position.x(), -Vec3d::UnitX()};
    case 3:
      return {position.y() + half_width_, Vec3d::UnitY()};
    default:
      return {half_width_ - position.y(), -Vec3d::UnitY()};
  }
}

double Boundary::clearance(const Vec3d& position) const {
  double nearest = std::numeric_limits<double>::infinity();
  for_each_wall(position, nearest, [&](const Wall& seen) { nearest = std::min(nearest, seen.distance); });
  return nearest;
}

Vec3f Boundary::confine(const Vec3d& position, const Vec3f& displacement) const {
  const Vec3d target = position + displacement.cast<double>();
  Vec3d allowed = target;
  for (std::size_t n = 0; n < obstacles_.size() + tank_faces; ++n) {
    const Wall seen = wall(n, allowed);
    if (seen.distance < smallest_clearance_) allowed += (smallest_clearance_ - seen.distance) * seen.normal;
  }
  return displacement + (allowed - target).cast<float>();
}

}  // namespace particle_surface_tracker::simulator
