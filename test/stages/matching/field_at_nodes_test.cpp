#include "stages/matching/field_at_nodes.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <openvdb/math/Proximity.h>
#include <tbb/global_control.h>

#include "matching_cases.h"
#include "stages/matching/nodes_at_surfaces.h"

namespace particle_surface_tracker::test::matching {
namespace {

/// A ball with a bubble in it that holds a drop, and a drop outside.
Body nested_body() {
  const Body shell = without(ball({0.02, 0.01, -0.03}, 1.2), ball({0.0, 0.1, 0.0}, 0.7));
  return either(either(shell, ball({0.05, 0.1, 0.0}, 0.3)), ball({1.5, 1.4, 1.3}, 0.2));
}

std::vector<openvdb::Coord> all_nodes() {
  std::vector<openvdb::Coord> nodes;
  const openvdb::CoordBBox box(openvdb::Coord(-kHalfWidth), openvdb::Coord(kHalfWidth));
  for (auto node = box.begin(); node; ++node) nodes.push_back(*node);
  return nodes;
}

double distance_to(const SurfaceTriangulation& surface, const Vec3d& place) {
  const auto at = [&](std::uint32_t v) {
    const Vec3f& p = surface.vertices[v];
    return openvdb::Vec3d(p.x(), p.y(), p.z());
  };
  const openvdb::Vec3d from(place.x(), place.y(), place.z());
  double closest = 1e30;
  for (const Triangle& t : surface.triangles) {
    openvdb::Vec3d unused;
    const openvdb::Vec3d point =
        openvdb::math::closestPointOnTriangleToPoint(at(t[0]), at(t[1]), at(t[2]), from, unused);
    closest = std::min(closest, (point - from).length());
  }
  return closest;
}

TEST(FieldAtNodes, TheSideIsRightEverywhereHoweverFarFromTheSurface) {
  const Body body = nested_body();
  const ImplicitSurface surface = make_surface(body);
  const std::vector<openvdb::Coord> nodes = all_nodes();
  const double reach = 3.0 * kH;
  const std::vector<float> phi = FieldAtNodes(surface, kH).distances(nodes, reach);
  std::size_t far_inside = 0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double distance = body(place(nodes[n]));
    ASSERT_EQ(phi[n] < 0.0f, distance < 0.0) << nodes[n];
    ASSERT_LE(std::abs(phi[n]), static_cast<float>(reach));
    far_inside += phi[n] == static_cast<float>(-reach) ? 1 : 0;
  }
  EXPECT_GT(far_inside, 1000u) << "the case shall have nodes deep inside";
}

TEST(FieldAtNodes, DistancesAreThoseToTheTriangulation) {
  const Body body = nested_body();
  const ImplicitSurface surface = make_surface(body);
  std::vector<openvdb::Coord> nodes = all_nodes();
  std::shuffle(nodes.begin(), nodes.end(), std::mt19937(3));
  nodes.resize(400);
  const double reach = 9.0 * kH;
  const std::vector<float> phi = FieldAtNodes(surface, kH).distances(nodes, reach);
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const double expected = std::min(reach, distance_to(surface.triangulation, place(nodes[n])));
    // What the distance field promises (Sec. 5.1).
    EXPECT_NEAR(std::abs(phi[n]), expected, 0.02 * kH) << nodes[n];
  }
}

TEST(FieldAtNodes, AnotherLatticeIsInterpolatedLinearly) {
  for (const double dx : {0.4 * kH, 0.8 * kH, 2.0 * kH}) {
    const ImplicitSurface surface = make_surface(either(ball({0, 0, 0}, 0.9), ball({0, 0, 0.3}, 0.8)), dx);
    const std::vector<openvdb::Coord> nodes = {{0, 0, 20}, {3, 2, 18}, {-5, 7, -17}, {0, 0, 0}, {19, 0, 0}};
    const std::vector<float> phi = FieldAtNodes(surface, kH).distances(nodes, 8.0 * kH);
    const FieldAtNodes own(surface, dx);
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      double expected = 0.0;
      const Vec3d at = place(nodes[n]) / dx;
      const openvdb::Coord cell(static_cast<int>(std::floor(at.x())), static_cast<int>(std::floor(at.y())),
                                static_cast<int>(std::floor(at.z())));
      for (int c = 0; c < 8; ++c) {
        const openvdb::Coord corner = cell.offsetBy(c & 1, c >> 1 & 1, c >> 2);
        double weight = 1.0;
        for (int axis = 0; axis < 3; ++axis) weight *= 1.0 - std::abs(at[axis] - corner[axis]);
        expected += weight * static_cast<double>(own.distances({corner}, 8.0 * kH)[0]);
      }
      EXPECT_NEAR(phi[n], expected, 1e-6) << "dx " << dx << " node " << nodes[n];
    }
  }
}

TEST(FieldAtNodes, NodesOnTheIsosurfaceAreNearIt) {
  // The squared distance of one of these nodes is rounded to below 0.
  const Body plate = [](const Vec3d& p) {
    return std::max({std::abs(p.x()) - 1.5, std::abs(p.y()) - 1.5, std::abs(p.z()) - 0.1});
  };
  std::vector<openvdb::Coord> nodes;
  for (int x = -29; x < 30; ++x) {
    for (int y = -29; y < 30; ++y) nodes.emplace_back(x, y, -2);
  }
  for (const float phi : FieldAtNodes(make_surface(plate), kH).distances(nodes, 2.0 * kH)) {
    EXPECT_LT(std::abs(phi), 0.01 * kH);
  }
}

TEST(FieldAtNodes, WithoutASurfaceEverythingIsOutside) {
  const ImplicitSurface surface = make_surface([](const Vec3d&) { return 1.0; });
  EXPECT_EQ(FieldAtNodes(surface, kH).distances({{0, 0, 0}, {5, -3, 100}}, 0.3), std::vector<float>(2, 0.3f));
}

TEST(FieldAtNodes, IsTheSameForAnyNumberOfThreads) {
  const ImplicitSurface surface = make_surface(nested_body());
  const std::vector<openvdb::Coord> nodes = all_nodes();
  std::vector<std::vector<float>> results;
  for (const std::size_t threads : {1u, 2u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(FieldAtNodes(surface, kH).distances(nodes, 5.0 * kH));
  }
  EXPECT_EQ(results[0], results[1]);
}

TEST(LineSigns, OfTheMeshAreItsWindingNumbers) {
  TriangleMesh mesh = make_mesh(nested_body());
  // An overlapping copy, so that there are nodes with 2.
  std::vector<Vec3f> positions = mesh.positions();
  std::vector<Triangle> triangles = mesh.triangles();
  const auto count = static_cast<std::uint32_t>(positions.size());
  for (const Vec3f& p : mesh.positions()) positions.push_back(p + Vec3f(0.3f, 0.1f, 0.2f));
  for (const Triangle& t : mesh.triangles()) triangles.push_back({t[0] + count, t[1] + count, t[2] + count});
  const MeshLattice lattice(positions, triangles, kH);
  const LineSigns signs = make_mesh_signs(lattice);
  std::size_t tangled = 0;
  for (const openvdb::Coord& node : all_nodes()) {
    const LineSigns::Leaf leaf = signs.leaf(node & ~7);
    const int bit = 8 * (node.y() & 7) + (node.z() & 7);
    const int winding = lattice.winding_number(node);
    ASSERT_EQ(leaf.inside[node.x() & 7] >> bit & 1, winding >= 1 ? 1u : 0u) << node;
    ASSERT_EQ(leaf.tangled[node.x() & 7] >> bit & 1, winding != 0 && winding != 1 ? 1u : 0u) << node;
    tangled += winding == 2 ? 1 : 0;
  }
  EXPECT_GT(tangled, 0u);
}

TEST(NodesAtSurfaces, AnotherLatticeGivesTheNodesInCutCellsWithTheirSides) {
  const Body body = ball({0.01, 0.02, 0.03}, 0.8);
  for (const double dx : {0.5 * kH, kH, 2.0 * kH}) {
    const ImplicitSurface surface = make_surface(body, dx);
    const NodesAtIsosurface nodes = nodes_at_isosurface(surface, kH);
    std::size_t count = 0;
    for (const auto* side : {&nodes.inside, &nodes.outside}) {
      for (const NodeMasks::Leaf& leaf : side->leaves()) {
        for (int x = 0; x < 8; ++x) {
          for_each_bit(leaf.words[x], [&](int bit) {
            const double distance = body(place(leaf.origin.offsetBy(x, bit >> 3, bit & 7)));
            EXPECT_LT(std::abs(distance), std::sqrt(3.0) * dx);
            if (std::abs(distance) > 0.1 * dx) {
              EXPECT_EQ(distance < 0.0, side == &nodes.inside);
            }
            ++count;
          });
        }
      }
    }
    EXPECT_GT(count, 1000u) << dx;
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test::matching
