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

  /// Vertices are grouped by cells of this size [m]: large enough that they fill the lanes of the kernel and share the
  /// work of gathering, small enough that most particles gathered for one count for the others.
  static double group_size(const ParticleGrid& particles);

  /// Moves the vertices of one group.
  /// \param cell of a lattice of cells of group_size().
  /// \param begin, end range of their indices in `vertices`.
  /// \param advected receives the new positions [m] at the same places.
  void advect_group(const LatticeCoord& cell, const std::uint32_t* begin, const std::uint32_t* end,
                    const std::vector<Vec3f>& vertices, std::vector<Vec3f>& advected);

 private:
  /// A vertex whose displacement is not known yet.
  struct Pending {
    std::uint32_t vertex;
    bool has_average = false;
    Vec3f position;                 // relative to the centre of the group [m]
    Vec3d average = Vec3d::Zero();  // its displacement by `average` [m]
  };

  /// Gathers the particles for all that are pending.
  /// \param center of the group [m].
  void gather(const Vec3f& center, double radius);

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
  PlainFit plain_;
  Neighborhood around_;
  MotionBatch batch_;
  std::vector<Pending> pending_;
};

}  // namespace particle_surface_tracker
