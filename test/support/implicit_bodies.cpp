#include "support/implicit_bodies.h"

#include <random>

#include "particle_surface_tracker/core/particle_grid.h"
#include "particle_surface_tracker/stages/implicit_function.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test::implicit {

Parameters make_parameters(double dx_phi) {
  Parameters parameters;
  parameters.particle_spacing = kR;
  parameters.dx_phi = dx_phi;
  return parameters;
}

ImplicitSurface evaluate(const Positions& positions, const Parameters& parameters) {
  return evaluate_implicit_function(ParticleGrid(positions, implicit_function_cell_size(parameters)), parameters);
}

Positions fill(double half_width, double jitter, const Inside& inside) {
  const Vec3d corner = Vec3d::Constant(half_width);
  return fill_with_particles(-corner, corner, kR, jitter, kSeed, inside).positions;
}

Positions random_cloud(std::size_t count, double half_width, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<float> coordinate(static_cast<float>(-half_width), static_cast<float>(half_width));
  Positions positions(count);
  for (Vec3f& p : positions) p = Vec3f(coordinate(random), coordinate(random), coordinate(random));
  return positions;
}

Positions moved(Positions positions, const Vec3f& offset) {
  for (Vec3f& p : positions) p += offset;
  return positions;
}

Positions splash() {
  Positions positions = random_cloud(60, 1.2, kSeed + 1);
  const Positions centers = random_cloud(12, 1.0, kSeed + 2);
  std::uint32_t seed = kSeed + 3;
  for (const Vec3f& center : centers) {
    const Positions drop = moved(random_cloud(2 + seed % 17, 0.13, seed), center);
    positions.insert(positions.end(), drop.begin(), drop.end());
    ++seed;
  }
  return positions;
}

bool is_in_ball(const Vec3d& p, double radius) {
  return p.squaredNorm() < radius * radius;
}

}  // namespace particle_surface_tracker::test::implicit
