#include "support/detailed_body.h"

#include <algorithm>
#include <cmath>

#include <openvdb/openvdb.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/stages/surface_triangulation.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

// All lengths in r, around the centre of the ball.
constexpr double kBallRadius = 16.3;
constexpr double kOuterRadius = 28.0;

double smooth_union(double a, double b) {
  constexpr double width = 0.6;
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * h * h * width;
}

double rippled_ball(const Vec3d& p) {
  constexpr double waves = 1.9;  // One ripple in 3.3 r.
  const double ripple = std::sin(waves * p.x() + 0.3) * std::sin(waves * p.y() + 1.1) * std::sin(waves * p.z() + 2.0);
  return p.norm() - kBallRadius - 0.25 * ripple;
}

/// A rod out of the ball whose thickness falls from 2 r to 1 r.
double spike(const Vec3d& p, const Vec3d& direction, double length) {
  const Vec3d axis = direction.normalized();
  const double along = std::clamp((p.dot(axis) - kBallRadius) / length, -0.2, 1.0);
  return (p - (kBallRadius + along * length) * axis).norm() - (1.0 - 0.5 * along);
}

/// A plate out of the ball, 1.5 r thick, 9 r long and 6 r high, in the plane of `direction` and `side`.
double fin(const Vec3d& p, const Vec3d& direction, const Vec3d& side) {
  const Vec3d up = direction.normalized();
  const Vec3d across = up.cross(side).normalized();
  const Vec3d q = p - (kBallRadius + 2.0) * up;
  constexpr double rounding = 0.5;
  const Eigen::Array3d outside = Eigen::Array3d(std::abs(q.dot(up)) - 4.0, std::abs(q.dot(across.cross(up))) - 4.5,
                                                std::abs(q.dot(across)) - 0.75) +
                                 rounding;
  return outside.max(0.0).matrix().norm() + std::min(outside.maxCoeff(), 0.0) - rounding;
}

/// A ring of 2 r thickness that stands halfway out of the ball.
double handle(const Vec3d& p, const Vec3d& direction, const Vec3d& side) {
  const Vec3d up = direction.normalized();
  const Vec3d normal = up.cross(side).normalized();
  const Vec3d q = p - (kBallRadius + 0.5) * up;
  const double height = q.dot(normal);
  const double in_plane = (q - height * normal).norm();
  return std::hypot(in_plane - 5.0, height) - 1.0;
}

double body(const Vec3d& p) {
  double d = rippled_ball(p);
  d = smooth_union(d, spike(p, {1.0, 0.2, 0.1}, 8.0));
  d = smooth_union(d, spike(p, {-0.9, 0.5, -0.3}, 6.0));
  d = smooth_union(d, spike(p, {0.1, -1.0, 0.4}, 9.0));
  d = smooth_union(d, fin(p, {0.2, 0.9, 0.5}, {1.0, 0.1, 0.0}));
  d = smooth_union(d, fin(p, {0.6, -0.6, -0.7}, {0.2, 0.3, 1.0}));
  d = smooth_union(d, handle(p, {-0.3, -0.4, 1.0}, {1.0, 0.6, 0.0}));
  d = smooth_union(d, handle(p, {-0.7, -0.2, -0.9}, {0.0, 1.0, 0.3}));
  return d;
}

}  // namespace

DetailedBody::DetailedBody(double r) : r_(r), center_(Vec3d(3.137, -1.618, 7.241) * r) {}

double DetailedBody::distance(const Vec3d& position) const {
  return r_ * body((position - center_) / r_);
}

TriangleMesh DetailedBody::mesh() const {
  const double dx = r_ / 3.0;
  const Eigen::Vector3i middle = (center_ / dx).array().round().cast<int>();
  const int reach = static_cast<int>(std::ceil(kOuterRadius * r_ / dx));
  const auto field = openvdb::FloatGrid::create(static_cast<float>(dx));
  auto accessor = field->getAccessor();
  for (int i = -reach; i <= reach; ++i) {
    for (int j = -reach; j <= reach; ++j) {
      for (int k = -reach; k <= reach; ++k) {
        const Eigen::Vector3i node = middle + Eigen::Vector3i(i, j, k);
        const double value = distance(dx * node.cast<double>());
        if (std::abs(value) > 3.0 * dx) continue;
        accessor.setValue(openvdb::Coord(node.x(), node.y(), node.z()), static_cast<float>(value));
      }
    }
  }
  SurfaceTriangulation surface = triangulate_zero_level(*field, dx);
  return TriangleMesh(std::move(surface.vertices), std::move(surface.triangles));
}

ParticleFrame DetailedBody::particles(double jitter) const {
  const Vec3d extent = Vec3d::Constant(kOuterRadius * r_);
  return fill_with_particles(center_ - extent, center_ + extent, r_, jitter, /*seed=*/17,
                             [&](const Vec3d& p) { return distance(p) < -0.1 * r_; });
}

}  // namespace particle_surface_tracker::test
