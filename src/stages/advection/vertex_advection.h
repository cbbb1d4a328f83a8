#pragma once

#include <cstdint>
#include <vector>

#include "motion_gathering.h"
#include "motion_kernel.h"

namespace particle_surface_tracker {

/// Finds the displacements of vertices, one cell of the particles' grid at a time. One object per thread.
class VertexAdvection {
 public:
  /// Both arguments must outlive this.
  VertexAdvection(const SortedMotion& motion, const Parameters& parameters);

  /// Moves the vertices of one cell.
  /// \param begin, end range of their indices in `vertices`.
  /// \param advected receives the new positions [m] at the same places.
  void advect_cell(const LatticeCoord& cell, const std::uint32_t* begin, const std::uint32_t* end,
                   const std::vector<Vec3f>& vertices, std::vector<Vec3f>& advected);

 private:
  /// A vertex whose displacement is not known yet.
  struct Pending {
    std::uint32_t vertex;
    bool has_average = false;
    Vec3f position;                 // relative to the centre of the cell [m]
    Vec3d average = Vec3d::Zero();  // its displacement by `average` [m]
  };

  /// Gathers the particles for all that are pending.
  void gather(const LatticeCoord& cell, double radius);

  /// Sums and fits for those from `first` on, as many as there are lanes.
  void evaluate(std::size_t first, double radius);

  /// The displacement of the vertex in a lane, if the particles within the radius settle it.
  /// \return false if they do not.
  bool settle(int lane, double radius, const Vec3d& vertex, Pending& pending, Vec3d& displacement);

  /// The radius that follows when it did not suffice [r].
  double next_radius(double radius) const;

  const SortedMotion& motion_;
  const Parameters& parameters_;
  const MotionKernel& kernel_;
  double r_;
  double cell_size_;
  PlainFit plain_;
  Neighborhood around_;
  MotionBatch batch_;
  std::vector<Pending> pending_;
};

}  // namespace particle_surface_tracker
