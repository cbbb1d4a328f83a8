#pragma once

#include <cstdint>
#include <vector>

#include "motion_gathering.h"
#include "motion_kernel.h"

namespace particle_surface_tracker {

/// Finds the displacements of vertices, one group of neighbours at a time. One object per thread.
class VertexAdvection {
 public:
  /// Both arguments must outlive this.
  VertexAdvection(const SortedMotion& motion, const Parameters& parameters);

  /// The cells of the grid that vertices are sorted into [m]: small enough that those in a few of them share most of
  /// their neighbours.
  static double cell_size(const ParticleGrid& particles);

  /// Moves the vertices of one tile.
  /// \param vertices sorted into cells of cell_size().
  /// \param tile of that grid.
  /// \param advected receives the new positions [m], in the order that the vertices had.
  void advect_tile(const ParticleGrid& vertices, const ParticleGrid::Tile& tile, std::vector<Vec3f>& advected);

 private:
  /// A vertex whose displacement is not known yet.
  struct Pending {
    std::uint32_t index;
    bool has_average = false;
    LatticeCoord cell;
    Vec3f vertex;                   // [m]
    Vec3f position;                 // relative to the origin of the tile [m]
    Vec3d average = Vec3d::Zero();  // its displacement by `average` [m]
  };

  /// Some of those pending, one per lane.
  struct Group {
    std::size_t begin, end;
  };

  /// The group that begins with a vertex: as many of those that follow as there are lanes and as lie in few cells.
  Group group_at(std::size_t begin, int most_cells) const;

  /// Gathers the particles around all that are pending.
  /// \param origin of the tile [m].
  void gather(const Vec3f& origin, double radius);

  /// Gathers those around a group of them, sums and fits.
  void evaluate(const Group& group, double radius);

  /// The displacement of the vertex in a lane, if the particles within the radius settle it.
  /// \return false if they do not.
  bool settle(int lane, double radius, const Vec3d& vertex, Pending& pending, Vec3d& displacement);

  /// The radius that follows when it did not suffice [r].
  double next_radius(double radius) const;

  const SortedMotion& motion_;
  const Parameters& parameters_;
  const MotionKernel& kernel_;
  double r_;
  PlainFit plain_;
  Neighborhood around_tile_;
  Neighborhood around_;
  MotionBatch batch_;
  std::vector<Pending> pending_;
};

}  // namespace particle_surface_tracker
