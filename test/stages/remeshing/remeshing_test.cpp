#include "particle_surface_tracker/stages/remeshing.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "remeshing_support.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

constexpr double kPi = 3.14159265358979323846;

TEST(Remeshing, LeavesAMeshWithNothingToDoAlone) {
  const TriangleMesh before = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  TriangleMesh mesh = before;
  const RemeshingReport report = test::remesh_at(mesh, 0.1);
  EXPECT_FALSE(report.changed());
  EXPECT_EQ(report.remeshed_cells, 0u);
  test::expect_same(mesh, before);
}

TEST(Remeshing, MakesTheWholeMeshAnew) {
  const TriangleMesh before = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  TriangleMesh mesh = before;
  RemeshingRequest request;
  for (int x = -12; x <= 12; ++x) {
    for (int y = -12; y <= 12; ++y) {
      for (int z = -12; z <= 12; ++z) request.flagged_cells.emplace_back(x, y, z);
    }
  }
  const RemeshingReport report = test::remesh_at(mesh, 0.1, request);
  test::expect_sound(mesh);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_EQ(report.removed_triangles, before.triangle_count());
  EXPECT_EQ(report.new_vertices, mesh.vertex_count());
  EXPECT_GE(mesh.ids().front(), before.next_id());
  EXPECT_NEAR(test::measures_of(mesh).volume, test::measures_of(before).volume,
              0.01 * test::measures_of(before).volume);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
  EXPECT_EQ(test::count_inverted_triangles(mesh.positions(), mesh.triangles()), 0u);
  for (const Vec3f& p : mesh.positions()) EXPECT_NEAR((p - Vec3f(0.03f, -0.02f, 0.01f)).norm(), 1.0, 0.01);
}

TEST(Remeshing, MakesRandomCellsAnew) {
  const TriangleMesh before = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  const MeshLattice lattice(before.positions(), before.triangles(), 0.1);
  std::size_t inverted = 0;
  std::size_t all = 0;
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    RemeshingRequest request;
    const double share = std::pow(10.0, -3.0 * (seed % 10) / 10.0);
    for (const Coord& cell : lattice.cells()) {
      if (std::uniform_real_distribution<double>()(random) < share) request.flagged_cells.push_back(cell);
    }
    TriangleMesh mesh = before;
    const RemeshingReport report = remesh(mesh, lattice, request);
    test::expect_sound(mesh);
    EXPECT_EQ(report.retries, 0u);
    const MeshMeasures measures = test::measures_of(mesh);
    EXPECT_NEAR(measures.volume, test::measures_of(before).volume, 0.01 * test::measures_of(before).volume);
    EXPECT_EQ(measures.components, 1u);
    EXPECT_EQ(measures.genus, 0);
    inverted += test::count_inverted_triangles(mesh.positions(), mesh.triangles());
    all += report.new_triangles;
  }
  // The line along which the mesh was cut can wind so much that no fan sees all of it.
  EXPECT_LT(inverted, all / 1000);
}

TEST(Remeshing, MakesCellsAnewInWhichTrianglesCrossIfAsked) {
  const double h = 0.25;
  TriangleMesh before = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 6);
  // The vertices well inside one cell are thrown about.
  const Coord crumpled(3, 1, 1);
  for (std::uint32_t v = 0; v < before.vertex_count(); ++v) {
    Vec3f& p = before.positions()[v];
    const Vec3d place = p.cast<double>() / h - Vec3d(crumpled.x() + 0.5, crumpled.y() + 0.5, crumpled.z() + 0.5);
    if (place.cwiseAbs().maxCoeff() > 0.3) continue;
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      p[axis] += static_cast<float>(0.2 * h * test::hash_noise(1, static_cast<std::int32_t>(v), 0, 0, axis));
    }
  }
  ASSERT_GT(test::count_self_intersecting_triangles(before.positions(), before.triangles()), 0u);

  TriangleMesh mesh = before;
  EXPECT_FALSE(test::remesh_at(mesh, h).changed());
  test::expect_same(mesh, before);

  RemeshingRequest request;
  request.remesh_crossings = true;
  const RemeshingReport report = test::remesh_at(mesh, h, request);
  test::expect_sound(mesh);
  EXPECT_GE(report.tangled_cells, 1u);
  EXPECT_LE(report.remeshed_cells, 8u);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);

  TriangleMesh smooth = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  EXPECT_FALSE(test::remesh_at(smooth, h, request).changed());
}

TEST(Remeshing, FollowsANewGamma) {
  const double h = 0.1;
  TriangleMesh mesh = test::make_sphere({0.01, 0.02, 0.03}, 1.0, 5);
  RemeshingRequest request;
  for (int x = -3; x <= 3; ++x) {
    for (int y = -12; y <= 12; ++y) {
      for (int z = -12; z <= 12; ++z) {
        const Vec3d node = h * Vec3d(x, y, z);
        request.nodes.emplace_back(x, y, z);
        const double sphere = (node - Vec3d(0.01, 0.02, 0.03)).norm() - 1.0;
        request.gamma.push_back(static_cast<float>(std::max(sphere, 0.15 - std::abs(node.x()))));
      }
    }
  }
  const RemeshingReport report = test::remesh_at(mesh, h, request);
  test::expect_sound(mesh);
  EXPECT_GT(report.changed_nodes, 0u);
  EXPECT_EQ(test::measures_of(mesh).components, 2u);
  EXPECT_EQ(test::measures_of(mesh).genus, 0);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
  for (const Vec3f& p : mesh.positions()) EXPECT_GT(std::abs(p.x()), 0.14);
  EXPECT_NEAR(test::measures_of(mesh).volume, 4.0 / 3.0 * kPi - 0.3 * kPi, 0.02 * 4.0 / 3.0 * kPi);
}

TEST(Remeshing, AttributesOfNewVerticesAreThoseOfTheMeshNearby) {
  TriangleMesh mesh =
      test::joined({test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5), test::make_sphere({1.53, -0.02, 0.01}, 1.0, 5)});
  const std::size_t place = mesh.attributes().add("place", 3, {0.0f, 0.0f, 0.0f});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    for (int axis = 0; axis < 3; ++axis) mesh.attributes()[place].values[3 * v + axis] = mesh.positions()[v][axis];
  }
  const RemeshingReport report = test::remesh_at(mesh, 0.1);
  ASSERT_GT(report.new_vertices, 0u);
  for (std::size_t v = mesh.vertex_count() - report.new_vertices; v < mesh.vertex_count(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(mesh.attributes()[place].values[3 * v + axis], mesh.positions()[v][axis], 0.08);
    }
  }
}

TEST(Remeshing, MendsOrLeavesAMeshThatIsNotClosed) {
  const TriangleMesh sphere = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  std::size_t mended = 0;
  std::size_t fallbacks = 0;
  for (std::size_t missing = 0; missing < sphere.triangle_count(); missing += 500) {
    SCOPED_TRACE(missing);
    std::vector<Triangle> triangles = sphere.triangles();
    triangles.erase(triangles.begin() + static_cast<std::ptrdiff_t>(missing));
    const TriangleMesh before(sphere.positions(), triangles);
    TriangleMesh mesh = before;
    RemeshingRequest request;
    request.flagged_cells.emplace_back(10, 0, 0);
    const RemeshingReport report = test::remesh_at(mesh, 0.1, request);
    fallbacks += report.fallbacks;
    if (report.gave_up) {
      test::expect_same(mesh, before);
      continue;
    }
    ++mended;
    test::expect_sound(mesh);
    EXPECT_NEAR(test::measures_of(mesh).volume, test::measures_of(sphere).volume,
                0.01 * test::measures_of(sphere).volume);
  }
  EXPECT_GT(mended, 0u);
  EXPECT_GT(fallbacks, 0u);
}

TEST(Remeshing, RefusesWhatDoesNotBelongTogether) {
  TriangleMesh mesh = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 2);
  TriangleMesh other = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 3);
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), 0.1);
  EXPECT_THROW(remesh(other, lattice, {}), MeshError);
  RemeshingRequest request;
  request.nodes.emplace_back(0, 0, 0);
  EXPECT_THROW(remesh(mesh, lattice, request), MeshError);
}

}  // namespace
}  // namespace particle_surface_tracker
