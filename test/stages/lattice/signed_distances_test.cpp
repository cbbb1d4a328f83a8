#include <algorithm>
#include <cmath>
#include <vector>

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "stages/lattice/lattice_cases.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using Kernel = CGAL::Simple_cartesian<CGAL::Gmpq>;
using openvdb::Coord;
using test::LatticeCase;

Kernel::FT squared_distance(const Kernel::Point_3& p, const Kernel::Point_3& a, const Kernel::Point_3& b,
                            const Kernel::Point_3& c) {
  if (!CGAL::collinear(a, b, c)) return CGAL::squared_distance(p, Kernel::Triangle_3(a, b, c));
  return std::min({CGAL::squared_distance(p, Kernel::Segment_3(a, b)),
                   CGAL::squared_distance(p, Kernel::Segment_3(b, c)),
                   CGAL::squared_distance(p, Kernel::Segment_3(c, a))});
}

/// Unsigned distance of a node to the nearest triangle, by looking at all of them.
double exact_distance(const MeshLattice& lattice, const Coord& node) {
  const Kernel::Point_3 place(lattice.plane(node.x()), lattice.plane(node.y()), lattice.plane(node.z()));
  const auto corner = [&](std::uint32_t v) {
    const Vec3f& p = lattice.positions()[v];
    return Kernel::Point_3(p.x(), p.y(), p.z());
  };
  Kernel::FT closest = 1e30;
  for (const auto& [a, b, c] : lattice.triangles()) {
    closest = std::min(closest, squared_distance(place, corner(a), corner(b), corner(c)));
  }
  return std::sqrt(CGAL::to_double(closest));
}

void expect_exact_distances(const LatticeCase& body, double reach) {
  SCOPED_TRACE(body.name);
  const MeshLattice lattice(body.mesh.positions(), body.mesh.triangles(), body.h);
  std::vector<Coord> nodes;
  const Coord origin = lattice.cell_of_vertex(0);
  for (int n = 0; n < 200; ++n) nodes.push_back(origin.offsetBy(n % 7 - 3, n / 7 % 6 - 3, n / 42 - 2));
  const std::vector<float> distances = signed_distances(lattice, nodes, reach);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double expected = std::min(reach, exact_distance(lattice, nodes[n]));
    EXPECT_NEAR(std::abs(distances[n]), expected, 1e-6 * body.h) << nodes[n];
    const bool is_inside = lattice.winding_number(nodes[n]) >= 1;
    EXPECT_EQ(distances[n] < 0.0f, is_inside) << nodes[n];
  }
}

TEST(SignedDistances, AreThoseToTheNearestTriangle) {
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    for (const double reach : {0.7, 2.5}) {
      expect_exact_distances(test::random_closed_mesh(seed, test::Coordinates::kRandom), reach);
      expect_exact_distances(test::random_closed_mesh(seed, test::Coordinates::kOnLattice), reach);
      expect_exact_distances(test::random_closed_mesh(seed, test::Coordinates::kNearLattice), 0.2 * reach);
    }
  }
}

TEST(SignedDistances, AlignedBodies) {
  for (const LatticeCase& body : test::aligned_bodies()) {
    if (body.mesh.triangle_count() < 100) expect_exact_distances(body, 1.3);
  }
}

TEST(SignedDistances, AreNegativeInsideAndAtMostTheReach) {
  const TriangleMesh box = test::make_box({0.5, 0.5, 0.5}, {4.5, 4.5, 4.5});
  const MeshLattice lattice(box.positions(), box.triangles(), 1.0);
  const std::vector<Coord> nodes = {Coord(1, 2, 2), Coord(0, 2, 2), Coord(2, 2, 2), Coord(-9, 2, 2), Coord(5, 5, 2)};
  EXPECT_EQ(signed_distances(lattice, nodes, 1.25),
            (std::vector<float>{-0.5f, 0.5f, -1.25f, 1.25f, static_cast<float>(std::sqrt(0.5))}));
}

}  // namespace
}  // namespace particle_surface_tracker
