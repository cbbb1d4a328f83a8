#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "particle_surface_tracker/stages/upkeep.h"
#include "support/detailed_body.h"
#include "support/shapes.h"
#include "upkeep_support.h"

namespace particle_surface_tracker {
namespace {

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

TEST(UpkeepNewVertices, PutsNewVerticesOnTheSmoothSurfaceOfARegularMesh) {
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

TEST(UpkeepNewVertices, PutsNewVerticesNearTheSmoothSurfaceOfAnIrregularMesh) {
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

TEST(UpkeepNewVertices, AttributesFollowAndUntouchedVerticesKeepEverything) {
  TriangleMesh mesh = test::detailed_mesh();
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

/// A sphere with edges of 0.2 to 0.4 h, half of it made by re-meshing.
class HalfRemeshed : public ::testing::Test {
 protected:
  static constexpr double kCell = 0.1;

  HalfRemeshed() {
    note_birth(mesh_);
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      if (is_in_remeshed_half(v)) remeshed_.push_back(v);
    }
    mark_as_remeshed(mesh_, remeshed_);
  }

  bool is_in_remeshed_half(std::uint32_t v) const { return mesh_.positions()[v].x() > 0.0F; }

  TriangleMesh mesh_ = test::make_sphere(Vec3d::Zero(), 0.6, 5);
  std::vector<std::uint32_t> remeshed_;
};

TEST_F(HalfRemeshed, BecomesCoarserWhereItHasNoDetail) {
  const TriangleMesh before = mesh_;
  const Parameters parameters = test::parameters_for_cells_of(kCell);
  const UpkeepReport report = keep_up(mesh_, parameters);
  EXPECT_GT(report.collapses, remeshed_.size() / 2);
  EXPECT_EQ(report.splits, 0U);
  std::size_t kept = 0;
  for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) kept += is_in_remeshed_half(v) ? 0 : 1;
  EXPECT_EQ(kept, before.vertex_count() - remeshed_.size()) << "all of the other half";
  for (const Triangle& t : mesh_.triangles()) {
    if (!std::all_of(t.begin(), t.end(), [this](std::uint32_t v) { return is_in_remeshed_half(v); })) continue;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_GE((mesh_.positions()[t[k]] - mesh_.positions()[t[(k + 1) % 3]]).norm(), 0.5F * kCell);
    }
  }
  EXPECT_NEAR(test::enclosed_volume(mesh_.positions(), mesh_.triangles()),
              test::enclosed_volume(before.positions(), before.triangles()), 2e-3);
  EXPECT_FALSE(keep_up(mesh_, parameters).has_changes()) << "once is enough";
}

TEST_F(HalfRemeshed, LosesLittleMoreVolumeWhereTilesMeet) {
  const Parameters parameters = test::parameters_for_cells_of(kCell);
  const auto loss = [&](const Vec3f& moved) {
    TriangleMesh mesh = mesh_;
    for (Vec3f& position : mesh.positions()) position += moved;
    const double before = test::enclosed_volume(mesh.positions(), mesh.triangles());
    keep_up(mesh, parameters);
    return before - test::enclosed_volume(mesh.positions(), mesh.triangles());
  };
  // Edges are collapsed in tiles of 16 cells, one of which lies around the origin: once that one only, once eight.
  const double in_one = loss(Vec3f::Zero()), in_eight = loss(Vec3f::Constant(8.0F * kCell));
  EXPECT_GT(in_one, 0.0);
  EXPECT_NE(in_eight, in_one);
  EXPECT_LT(in_eight, 1.1 * in_one);
}

TEST_F(HalfRemeshed, StaysAsItIsWithoutALengthForIt) {
  const TriangleMesh before = mesh_;
  Parameters parameters = test::parameters_for_cells_of(kCell);
  parameters.remeshed_length = 0.0;
  EXPECT_FALSE(keep_up(mesh_, parameters).has_changes());
  EXPECT_EQ(mesh_.positions(), before.positions());
}

}  // namespace
}  // namespace particle_surface_tracker
