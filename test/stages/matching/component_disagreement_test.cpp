// Pieces of mesh that the liquid does not have.

#include "particle_surface_tracker/stages/component_disagreement.h"

#include <algorithm>
#include <cstdlib>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/particle_grid.h"
#include "particle_surface_tracker/stages/implicit_function.h"
#include "particle_surface_tracker/stages/surface_triangulation.h"
#include "particle_surface_tracker/stages/upkeep.h"
#include "support/parameters.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

constexpr double kSpacing = 0.1;
constexpr double kH = 0.05;

/// φ = 0 of balls of radius 0.5 at some places on the x axis, and of single particles.
ImplicitSurface surface_of_balls(const std::vector<double>& places, const std::vector<Vec3f>& single = {}) {
  ParticleFrame particles =
      test::fill_with_particles(Vec3d(-2, -0.6, -0.6), Vec3d(2, 0.6, 0.6), kSpacing, 0.0, 1, [&](const Vec3d& x) {
        return std::any_of(places.begin(), places.end(),
                           [&](double place) { return (x - Vec3d(place, 0, 0)).norm() < 0.5; });
      });
  particles.positions.insert(particles.positions.end(), single.begin(), single.end());
  const ParticleGrid grid(particles.positions, implicit_function_cell_size(test::parameters_with_spacing(kSpacing)));
  ImplicitSurface surface = evaluate_implicit_function(grid, test::parameters_with_spacing(kSpacing));
  surface.triangulation = triangulate_zero_level(*surface.field, surface.dx);
  return surface;
}

/// An ellipsoid through balls at ±0.65, whose edges have grown since it was born.
TriangleMesh stretched_ellipsoid() {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 0.2, 3);
  note_birth(mesh);
  for (Vec3f& x : mesh.positions()) x = Vec3f(6.0F * x.x(), 1.25F * x.y(), 1.25F * x.z());
  return mesh;
}

/// A large body and a small one beside it.
TriangleMesh body_with_scrap(const Vec3d& place, std::uint32_t& first_new_id) {
  const TriangleMesh body = test::make_sphere(Vec3d::Zero(), 0.55, 4);
  const TriangleMesh scrap = test::make_sphere(place, 0.08, 1);
  std::vector<Vec3f> positions = body.positions();
  std::vector<Triangle> triangles = body.triangles();
  first_new_id = static_cast<std::uint32_t>(positions.size());
  positions.insert(positions.end(), scrap.positions().begin(), scrap.positions().end());
  for (Triangle t : scrap.triangles()) {
    for (std::uint32_t& v : t) v += first_new_id;
    triangles.push_back(t);
  }
  return TriangleMesh(std::move(positions), std::move(triangles));
}

TEST(ComponentDisagreement, FlagsAMeshThatHoldsTwoBodiesTogether) {
  const TriangleMesh mesh = stretched_ellipsoid();
  const auto count = static_cast<std::uint32_t>(mesh.vertex_count());
  const ImplicitSurface surface = surface_of_balls({-0.65, 0.65});
  const std::vector<openvdb::Coord> cells =
      find_component_disagreement(mesh, count, IsosurfaceQuery(surface, kH), test::parameters_with_spacing(kSpacing))
          .bridge_cells;
  ASSERT_FALSE(cells.empty());
  EXPECT_TRUE(std::is_sorted(cells.begin(), cells.end()));
  // The bodies are 0.3 apart; cells are 0.05 wide.
  for (const openvdb::Coord& cell : cells) EXPECT_LT(std::abs(cell.x() * 0.05), 0.5) << cell;
}

TEST(ComponentDisagreement, LeavesWhatItWasBornWithAlone) {
  const ImplicitSurface surface = surface_of_balls({-0.65, 0.65});
  TriangleMesh mesh = stretched_ellipsoid();
  const auto count = static_cast<std::uint32_t>(mesh.vertex_count());
  note_bridges(mesh, IsosurfaceQuery(surface, kH));
  EXPECT_TRUE(
      find_component_disagreement(mesh, count, IsosurfaceQuery(surface, kH), test::parameters_with_spacing(kSpacing))
          .none());

  std::uint32_t first_new_id = 0;
  const TriangleMesh with_scrap = body_with_scrap(Vec3d(0.9, 0, 0), first_new_id);
  const auto all = static_cast<std::uint32_t>(with_scrap.vertex_count());
  const ImplicitSurface one = surface_of_balls({0.0});
  EXPECT_TRUE(
      find_component_disagreement(with_scrap, all, IsosurfaceQuery(one, kH), test::parameters_with_spacing(kSpacing))
          .none());
}

TEST(ComponentDisagreement, WhatWasMadeAnewIsNoBridgeOfBirth) {
  const ImplicitSurface surface = surface_of_balls({-0.65, 0.65});
  TriangleMesh mesh = stretched_ellipsoid();
  note_bridges(mesh, IsosurfaceQuery(surface, kH));
  // New vertices take the attributes of the surface that was there, also that they were in a bridge.
  constexpr std::uint32_t no_vertex_is_old = 0;
  EXPECT_FALSE(find_component_disagreement(mesh, no_vertex_is_old, IsosurfaceQuery(surface, kH),
                                           test::parameters_with_spacing(kSpacing))
                   .bridge_cells.empty());
}

TEST(ComponentDisagreement, WhatWasMadeAnewNeedNotGrowToBeABridge) {
  const ImplicitSurface surface = surface_of_balls({-0.65, 0.65});
  const TriangleMesh stretched = stretched_ellipsoid();
  TriangleMesh mesh(stretched.positions(), stretched.triangles());
  note_birth(mesh);
  const auto count = static_cast<std::uint32_t>(mesh.vertex_count());
  const auto bridge_cells = [&](std::uint32_t first_new_id) {
    return find_component_disagreement(mesh, first_new_id, IsosurfaceQuery(surface, kH),
                                       test::parameters_with_spacing(kSpacing))
        .bridge_cells;
  };
  EXPECT_TRUE(bridge_cells(count).empty());
  EXPECT_FALSE(bridge_cells(0).empty());
  // Where other surface is at one of the bodies, it does not hold the two together.
  const TriangleMesh body = test::make_sphere(Vec3d(0.65, 0, 0), 0.5, 4);
  ASSERT_GT(body.vertex_count(), mesh.vertex_count());
  mesh = test::joined({mesh, body});
  note_birth(mesh);
  EXPECT_TRUE(bridge_cells(0).empty());
}

TEST(ComponentDisagreement, HoldsBodiesTogetherAlsoWhereAnotherPieceHasALittleMoreOfOne) {
  const ImplicitSurface surface = surface_of_balls({-0.65, 0.65});
  const TriangleMesh stretched = stretched_ellipsoid();
  const auto bridge_cells = [&](int rings) {
    const TriangleMesh piece = test::make_torus(Vec3d(0.65, 0, 0), 0.4, 0.1, rings, 12);
    TriangleMesh mesh = test::joined({stretched, piece});
    note_birth(mesh);
    constexpr std::uint32_t no_vertex_is_old = 0;
    return find_component_disagreement(mesh, no_vertex_is_old, IsosurfaceQuery(surface, kH),
                                       test::parameters_with_spacing(kSpacing))
        .bridge_cells;
  };
  // The mesh through both has 60 to 120 vertices there.
  EXPECT_FALSE(bridge_cells(10).empty());
  EXPECT_TRUE(bridge_cells(40).empty());
}

TEST(ComponentDisagreement, BodiesMustNotHangTogetherByASpeck) {
  const TriangleMesh stretched = stretched_ellipsoid();
  TriangleMesh mesh(stretched.positions(), stretched.triangles());
  note_birth(mesh);
  const auto bridge_cells = [&](const std::vector<double>& balls) {
    constexpr std::uint32_t no_vertex_is_old = 0;
    const ImplicitSurface surface = surface_of_balls(balls, {Vec3f(0.0F, 0.2F, 0.0F), Vec3f(0.0F, -0.2F, 0.0F)});
    return find_component_disagreement(mesh, no_vertex_is_old, IsosurfaceQuery(surface, kH),
                                       test::parameters_with_spacing(kSpacing))
        .bridge_cells;
  };
  EXPECT_FALSE(bridge_cells({-0.75, 0.75}).empty());
  EXPECT_TRUE(bridge_cells({-0.75}).empty());
}

TEST(ComponentDisagreement, FlagsScrapsWithoutLiquidOfTheirOwn) {
  std::uint32_t first_new_id = 0;
  const TriangleMesh mesh = body_with_scrap(Vec3d(0.9, 0, 0), first_new_id);
  const ImplicitSurface one = surface_of_balls({0.0});
  const std::vector<openvdb::Coord> cells =
      find_component_disagreement(mesh, first_new_id, IsosurfaceQuery(one, kH), test::parameters_with_spacing(kSpacing))
          .scrap_cells;
  ASSERT_FALSE(cells.empty());
  for (const openvdb::Coord& cell : cells) EXPECT_GT(cell.x() * 0.05, 0.7) << cell;
  // With liquid of its own it is no scrap.
  const ImplicitSurface two = surface_of_balls({0.0, 1.3});
  EXPECT_TRUE(
      find_component_disagreement(mesh, first_new_id, IsosurfaceQuery(two, kH), test::parameters_with_spacing(kSpacing))
          .none());
}

TEST(ComponentDisagreement, CanBeTurnedOff) {
  Parameters only_tau = test::parameters_with_spacing(kSpacing);
  only_tau.detection = DetectionMethod::kTau;
  const TriangleMesh mesh = stretched_ellipsoid();
  const auto count = static_cast<std::uint32_t>(mesh.vertex_count());
  const ImplicitSurface surface = surface_of_balls({-0.65, 0.65});
  EXPECT_TRUE(find_component_disagreement(mesh, count, IsosurfaceQuery(surface, kH), only_tau).none());
}

}  // namespace
}  // namespace particle_surface_tracker
