// Signs where doubles have the wrong one: lattice lines and nodes as close to edges and planes as doubles can be.

#include "stages/lattice/lattice_predicates.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <boost/multiprecision/gmp.hpp>

namespace particle_surface_tracker {
namespace {

using Number = boost::multiprecision::mpq_rational;

int sign_of(const Number& x) {
  return x > 0 ? 1 : (x < 0 ? -1 : 0);
}

Number exact(double x) {
  return Number(x);
}

/// (q − p) × (r − p) along an axis.
Number exact_normal(const Vec3f& p, const Vec3f& q, const Vec3f& r, int axis) {
  const int a = (axis + 1) % 3;
  const int b = (axis + 2) % 3;
  return (exact(q[a]) - exact(p[a])) * (exact(r[b]) - exact(p[b])) -
         (exact(q[b]) - exact(p[b])) * (exact(r[a]) - exact(p[a]));
}

Number exact_height(const Vec3f& p, const Vec3f& q, const Vec3f& r, const Vec3d& node) {
  Number sum = 0;
  for (int axis = 0; axis < 3; ++axis) sum += exact_normal(p, q, r, axis) * (exact(node[axis]) - exact(p[axis]));
  return sum;
}

class Places {
 public:
  explicit Places(std::uint32_t seed) : random_(seed) {}

  double draw() { return std::uniform_real_distribution<double>(-100.0, 100.0)(random_); }

  Vec3f draw_corner() {
    const double x = draw();
    const double y = draw();
    return Vec3d(x, y, draw()).cast<float>();
  }

 private:
  std::mt19937 random_;
};

TEST(LatticePredicates, SideOfAnEdgeIsExact) {
  Places places(1);
  int doubtful = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3f p = places.draw_corner();
    const Vec3f q = places.draw_corner();
    const double x = places.draw();
    const double y = p.y() + (x - p.x()) * (static_cast<double>(q.y()) - p.y()) / (static_cast<double>(q.x()) - p.x());
    const Number expected = (exact(q.x()) - exact(p.x())) * (exact(y) - exact(p.y())) -
                            (exact(q.y()) - exact(p.y())) * (exact(x) - exact(p.x()));
    const double rounded =
        (static_cast<double>(q.x()) - p.x()) * (y - p.y()) - (static_cast<double>(q.y()) - p.y()) * (x - p.x());
    if (expected == 0) continue;
    doubtful += (rounded > 0.0) - (rounded < 0.0) != sign_of(expected);
    ASSERT_EQ(side_of_edge(p, q, 0, 1, x, y), sign_of(expected)) << n;
    ASSERT_EQ(side_of_edge(q, p, 0, 1, x, y), -sign_of(expected)) << n;
    ASSERT_EQ(side_of_edge(p, q, 1, 0, y, x), -sign_of(expected)) << n;
  }
  // Else this test would not ask for exact arithmetic.
  EXPECT_GT(doubtful, 1000);
}

TEST(LatticePredicates, SideOfATriangleIsExact) {
  Places places(2);
  int doubtful = 0;
  for (int n = 0; n < 20000; ++n) {
    const Vec3f p = places.draw_corner();
    const Vec3f q = places.draw_corner();
    const Vec3f r = places.draw_corner();
    const Vec3d origin = p.cast<double>();
    const Vec3d to_q = q.cast<double>() - origin;
    const Vec3d to_r = r.cast<double>() - origin;
    const Vec3d node = origin + 0.01 * std::abs(places.draw()) * to_q + 0.01 * std::abs(places.draw()) * to_r;
    const Number expected = exact_height(p, q, r, node);
    if (expected == 0) continue;
    const double rounded = to_q.cross(to_r).dot(node - origin);
    doubtful += (rounded > 0.0) - (rounded < 0.0) != sign_of(expected);
    ASSERT_EQ(side_of_triangle({&p, &q, &r}, node), sign_of(expected)) << n;
    ASSERT_EQ(side_of_triangle({&p, &r, &q}, node), -sign_of(expected)) << n;
  }
  EXPECT_GT(doubtful, 1000);
}

/// Triangles that a line along z crosses within a few units in the last place of each other.
TEST(LatticePredicates, OrderAlongALineIsExact) {
  Places places(3);
  int compared = 0;
  for (int n = 0; n < 5000; ++n) {
    const Vec3d node(places.draw(), places.draw(), 0.0);
    Vec3f first[3];
    Vec3f second[3];
    for (Vec3f* corners : {first, second}) {
      for (int i = 0; i < 2; ++i) corners[i] = places.draw_corner();
      // Around the line, and through its origin up to the rounding of floats.
      const Vec3d sum = corners[0].cast<double>() + corners[1].cast<double>();
      corners[2] = (3.0 * node - sum).cast<float>();
    }
    const Number first_facing = exact_normal(first[0], first[1], first[2], 2);
    const Number second_facing = exact_normal(second[0], second[1], second[2], 2);
    if (first_facing == 0 || second_facing == 0) continue;
    // The line is at the height −D/n over the node.
    const Number expected = exact_height(second[0], second[1], second[2], node) / second_facing -
                            exact_height(first[0], first[1], first[2], node) / first_facing;
    if (expected == 0) continue;
    const CrossedTriangle below = {{&first[0], &first[1], &first[2]}, sign_of(first_facing)};
    const CrossedTriangle above = {{&second[0], &second[1], &second[2]}, sign_of(second_facing)};
    ASSERT_EQ(compare_along_line(below, above, 2, node), sign_of(expected)) << n;
    ASSERT_EQ(compare_along_line(above, below, 2, node), -sign_of(expected)) << n;
    ++compared;
  }
  EXPECT_GT(compared, 4900);
}

}  // namespace
}  // namespace particle_surface_tracker
