#include "surroundings.h"

#include <cmath>

namespace particle_surface_tracker::simulator {
namespace {

// The kernel's radius [r]: about 30 neighbours.
constexpr double kKernelRadius = 2.0;

// A cubic grid of particles that ends r/2 before a wall shall have its rest density up to its last layer. Liquid that
// begins at the wall itself would be a little more than the layers that are missing.
double depth_behind_walls(const Neighborhoods& neighborhoods, const WallProfile& profile, double spacing) {
  const int reach = static_cast<int>(std::ceil(kKernelRadius));
  double missing = 0.0;
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      for (int k = 1; k <= reach; ++k) missing += neighborhoods.kernel().value(spacing * Vec3d(i, j, k).norm());
    }
  }
  missing *= neighborhoods.volume();
  double near = 0.0;
  double far = neighborhoods.kernel().radius();
  while (far - near > 1e-9 * spacing) {
    const double middle = 0.5 * (near + far);
    (profile.at(0.5 * spacing + middle).density > missing ? near : far) = middle;
  }
  return near;
}

}  // namespace

Surroundings::Surroundings(double spacing)
    : neighborhoods(Kernel(kKernelRadius * spacing), volume_on_grid(Kernel(kKernelRadius * spacing), spacing)),
      wall_profile(neighborhoods.kernel()),
      wall_depth(depth_behind_walls(neighborhoods, wall_profile, spacing)) {}

void Surroundings::survey(const ParticleGrid& grid, const std::vector<Vec3d>& positions, const Boundary& boundary) {
  const Kernel& kernel = neighborhoods.kernel();
  neighborhoods.find(grid);
  density.resize(positions.size());
  wall_gradient.resize(positions.size());
  wall_drag.resize(positions.size());
  for_each_particle(positions.size(), [&](std::size_t i) {
    double share = kernel.value(0.0);
    for (const Neighbor& neighbor : neighborhoods.of(i)) share += kernel.value(neighbor.offset.norm());
    share *= neighborhoods.volume();
    Vec3d gradient = Vec3d::Zero();
    Eigen::Matrix3d drag = Eigen::Matrix3d::Zero();
    boundary.for_each_wall(positions[i], kernel.radius(), [&](const Boundary::Wall& wall) {
      const WallProfile::Values values = wall_profile.at(wall.distance + wall_depth);
      share += values.density;
      gradient += values.density_slope * wall.normal;
      drag += values.tangential_drag * Eigen::Matrix3d::Identity() +
              (values.normal_drag - values.tangential_drag) * wall.normal * wall.normal.transpose();
    });
    density[i] = static_cast<float>(share);
    wall_gradient[i] = gradient.cast<float>();
    wall_drag[i] = drag.cast<float>();
  });
}

}  // namespace particle_surface_tracker::simulator
