#include "stages/projection/foot_point.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "support/fields.h"

namespace particle_surface_tracker {
namespace {

constexpr double r = 0.1;
constexpr double dx = 0.05;

/// Outside lies between two walls that stand at an angle, in a pose that the lattice does not share.
class Crease {
 public:
  explicit Crease(double angle) {
    const Vec3d along = Vec3d(1.0, 2.0, 3.0).normalized();
    const Vec3d bisector = along.cross(Vec3d(0.3, -0.7, 0.2)).normalized();
    const Vec3d across = along.cross(bisector);
    for (int wall = 0; wall < 2; ++wall) {
      const double side = wall == 0 ? 1.0 : -1.0;
      normals_[wall] = std::sin(angle / 2) * bisector + side * std::cos(angle / 2) * across;
    }
  }

  /// Outside, the distance to the nearer wall.
  double distance(const Vec3d& x) const { return std::min(normals_[0].dot(x), normals_[1].dot(x)); }

  SignedDistanceField field() const {
    return test::make_field(Vec3d::Constant(-0.7), Vec3d::Constant(0.7), dx, 0.3,
                            [this](const Vec3d& x) { return distance(x); });
  }

  /// Places in the crease, as far from the nearer wall as the vertices of fine detail are.
  std::vector<Vec3f> places(int count) const {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-0.3, 0.3);
    std::vector<Vec3f> places;
    while (static_cast<int>(places.size()) < count) {
      const Vec3d x(uniform(random), uniform(random), uniform(random));
      if (distance(x) > 0.2 * r && distance(x) < 0.9 * r) places.push_back(x.cast<float>());
    }
    return places;
  }

 private:
  Vec3d normals_[2];
};

/// Places for which |x − x*| and the distance to the nearer wall differ by more than 0.1 r.
std::size_t count_misses(const Crease& crease, const std::vector<Vec3f>& places,
                         const std::vector<SurfacePoint>& found) {
  std::size_t misses = 0;
  for (std::size_t v = 0; v < places.size(); ++v) {
    const Vec3d x = places[v].cast<double>();
    EXPECT_EQ(found[v].status, ProjectionStatus::kFound);
    const double error = (x - found[v].position).norm() - crease.distance(x);
    EXPECT_LT(std::abs(error), 0.6 * r);
    if (std::abs(error) > 0.1 * r) ++misses;
  }
  return misses;
}

TEST(FootPoint, TheDistanceInACreaseIsThatToAWall) {
  for (const double degrees : {60.0, 90.0}) {
    const Crease crease(degrees * std::acos(-1.0) / 180.0);
    const SignedDistanceField field = crease.field();
    const std::vector<Vec3f> places = crease.places(2000);
    const FieldLeaves leaves(field);
    SurfaceSearch search(field, leaves, {0.35f, 0.005f * static_cast<float>(dx), 100});
    std::vector<SurfacePoint> found(places.size());
    search.find(places, 0, places.size(), found);
    EXPECT_GE(count_misses(crease, places, found), 10u) << degrees << " degrees: a search alone must be seen to miss";
    slide_to_foot_points(places, 0, places.size(), r, search, found);
    EXPECT_LE(count_misses(crease, places, found), 1u) << degrees << " degrees";
  }
}

TEST(FootPoint, WhatIsAFootAlreadyStaysBitForBit) {
  const SignedDistanceField field = test::make_field(Vec3d::Constant(-1.0), Vec3d::Constant(1.0), dx, 0.35,
                                                     [](const Vec3d& x) { return x.norm() - 0.6; });
  const FieldLeaves leaves(field);
  SurfaceSearch search(field, leaves, {0.35f, 0.005f * static_cast<float>(dx), 100});
  const std::vector<Vec3f> vertices = {{0.65f, 0.1f, 0.0f}, {0.1f, 0.5f, 0.2f}, {-0.4f, 0.4f, -0.4f}};
  std::vector<SurfacePoint> found(vertices.size());
  search.find(vertices, 0, vertices.size(), found);
  std::vector<SurfacePoint> slid = found;
  slide_to_foot_points(vertices, 0, vertices.size(), r, search, slid);
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    EXPECT_EQ(slid[v].position, found[v].position) << v;
    EXPECT_EQ(slid[v].normal, found[v].normal) << v;
  }
}

}  // namespace
}  // namespace particle_surface_tracker
