#include "particle_surface_tracker/stages/upkeep.h"

#include <cstdlib>
#include <new>
#include <random>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "particle_surface_tracker/core/error.h"
#include "support/detailed_body.h"
#include "support/shapes.h"
#include "upkeep_support.h"

namespace {
std::size_t allocations = 0;
}  // namespace

// Not inlined: the compiler would take one without the other for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;

void expect_same_bits(const TriangleMesh& a, const TriangleMesh& b) {
  EXPECT_EQ(a.positions(), b.positions());
  EXPECT_EQ(a.triangles(), b.triangles());
  EXPECT_EQ(a.ids(), b.ids());
  ASSERT_EQ(a.attributes().count(), b.attributes().count());
  for (std::size_t n = 0; n < a.attributes().count(); ++n)
    EXPECT_EQ(a.attributes()[n].values, b.attributes()[n].values);
}

/// A body with needles and folds of its own; made once, for that takes a second.
const TriangleMesh& detailed_mesh() {
  static const TriangleMesh mesh = test::DetailedBody(0.1).mesh();
  return mesh;
}

/// A sphere and a torus with every vertex moved by up to `amount` of its edges' length, at random.
TriangleMesh make_soup(std::uint32_t seed, double amount) {
  TriangleMesh mesh =
      test::joined({test::make_sphere({0, 0, 0}, 0.6, 5), test::make_torus({0.9, 0.1, 0.2}, 0.5, 0.16, 96, 32)});
  note_birth(mesh);
  std::mt19937 random(seed);
  const double edge = 0.033;
  test::move_vertices(mesh, [&](const Vec3d& x) {
    Vec3d shift;
    for (double& s : shift) s = static_cast<double>(random()) / 2147483648.0 - 1.0;
    return Vec3d(x + amount * edge * shift);
  });
  return mesh;
}

TEST(Upkeep, LeavesAMeshAtRestAloneBitForBit) {
  TriangleMesh mesh = detailed_mesh();
  const Parameters parameters = test::parameters_for_cells_of(0.05);
  note_birth(mesh);
  const TriangleMesh before = mesh;
  for (int n = 0; n < 3; ++n) EXPECT_FALSE(keep_up(mesh, parameters).has_changes());
  expect_same_bits(mesh, before);
}

TEST(Upkeep, LeavesNeedlesCapsFoldsAndTinyTrianglesOfBirthAlone) {
  // All limits are far beyond what this mesh has, but it was born so.
  TriangleMesh mesh =
      test::joined({test::make_box({0, 0, 0}, {1, 0.001, 1}), test::make_torus({3, 0, 0}, 1, 0.01, 8, 40),
                    test::make_sphere({0, 3, 0}, 1e-4, 4), test::make_tetrahedron(50.0)});
  test::move_vertices(mesh, [](const Vec3d& x) { return Vec3d(x.x(), 0.02 * x.y(), x.z() + 30.0 * x.x()); });
  ASSERT_LT(test::shape_of(mesh).smallest_angle, 0.01);
  ASSERT_GT(test::shape_of(mesh).largest_fold, 178.0);
  const TriangleMesh before = mesh;
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.5));
  EXPECT_FALSE(report.has_changes());
  EXPECT_EQ(report.refused, 0U);
  EXPECT_EQ(mesh.positions(), before.positions());
  EXPECT_EQ(mesh.triangles(), before.triangles());
}

TEST(Upkeep, AllocatesNothingWhenThereIsNothingToDo) {
  TriangleMesh mesh = detailed_mesh();
  const Parameters parameters = test::parameters_for_cells_of(0.05);
  UpkeepMemory memory;
  keep_up(mesh, parameters, memory);
  const std::size_t before = allocations;
  keep_up(mesh, parameters, memory);
  EXPECT_EQ(allocations, before);
}

TEST(Upkeep, SplitsEveryEdgeOfAGrownTetrahedronOnceAtItsMidpoint) {
  TriangleMesh mesh = test::make_tetrahedron(1.0);
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(2.125));
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.1));
  EXPECT_EQ(report.splits, 6U);
  EXPECT_EQ(mesh.vertex_count(), 10U);
  EXPECT_EQ(mesh.triangle_count(), 16U);
  EXPECT_THAT(report.fresh, ElementsAre(4, 5, 6, 7, 8, 9));
  EXPECT_TRUE(test::defects_of(mesh).none());
  // The middles of the edges of a tetrahedron are the vertices of an octahedron.
  std::set<std::array<float, 3>> middles;
  for (std::size_t v = 4; v < 10; ++v) {
    const Vec3f& p = mesh.positions()[v];
    EXPECT_EQ(p.cwiseAbs().sum(), 2.125F);
    middles.insert({p.x(), p.y(), p.z()});
  }
  EXPECT_EQ(middles.size(), 6U);
  EXPECT_EQ(test::volume_of(mesh), test::volume_of(test::make_tetrahedron(2.125)));
}

TEST(Upkeep, BothLimitsOfASplitMustBePassed) {
  TriangleMesh mesh = test::make_tetrahedron(1.0);
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(1.984375));
  EXPECT_FALSE(keep_up(mesh, test::parameters_for_cells_of(0.1)).has_changes()) << "not twice the length at birth";
  test::scale(mesh, Vec3d::Constant(8.0));
  EXPECT_FALSE(keep_up(mesh, test::parameters_for_cells_of(100.0)).has_changes()) << "not longer than 1.5 h";
}

TEST(Upkeep, LeavesAComponentAloneThatIsTooSmall) {
  TriangleMesh mesh = test::make_tetrahedron(1.0);
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(1e-3));
  const TriangleMesh before = mesh;
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(1.0));
  EXPECT_EQ(report.refused, 6U);
  expect_same_bits(mesh, before);
}

TEST(Upkeep, NeverShrinksAComponentBelowATetrahedron) {
  TriangleMesh mesh = test::joined({test::make_sphere(Vec3d::Zero(), 1.0, 3), test::make_tetrahedron(9.0)});
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(1e-3));
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(1.0));
  EXPECT_GT(report.collapses, 0U);
  EXPECT_GE(mesh.vertex_count(), 8U);
  EXPECT_TRUE(test::defects_of(mesh).none());
}

TEST(Upkeep, WeldsTheEndsOfAnEdgeThatMeet) {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 3);
  const auto [a, b, c] = mesh.triangles()[100];
  mesh.positions()[a] = mesh.positions()[b];
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(1e-3));
  EXPECT_EQ(report.collapses, 1U);
  EXPECT_TRUE(report.fresh.empty()) << "nothing has moved";
  EXPECT_EQ(mesh.vertex_count(), test::make_sphere(Vec3d::Zero(), 1.0, 3).vertex_count() - 1);
  EXPECT_TRUE(test::defects_of(mesh).none());
}

/// A box whose faces are grids of `n` × `n` squares.
TriangleMesh make_fine_box(int n) {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, n);
  // Octahedron: |x| + |y| + |z| = 1, edges and corners included.
  test::move_vertices(mesh, [](const Vec3d& x) { return Vec3d(x / x.cwiseAbs().sum()); });
  return mesh;
}

TEST(Upkeep, KeepsRidgesWhenItCollapsesAndTheKeptVertexUntouched) {
  TriangleMesh mesh = make_fine_box(4);
  note_birth(mesh);
  // A vertex inside a face moves next to its neighbour on a ridge, which must not move.
  const auto on_ridge = [&](std::uint32_t v) { return mesh.positions()[v].cwiseAbs().minCoeff() < 1e-6F; };
  const auto is_corner = [&](std::uint32_t v) { return mesh.positions()[v].cwiseAbs().maxCoeff() > 0.999F; };
  std::uint32_t ridge = 0, inner = 0;
  for (const Triangle& t : mesh.triangles()) {
    for (int k = 0; k < 3; ++k) {
      if (on_ridge(t[k]) && !is_corner(t[k]) && !on_ridge(t[(k + 1) % 3])) {
        ridge = t[k];
        inner = t[(k + 1) % 3];
      }
    }
  }
  ASSERT_NE(ridge, inner);
  const Vec3f kept = mesh.positions()[ridge];
  mesh.positions()[inner] = kept + 0.01F * (mesh.positions()[inner] - kept);
  mesh.delta()[ridge] = 0.125F;
  mesh.delta()[inner] = 7.0F;
  const std::uint32_t id = mesh.ids()[ridge];
  const std::size_t count = mesh.vertex_count();
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(1.0));
  EXPECT_EQ(report.collapses, 1U);
  EXPECT_TRUE(report.fresh.empty());
  ASSERT_EQ(mesh.vertex_count(), count - 1);
  const auto found = std::find(mesh.ids().begin(), mesh.ids().end(), id);
  ASSERT_NE(found, mesh.ids().end());
  EXPECT_EQ(mesh.positions()[static_cast<std::size_t>(found - mesh.ids().begin())], kept);
  EXPECT_EQ(mesh.delta()[static_cast<std::size_t>(found - mesh.ids().begin())], 0.125F);
  EXPECT_NEAR(test::volume_of(mesh), 4.0 / 3.0, 1e-6);
}

/// Distances of new vertices to the surface that they belong to.
struct Offsets {
  double mean = 0.0, largest = 0.0;

  template <typename Distance>
  Offsets(const TriangleMesh& mesh, const UpkeepReport& report, Distance&& distance) {
    for (const std::uint32_t v : report.fresh) {
      const double offset = std::abs(distance(Vec3d(mesh.positions()[v].cast<double>())));
      mean += offset / static_cast<double>(report.fresh.size());
      largest = std::max(largest, offset);
    }
  }
};

TEST(Upkeep, CollapsesAFanOfThousandsOfTriangles) {
  // Two cones with their bases joined; the rim shrinks, so that its edges become short. A cell of Γ that is filled from
  // one point can have such a fan.
  constexpr std::uint32_t kRim = 2000;
  std::vector<Vec3f> positions = {{0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> triangles;
  for (std::uint32_t n = 0; n < kRim; ++n) {
    const double angle = 2.0 * std::acos(-1.0) * n / kRim;
    positions.emplace_back(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)), 0.0F);
    const std::uint32_t here = 2 + n, next = 2 + (n + 1) % kRim;
    triangles.push_back({0, here, next});
    triangles.push_back({1, next, here});
  }
  TriangleMesh mesh(std::move(positions), std::move(triangles));
  note_birth(mesh);
  test::scale(mesh, Vec3d(0.25, 0.25, 1.0));
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.1));
  EXPECT_GT(report.collapses + report.sliver_collapses, kRim / 2);
  EXPECT_TRUE(test::defects_of(mesh).none());
}

TEST(Upkeep, PutsNewVerticesOnTheSmoothSurfaceOfARegularMesh) {
  TriangleMesh mesh = test::make_torus(Vec3d::Zero(), 1.0, 0.4, 100, 40);
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(2.0625));
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.05));
  EXPECT_EQ(report.splits, 4000U) << "the longest edge of every vertex: the diagonals, each once";
  const Offsets offsets(
      mesh, report, [](const Vec3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 2.0625, x.z()) - 0.4 * 2.0625; });
  // The middles of the diagonals lie up to 3.0e-3 below the surface.
  EXPECT_LT(offsets.largest, 3e-5);
}

TEST(Upkeep, PutsNewVerticesNearTheSmoothSurfaceOfAnIrregularMesh) {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 4);
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(2.5));
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.1));
  ASSERT_GT(report.splits, 1000U);
  const Offsets offsets(mesh, report, [](const Vec3d& x) { return x.norm() - 2.5; });
  // The middles of the edges lie up to 4.6e-3 below the sphere, 3.6e-3 on average. The butterfly is not exact here: the
  // triangles change their shape abruptly where the octahedron had its edges, and what is split again has a vertex of
  // valence 4 with unequal edges.
  EXPECT_LT(offsets.mean, 7e-4);
  EXPECT_LT(offsets.largest, 3.5e-3);
}

TEST(Upkeep, AttributesFollowAndUntouchedVerticesKeepEverything) {
  TriangleMesh mesh = detailed_mesh();
  const std::size_t texcoord = mesh.attributes().add(TriangleMesh::texcoord_name, 2, {0.0F, 0.0F});
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    mesh.delta()[v] = static_cast<float>(v);
    mesh.attributes()[texcoord].values[2 * v] = mesh.positions()[v].x();
    mesh.attributes()[texcoord].values[2 * v + 1] = mesh.positions()[v].y();
  }
  note_birth(mesh);
  const TriangleMesh before = mesh;
  const Vec3d center = test::DetailedBody(0.1).center();
  // Only one side is drawn out, to four times its length at the far end.
  test::move_vertices(mesh, [&](const Vec3d& x) {
    const double out = x.x() - center.x();
    return Vec3d(x + (out > 0.0 ? out * out : 0.0) * Vec3d::UnitX());
  });
  const TriangleMesh moved = mesh;
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.05));
  ASSERT_GT(report.splits, 100U);
  EXPECT_TRUE(test::defects_of(mesh).none());

  std::vector<std::uint32_t> fresh;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const std::uint32_t id = mesh.ids()[v];
    EXPECT_TRUE(v == 0 || id > mesh.ids()[v - 1]) << "the order is kept, and new vertices come last";
    if (id >= before.vertex_count() || mesh.positions()[v] != moved.positions()[id]) {
      fresh.push_back(v);
      // Coordinates at rest, carried as texture coordinates, stay those of the place that the vertex is at.
      EXPECT_NEAR(mesh.attributes()[texcoord].values[2 * v + 1], mesh.positions()[v].y(), 0.03);
    } else {
      EXPECT_EQ(mesh.delta()[v], before.delta()[id]);
      EXPECT_EQ(mesh.attributes()[texcoord].values[2 * v], before.attributes()[texcoord].values[2 * id]);
    }
  }
  EXPECT_EQ(report.fresh, fresh);
}

TEST(Upkeep, MendsRandomSoupsAndThenLeavesThemAlone) {
  const Parameters parameters = test::parameters_for_cells_of(0.05);
  UpkeepMemory shared;
  for (const std::uint32_t seed : {1U, 2U}) {
    for (const double amount : {0.3, 1.0}) {
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", moved by up to " << amount << " edges");
      TriangleMesh mesh = make_soup(seed, amount);
      TriangleMesh same = mesh;
      const UpkeepReport report = keep_up(mesh, parameters, shared);
      EXPECT_TRUE(report.has_changes());
      EXPECT_TRUE(test::defects_of(mesh).none());
      for (const Triangle& t : mesh.triangles()) {
        for (std::size_t k = 0; k < 3; ++k) ASSERT_NE(mesh.positions()[t[k]], mesh.positions()[t[(k + 1) % 3]]);
      }
      keep_up(same, parameters);
      expect_same_bits(mesh, same);

      const TriangleMesh before = mesh;
      EXPECT_FALSE(keep_up(mesh, parameters).has_changes());
      expect_same_bits(mesh, before);
    }
  }
}

TEST(Upkeep, GivesTheSameBytesForAnyNumberOfThreads) {
  const Parameters parameters = test::parameters_for_cells_of(0.05);
  std::vector<TriangleMesh> meshes;
  for (const std::size_t threads : {1U, 2U, 5U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    meshes.push_back(make_soup(7, 1.0));
    keep_up(meshes.back(), parameters);
  }
  expect_same_bits(meshes[1], meshes[0]);
  expect_same_bits(meshes[2], meshes[0]);
}

TEST(Upkeep, RefusesMeshesThatAreNotClosedManifolds) {
  const Parameters parameters = test::parameters_for_cells_of(1.0);
  TriangleMesh open = test::make_tetrahedron(1.0);
  open.set_triangles({{0, 1, 2}, {0, 3, 1}, {0, 2, 3}});
  EXPECT_THROW(keep_up(open, parameters), MeshError);
  // Two tetrahedra that touch in a vertex.
  TriangleMesh pinched = test::joined({test::make_tetrahedron(1.0), test::make_tetrahedron(2.0)});
  std::vector<Triangle> triangles = pinched.triangles();
  for (Triangle& t : triangles) std::replace(t.begin(), t.end(), 4U, 0U);
  pinched.set_triangles(triangles);
  EXPECT_THROW(note_birth(pinched), MeshError);
}

}  // namespace
}  // namespace particle_surface_tracker
