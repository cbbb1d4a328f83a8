#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/types.h"

/// Bodies of particles for the tests of the implicit function.
namespace particle_surface_tracker::test::implicit {

constexpr double kR = 0.1;  ///< [m]
constexpr std::uint32_t kSeed = 2007;

using Positions = std::vector<Vec3f>;
using Inside = std::function<bool(const Vec3d&)>;

Parameters make_parameters(double dx_phi = 0.5);

/// The implicit function of these particles at the nodes that evaluate_implicit_function() chooses.
ImplicitSurface evaluate(const Positions& positions, const Parameters& parameters);

/// Particles of the cube |x|, |y|, |z| ≤ half_width [m] where `inside` holds, as fill_with_particles().
Positions fill(double half_width, double jitter, const Inside& inside);

Positions random_cloud(std::size_t count, double half_width, std::uint32_t seed);

Positions moved(Positions positions, const Vec3f& offset);

/// Drops of all sizes: lone particles, pairs, small and larger groups, some close to each other.
Positions splash();

/// True within a ball around the origin.
bool is_in_ball(const Vec3d& p, double radius);

}  // namespace particle_surface_tracker::test::implicit
