#include "vertex_rank.h"

#include <Eigen/Eigenvalues>

namespace particle_surface_tracker {

namespace {

/// Eigenvalues below this part of the largest do not count: two planes of equal area that meet at an angle below 20°.
constexpr double kRankRatio = 0.03;

}  // namespace

int vertex_rank(const EditableSurface& surface, std::uint32_t vertex) {
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  surface.for_each_outgoing(vertex, [&](std::uint32_t h) {
    const Vec3d normal = area_normal(surface.corners(h / 3));
    const double length = normal.norm();
    if (length > 0.0) spread += normal * normal.transpose() / length;
  });
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread, Eigen::EigenvaluesOnly);
  const Vec3d& values = solver.eigenvalues();
  return 1 + (values[1] > kRankRatio * values[2] ? 1 : 0) + (values[0] > kRankRatio * values[2] ? 1 : 0);
}

}  // namespace particle_surface_tracker
