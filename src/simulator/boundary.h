#pragma once

#include <vector>

#include "particle_surface_tracker/core/types.h"
#include "simulator_parameters.h"

namespace particle_surface_tracker::simulator {

/// Floor and walls of the tank and the obstacles in it, as distances from a particle.
class Boundary {
 public:
  /// A flat piece of wall seen from a particle. Obstacles are taken for flat; they are large beside the kernel.
  struct Wall {
    double distance;  ///< Negative behind the wall [m].
    Vec3d normal;     ///< Away from the wall, of length 1.
  };

  explicit Boundary(const SimulatorParameters& parameters);

  /// Calls visit(wall) for every wall nearer than `reach` [m], in a fixed order.
  template <class Visit>
  void for_each_wall(const Vec3d& position, double reach, const Visit& visit) const {
    for (std::size_t n = 0; n < obstacles_.size() + tank_faces; ++n) {
      const Wall seen = wall(n, position);
      if (seen.distance < reach) visit(seen);
    }
  }

  /// The distance from a position to the nearest wall, negative behind it [m].
  double clearance(const Vec3d& position) const;

  /// How far particles stay away from all walls [m]: r/2, so that it is their surface that touches the wall.
  double smallest_clearance() const { return smallest_clearance_; }

  /// A displacement after which a particle is nowhere nearer than smallest_clearance() to a wall: it ends straight in
  /// front of the wall. One pass is enough: walls are orthogonal, and obstacles keep gaps.
  Vec3f confine(const Vec3d& position, const Vec3f& displacement) const;

 private:
  static constexpr std::size_t tank_faces = 5;

  // Obstacles first, then the floor, then the walls.
  Wall wall(std::size_t index, const Vec3d& position) const;

  std::vector<Sphere> obstacles_;
  double half_width_;
  double smallest_clearance_;
};

}  // namespace particle_surface_tracker::simulator
