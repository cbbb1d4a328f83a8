#include <cstdio>
#include <tuple>

#include <gtest/gtest.h>

#include "support/detailed_body.h"
#include "support/shapes.h"
#include "upkeep_support.h"

// Meshes in motions that are known exactly, kept up after every step.

namespace particle_surface_tracker {
namespace {

using test::MeshShape;

constexpr double kPi = 3.14159265358979323846;

/// What happened to a mesh on its way.
struct Passage {
  MeshShape worst;
  std::size_t splits = 0, collapses = 0, folds = 0, slivers = 0, flips = 0;
  std::size_t refused = 0;    ///< In the last step.
  std::size_t crossings = 0;  ///< Self-intersecting triangles at the end.

  void add(const TriangleMesh& mesh, const UpkeepReport& report) {
    const MeshShape now = test::shape_of(mesh);
    worst.shortest_edge = std::min(worst.shortest_edge, now.shortest_edge);
    worst.longest_edge = std::max(worst.longest_edge, now.longest_edge);
    worst.smallest_angle = std::min(worst.smallest_angle, now.smallest_angle);
    worst.share_below_10_degrees = std::max(worst.share_below_10_degrees, now.share_below_10_degrees);
    worst.largest_fold = std::max(worst.largest_fold, now.largest_fold);
    splits += report.splits;
    collapses += report.collapses;
    folds += report.fold_collapses;
    slivers += report.sliver_collapses;
    flips += report.flips;
    refused = report.refused;
  }
};

/// Moves a mesh in steps and keeps it up after each; it must be a closed manifold all the time.
template <typename Step>
Passage carry(TriangleMesh& mesh, double h, int steps, Step&& step) {
  const Parameters parameters = test::parameters_for_cells_of(h);
  UpkeepMemory memory;
  Passage passage;
  note_birth(mesh);
  for (int n = 0; n < steps; ++n) {
    test::move_vertices(mesh, [&](const Vec3d& x) { return step(n, x); });
    passage.add(mesh, keep_up(mesh, parameters, memory));
    if (!test::defects_of(mesh).none()) {
      ADD_FAILURE() << "not a closed manifold after step " << n;
      break;
    }
  }
  passage.crossings = test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles());
  std::printf(
      "[ MEASURED ] %zu triangles; edges %.2f to %.2f h, angles from %.2f deg, %.3f %% below 10 deg, folds to %.0f "
      "deg; "
      "%zu splits, %zu collapses, %zu of folds, %zu of slivers, %zu flips, %zu refused, %zu crossing\n",
      mesh.triangle_count(), passage.worst.shortest_edge / h, passage.worst.longest_edge / h,
      passage.worst.smallest_angle, 100.0 * passage.worst.share_below_10_degrees, passage.worst.largest_fold,
      passage.splits, passage.collapses, passage.folds, passage.slivers, passage.flips, passage.refused,
      passage.crossings);
  return passage;
}

TEST(UpkeepMotion, ASphereStretchedFourfoldAndBack) {
  constexpr double h = 0.1;
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 5);
  const double volume = test::volume_of(mesh);
  const double factor = std::pow(4.0, 1.0 / 40.0);
  const auto stretch = [&](double f) {
    return [f](int, const Vec3d& x) { return Vec3d(f * x.x(), x.y() / std::sqrt(f), x.z() / std::sqrt(f)); };
  };
  carry(mesh, h, 40, stretch(factor));
  std::printf("volume %.5f\n", test::volume_of(mesh) / volume);
  carry(mesh, h, 40, stretch(1.0 / factor));
  double squares = 0.0;
  for (const Vec3f& p : mesh.positions()) squares += std::pow(p.cast<double>().norm() - 1.0, 2);
  std::printf("volume %.5f rms %.5f h\n", test::volume_of(mesh) / volume,
              std::sqrt(squares / static_cast<double>(mesh.vertex_count())) / h);
}

TEST(UpkeepMotion, ASphereSqueezedToAQuarter) {
  constexpr double h = 0.1;
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 5);
  const double volume = test::volume_of(mesh);
  const double factor = std::pow(0.25, 1.0 / 40.0);
  carry(mesh, h, 40, [&](int, const Vec3d& x) { return Vec3d(factor * x); });
  std::printf("volume %.5f\n", test::volume_of(mesh) / volume * 64);
}

TEST(UpkeepMotion, ATorusTwists) {
  constexpr double h = 0.1;
  TriangleMesh mesh = test::make_torus({0.01, 0.02, 0.03}, 1.0, 0.4, 100, 40);
  const double volume = test::volume_of(mesh);
  const auto twist = [](double angle) {
    return [angle](int, const Vec3d& x) { return Vec3d(Eigen::AngleAxisd(angle * x.z(), Vec3d::UnitZ()) * x); };
  };
  carry(mesh, h, 40, twist(0.1));
  std::printf("volume %.5f\n", test::volume_of(mesh) / volume);
  carry(mesh, h, 40, twist(-0.1));
  double squares = 0.0;
  for (const Vec3f& p : mesh.positions()) {
    const Vec3d x = p.cast<double>() - Vec3d(0.01, 0.02, 0.03);
    squares += std::pow(std::hypot(std::hypot(x.x(), x.y()) - 1.0, x.z()) - 0.4, 2);
  }
  std::printf("volume %.5f rms %.5f h\n", test::volume_of(mesh) / volume,
              std::sqrt(squares / static_cast<double>(mesh.vertex_count())) / h);
}

/// The flow of Enright et al. 2002 at time t; it turns back at `period` / 2.
Vec3d vortex_velocity(const Vec3d& x, double t, double period) {
  const auto s = [](double v) { return std::sin(kPi * v); };
  const auto s2 = [](double v) { return std::sin(2.0 * kPi * v); };
  return std::cos(kPi * t / period) * Vec3d(2.0 * s(x.x()) * s(x.x()) * s2(x.y()) * s2(x.z()),
                                            -s2(x.x()) * s(x.y()) * s(x.y()) * s2(x.z()),
                                            -s2(x.x()) * s2(x.y()) * s(x.z()) * s(x.z()));
}

TEST(UpkeepMotion, ASphereInAVortexAndBack) {
  constexpr double h = 0.02;
  constexpr double period = 1.5;
  constexpr int steps = 60;
  const Vec3d center(0.35, 0.35, 0.35);
  TriangleMesh mesh = test::make_sphere(center, 0.15, 5);
  const double volume = test::volume_of(mesh);
  const double dt = period / steps;
  const Passage passage = carry(mesh, h, steps, [&](int n, const Vec3d& x) {
    const double t = n * dt;
    const Vec3d k1 = vortex_velocity(x, t, period);
    const Vec3d k2 = vortex_velocity(x + 0.5 * dt * k1, t + 0.5 * dt, period);
    const Vec3d k3 = vortex_velocity(x + 0.5 * dt * k2, t + 0.5 * dt, period);
    const Vec3d k4 = vortex_velocity(x + dt * k3, t + dt, period);
    return Vec3d(x + dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4));
  });
  double squares = 0.0;
  for (const Vec3f& p : mesh.positions()) squares += std::pow((p.cast<double>() - center).norm() - 0.15, 2);
  std::printf("volume %.5f rms %.5f h\n", test::volume_of(mesh) / volume,
              std::sqrt(squares / static_cast<double>(mesh.vertex_count())) / h);
  (void)passage;
}

}  // namespace
}  // namespace particle_surface_tracker
