// Crumbs of mesh without liquid.

#include "particle_surface_tracker/stages/empty_components.h"

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/mesh_validation.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

constexpr double kSpacing = 0.1;

const TriangleMesh kBody = test::make_sphere(Vec3d::Zero(), 0.5, 3);
const TriangleMesh kCrumb = test::make_sphere(Vec3d(0.8, 0, 0), 0.03, 0);
const auto kFirstNewId = static_cast<std::uint32_t>(kBody.vertex_count());

TEST(EmptyComponents, AreRemoved) {
  TriangleMesh mesh = test::joined({kBody, kCrumb});
  EXPECT_EQ(remove_empty_components(mesh, kFirstNewId, kFirstNewId, {Vec3f(0, 0, 0), Vec3f(0.735F, 0, 0)}, kSpacing),
            1U);
  EXPECT_EQ(mesh.vertex_count(), kBody.vertex_count());
  EXPECT_EQ(mesh.triangles(), kBody.triangles());
  EXPECT_EQ(describe_mesh_defects(mesh.positions(), mesh.triangles()), "");
}

TEST(EmptyComponents, StayWhereAParticleIsNear) {
  TriangleMesh mesh = test::joined({kBody, kCrumb});
  EXPECT_EQ(remove_empty_components(mesh, kFirstNewId, kFirstNewId, {Vec3f(0.745F, 0, 0)}, kSpacing), 0U);
  EXPECT_EQ(mesh.triangle_count(), kBody.triangle_count() + kCrumb.triangle_count());
}

TEST(EmptyComponents, StayIfTheyAreOfTheFirstMesh) {
  TriangleMesh mesh = test::joined({kBody, kCrumb});
  EXPECT_EQ(remove_empty_components(mesh, kFirstNewId + 1, mesh.next_id(), {Vec3f(0, 0, 0)}, kSpacing), 0U);
}

TEST(EmptyComponents, AreRemovedIfTheyHaveJustBeenCutOffTheFirstMesh) {
  TriangleMesh mesh = test::joined({kBody, kCrumb});
  const std::uint32_t of_the_cut = kFirstNewId + 3;
  EXPECT_EQ(remove_empty_components(mesh, of_the_cut, of_the_cut, {Vec3f(0, 0, 0)}, kSpacing), 1U);
  EXPECT_EQ(mesh.triangles(), kBody.triangles());
}

TEST(EmptyComponents, CavitiesStay) {
  TriangleMesh mesh = test::joined({kBody, test::turned(test::make_sphere(Vec3d::Zero(), 0.03, 0))});
  EXPECT_EQ(remove_empty_components(mesh, kFirstNewId, kFirstNewId, {Vec3f(0.45F, 0, 0)}, kSpacing), 0U);
}

TEST(EmptyComponents, WhatHoldsACavityStays) {
  const TriangleMesh shell = test::make_sphere(Vec3d(0.8, 0, 0), 0.03, 1);
  const TriangleMesh cavity = test::turned(test::make_sphere(Vec3d(0.8, 0, 0), 0.01, 1));
  TriangleMesh mesh = test::joined({kBody, shell, cavity});
  EXPECT_EQ(remove_empty_components(mesh, kFirstNewId, kFirstNewId, {Vec3f(0, 0, 0)}, kSpacing), 0U);
}

TEST(EmptyComponents, LargeOnesStay) {
  TriangleMesh mesh = test::joined({kBody, test::make_sphere(Vec3d(0.8, 0, 0), 0.1, 4)});
  EXPECT_EQ(remove_empty_components(mesh, kFirstNewId, kFirstNewId, {Vec3f(0, 0, 0)}, kSpacing), 0U);
}

TEST(EmptyComponents, ParticlesFarFromTheWorldAreNoTrouble) {
  TriangleMesh mesh = test::joined({kBody, kCrumb});
  EXPECT_EQ(remove_empty_components(mesh, kFirstNewId, kFirstNewId, {Vec3f(1e30F, 0, 0)}, kSpacing), 1U);
}

TEST(EmptyComponents, SpecksAreRemovedAlsoInsideOutAndBesideAParticle) {
  const TriangleMesh speck = test::make_sphere(Vec3d(0.8, 0, 0), 0.005, 0);
  for (const TriangleMesh& one : {speck, test::turned(speck)}) {
    TriangleMesh mesh = test::joined({kBody, one});
    EXPECT_EQ(remove_empty_components(mesh, kFirstNewId, kFirstNewId, {Vec3f(0.75F, 0, 0)}, kSpacing), 1U);
    EXPECT_EQ(mesh.triangles(), kBody.triangles());
  }
}

}  // namespace
}  // namespace particle_surface_tracker
