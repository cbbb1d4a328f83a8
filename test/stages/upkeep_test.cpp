#include "particle_surface_tracker/stages/upkeep.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "support/shapes.h"
#include "upkeep_support.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;

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
  test::expect_same_bits(mesh, before);
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
