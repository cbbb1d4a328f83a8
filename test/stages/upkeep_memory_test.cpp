// What upkeep keeps of a vertex's birth, and how δ decays.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/stages/upkeep.h"
#include "upkeep_support.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;

TEST(Birth, IsNotedOnceAndAnewForWhatIsRemeshed) {
  TriangleMesh mesh = test::make_tetrahedron(1.0);
  note_birth(mesh);
  test::scale(mesh, Vec3d::Constant(2.125));
  note_birth(mesh);
  TriangleMesh remeshed = mesh;
  mark_as_remeshed(remeshed, {0, 1, 2, 3});
  const Parameters parameters = test::parameters_for_cells_of(0.1);
  EXPECT_EQ(keep_up(mesh, parameters).splits, 6U);
  EXPECT_FALSE(keep_up(remeshed, parameters).has_changes());
}

TEST(Birth, OfANewVertexWithoutABlendIsWhenItIsFirstSeen) {
  TriangleMesh mesh = test::make_tetrahedron(1.0);
  note_birth(mesh);
  // A re-mesher puts a vertex into the middle of a triangle.
  const std::uint32_t v = mesh.append_vertex({0.3F, 0.3F, -0.3F}, {});
  mesh.set_triangles({{0, 1, v}, {1, 2, v}, {2, 0, v}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}});
  const Parameters parameters = test::parameters_for_cells_of(0.01);
  EXPECT_FALSE(keep_up(mesh, parameters).has_changes());
  const VertexAttribute& birth = mesh.attributes()[mesh.attributes().find("birth")];
  EXPECT_FLOAT_EQ(birth.values[birth.components * v], (mesh.positions()[0] - mesh.positions()[v]).norm());
}

TEST(DeltaDecay, HalvesInItsHalfLifeAndIsOffWithoutOne) {
  TriangleMesh mesh = test::make_tetrahedron(1.0);
  mesh.delta() = {1.0F, -2.0F, 0.0F, 0.5F};
  Parameters parameters = test::parameters_for_cells_of(1.0);
  decay_delta(mesh, 10.0, parameters);
  EXPECT_THAT(mesh.delta(), ElementsAre(1.0F, -2.0F, 0.0F, 0.5F));
  parameters.delta_half_life = 0.25;
  decay_delta(mesh, 0.25, parameters);
  EXPECT_THAT(mesh.delta(), ElementsAre(0.5F, -1.0F, 0.0F, 0.25F));
  for (int n = 0; n < 10; ++n) decay_delta(mesh, 0.05, parameters);
  EXPECT_NEAR(mesh.delta()[1], -0.25, 1e-6);
  decay_delta(mesh, -1.0, parameters);
  decay_delta(mesh, 0.0, parameters);
  EXPECT_NEAR(mesh.delta()[1], -0.25, 1e-6);
}

}  // namespace
}  // namespace particle_surface_tracker
