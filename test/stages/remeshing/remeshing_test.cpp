#include "particle_surface_tracker/stages/remeshing.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_measures.h"
#include "sequences/mesh_judge.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

constexpr double kPi = 3.14159265358979323846;

RemeshingReport remesh_at(TriangleMesh& mesh, double h, const RemeshingRequest& request = {}) {
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), h);
  return remesh(mesh, lattice, request);
}

void expect_sound(const TriangleMesh& mesh) {
  EXPECT_TRUE(test::find_surface_defects(mesh.vertex_count(), mesh.triangles()).none());
}

MeshMeasures measures_of(const TriangleMesh& mesh) {
  return measure_mesh(mesh.positions(), mesh.triangles());
}

void expect_same(const TriangleMesh& mesh, const TriangleMesh& before) {
  EXPECT_EQ(mesh.positions(), before.positions());
  EXPECT_EQ(mesh.triangles(), before.triangles());
  EXPECT_EQ(mesh.ids(), before.ids());
  EXPECT_EQ(mesh.delta(), before.delta());
}

/// Components of positive volume; the others are air inside them.
std::size_t count_bodies(const TriangleMesh& mesh) {
  std::size_t count = 0;
  const auto component = vertex_components(mesh.vertex_count(), mesh.triangles(), count);
  std::vector<std::vector<Triangle>> parts(count);
  for (const Triangle& triangle : mesh.triangles()) parts[component[triangle[0]]].push_back(triangle);
  return static_cast<std::size_t>(std::count_if(parts.begin(), parts.end(), [&](const std::vector<Triangle>& part) {
    return measure_mesh(mesh.positions(), part).volume > 0.0;
  }));
}

/// A sphere whose middle is drawn in to a neck around (0, y, z).
TriangleMesh make_dumbbell(double neck_radius, double y, double z) {
  TriangleMesh mesh = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 5);
  for (Vec3f& p : mesh.positions()) {
    p.x() *= 2.0f;
    const double shrink = 1.0 - (1.0 - neck_radius) * std::exp(-p.x() * p.x());
    p.y() = static_cast<float>(y + shrink * p.y());
    p.z() = static_cast<float>(z + shrink * p.z());
  }
  return mesh;
}

TEST(Remeshing, LeavesAMeshWithNothingToDoAlone) {
  const TriangleMesh before = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  TriangleMesh mesh = before;
  const RemeshingReport report = remesh_at(mesh, 0.1);
  EXPECT_FALSE(report.changed());
  EXPECT_EQ(report.remeshed_cells, 0u);
  expect_same(mesh, before);
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
  const RemeshingReport report = remesh_at(mesh, 0.1, request);
  expect_sound(mesh);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_EQ(report.removed_triangles, before.triangle_count());
  EXPECT_EQ(report.new_vertices, mesh.vertex_count());
  EXPECT_GE(mesh.ids().front(), before.next_id());
  EXPECT_NEAR(measures_of(mesh).volume, measures_of(before).volume, 0.01 * measures_of(before).volume);
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
    expect_sound(mesh);
    EXPECT_EQ(report.retries, 0u);
    const MeshMeasures measures = measures_of(mesh);
    EXPECT_NEAR(measures.volume, measures_of(before).volume, 0.01 * measures_of(before).volume);
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
  EXPECT_FALSE(remesh_at(mesh, h).changed());
  expect_same(mesh, before);

  RemeshingRequest request;
  request.remesh_crossings = true;
  const RemeshingReport report = remesh_at(mesh, h, request);
  expect_sound(mesh);
  EXPECT_GE(report.tangled_cells, 1u);
  EXPECT_LE(report.remeshed_cells, 8u);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);

  TriangleMesh smooth = test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5);
  EXPECT_FALSE(remesh_at(smooth, h, request).changed());
}

TEST(Remeshing, MergesTwoSpheres) {
  const double distance = 1.5;
  TriangleMesh mesh =
      test::joined({test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5),
                    test::make_sphere(Vec3d(0.03, -0.02, 0.01) + distance * Vec3d(2, 1, 2) / 3.0, 1.0, 5)});
  const RemeshingReport report = remesh_at(mesh, 0.1);
  expect_sound(mesh);
  EXPECT_GT(report.tangled_cells, 0u);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_EQ(measures_of(mesh).components, 1u);
  EXPECT_EQ(measures_of(mesh).genus, 0);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
  const double lens = kPi * (4.0 + distance) * (2.0 - distance) * (2.0 - distance) / 12.0;
  EXPECT_NEAR(measures_of(mesh).volume, 8.0 / 3.0 * kPi - lens, 0.01 * 8.0 / 3.0 * kPi);
}

TEST(Remeshing, MergesBoxesThatShareAFaceOnTheLattice) {
  TriangleMesh mesh = test::joined(
      {test::make_box({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}), test::make_box({1.0, 0.0, 0.0}, {2.0, 1.0, 1.0})});
  const RemeshingReport report = remesh_at(mesh, 0.125);
  expect_sound(mesh);
  EXPECT_EQ(report.retries, 0u);
  EXPECT_EQ(measures_of(mesh).components, 1u);
  EXPECT_EQ(measures_of(mesh).genus, 0);
  EXPECT_NEAR(measures_of(mesh).volume, 2.0, 0.02);
}

TEST(Remeshing, MergesCoincidentCopies) {
  const TriangleMesh sphere = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 4);
  TriangleMesh mesh = test::joined({sphere, sphere, sphere});
  remesh_at(mesh, 0.125);
  expect_sound(mesh);
  EXPECT_EQ(measures_of(mesh).components, 1u);
  EXPECT_NEAR(measures_of(mesh).volume, measures_of(sphere).volume, 0.01 * measures_of(sphere).volume);
}

TEST(Remeshing, RemovesASolidInASolidButKeepsACavity) {
  const TriangleMesh outer = test::make_sphere({0.01, 0.02, 0.03}, 1.0, 5);
  const TriangleMesh inner = test::make_sphere({0.04, 0.02, 0.03}, 0.5, 4);
  TriangleMesh solids = test::joined({outer, inner});
  remesh_at(solids, 0.1);
  expect_same(solids, outer);
  const TriangleMesh before = test::joined({outer, test::turned(inner)});
  TriangleMesh cavity = before;
  EXPECT_FALSE(remesh_at(cavity, 0.1).changed());
  expect_same(cavity, before);
}

TEST(Remeshing, BreaksAThreadThatNoNodeIsIn) {
  TriangleMesh mesh = make_dumbbell(0.01, 0.05, 0.05);
  const RemeshingReport report = remesh_at(mesh, 0.1);
  expect_sound(mesh);
  EXPECT_GT(report.deep_cells, 0u);
  EXPECT_EQ(measures_of(mesh).components, 2u);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
}

TEST(Remeshing, KeepsAThreadWithNodesInIt) {
  const TriangleMesh before = make_dumbbell(0.01, 0.0, 0.0);
  TriangleMesh mesh = before;
  EXPECT_FALSE(remesh_at(mesh, 0.1).changed());
  expect_same(mesh, before);
}

TEST(Remeshing, KeepsDetailBelowACellNextToTheSurface) {
  TriangleMesh before = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 6);
  for (Vec3f& p : before.positions()) {
    if ((p - Vec3f(0.0f, 0.0f, 1.0f)).norm() < 0.03f) p *= 1.1f;
  }
  TriangleMesh mesh = before;
  EXPECT_FALSE(remesh_at(mesh, 0.1).changed());
  expect_same(mesh, before);
}

TEST(Remeshing, RemovesASheetThatNoNodeIsIn) {
  const TriangleMesh sphere = test::make_sphere({0.0, 0.0, 0.0}, 1.0, 5);
  TriangleMesh disc = test::make_sphere({0.0, 0.0, 0.0}, 0.7, 5);
  for (Vec3f& p : disc.positions()) p = Vec3f(p.x() + 3.0f, p.y(), 0.01f * p.z() + 0.05f);
  TriangleMesh mesh = test::joined({sphere, disc});
  const RemeshingReport report = remesh_at(mesh, 0.1);
  EXPECT_GT(report.deep_cells, 0u);
  expect_same(mesh, sphere);
  EXPECT_TRUE(remesh_at(disc, 0.1).changed());
  EXPECT_EQ(disc.triangle_count(), 0u);
  EXPECT_EQ(disc.vertex_count(), 0u);
}

TEST(Remeshing, KeepsSmallComponentsThatTheParticlesConfirm) {
  const TriangleMesh body = test::make_sphere({0.01, 0.02, 0.03}, 1.0, 5);
  const TriangleMesh drop = test::make_sphere({1.55, 0.05, 0.05}, 0.02, 2);
  const TriangleMesh bubble = test::turned(test::make_sphere({0.05, 0.05, 0.05}, 0.02, 2));
  RemeshingRequest outside_is_liquid;
  outside_is_liquid.is_liquid = [](const Coord& node) { return node.x() > 10; };
  RemeshingRequest inside_is_liquid;
  inside_is_liquid.is_liquid = [](const Coord& node) { return node.x() <= 10; };

  const TriangleMesh before = test::joined({body, drop, bubble});
  TriangleMesh mesh = before;
  EXPECT_EQ(remesh_at(mesh, 0.1, outside_is_liquid).kept_components, 2u);
  expect_same(mesh, before);
  EXPECT_EQ(remesh_at(mesh, 0.1, inside_is_liquid).removed_components, 2u);
  expect_same(mesh, body);

  // A drop in liquid and a bubble in air are neither.
  TriangleMesh inside_out = test::joined({body, test::turned(drop), test::turned(bubble)});
  EXPECT_EQ(remesh_at(inside_out, 0.1, outside_is_liquid).removed_components, 2u);
  expect_same(inside_out, body);
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
  const RemeshingReport report = remesh_at(mesh, h, request);
  expect_sound(mesh);
  EXPECT_GT(report.changed_nodes, 0u);
  EXPECT_EQ(measures_of(mesh).components, 2u);
  EXPECT_EQ(measures_of(mesh).genus, 0);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0u);
  for (const Vec3f& p : mesh.positions()) EXPECT_GT(std::abs(p.x()), 0.14);
  EXPECT_NEAR(measures_of(mesh).volume, 4.0 / 3.0 * kPi - 0.3 * kPi, 0.02 * 4.0 / 3.0 * kPi);
}

TEST(Remeshing, AttributesOfNewVerticesAreThoseOfTheMeshNearby) {
  TriangleMesh mesh =
      test::joined({test::make_sphere({0.03, -0.02, 0.01}, 1.0, 5), test::make_sphere({1.53, -0.02, 0.01}, 1.0, 5)});
  const std::size_t place = mesh.attributes().add("place", 3, {0.0f, 0.0f, 0.0f});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    for (int axis = 0; axis < 3; ++axis) mesh.attributes()[place].values[3 * v + axis] = mesh.positions()[v][axis];
  }
  const RemeshingReport report = remesh_at(mesh, 0.1);
  ASSERT_GT(report.new_vertices, 0u);
  for (std::size_t v = mesh.vertex_count() - report.new_vertices; v < mesh.vertex_count(); ++v) {
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(mesh.attributes()[place].values[3 * v + axis], mesh.positions()[v][axis], 0.08);
    }
  }
}

TEST(Remeshing, BodiesPassThroughEachOther) {
  TriangleMesh mesh = test::joined(
      {test::make_sphere({-0.7, 0.02, 0.01}, 0.6, 4), test::make_torus({0.6, 0.13, -0.05}, 0.5, 0.2, 40, 16)});
  const std::size_t speed = mesh.attributes().add("speed", 1, {0.0f});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    mesh.attributes()[speed].values[v] = mesh.positions()[v].x() < 0.0f ? 0.02f : -0.02f;
  }
  bool were_one = false;
  for (int step = 0; step < 50; ++step) {
    SCOPED_TRACE(step);
    for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
      mesh.positions()[v].x() += mesh.attributes()[speed].values[v];
    }
    const RemeshingReport report = remesh_at(mesh, 0.1);
    expect_sound(mesh);
    EXPECT_EQ(report.fallbacks, 0u);
    EXPECT_FALSE(report.gave_up);
    const std::size_t bodies = count_bodies(mesh);
    EXPECT_LE(bodies, were_one ? 1u : 2u);
    were_one = bodies == 1;
  }
  EXPECT_TRUE(were_one);
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
    const RemeshingReport report = remesh_at(mesh, 0.1, request);
    fallbacks += report.fallbacks;
    if (report.gave_up) {
      expect_same(mesh, before);
      continue;
    }
    ++mended;
    expect_sound(mesh);
    EXPECT_NEAR(measures_of(mesh).volume, measures_of(sphere).volume, 0.01 * measures_of(sphere).volume);
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
