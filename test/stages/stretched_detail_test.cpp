// δ where the surface grows and shrinks again.

#include "particle_surface_tracker/stages/stretched_detail.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

TriangleMesh sphere_with_detail() {
  TriangleMesh mesh = test::make_sphere(Vec3d::Zero(), 1.0, 2);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    mesh.delta()[v] = (v % 2 == 0 ? 0.25F : -0.5F) + 0.001F * static_cast<float>(v);
  }
  return mesh;
}

/// Scales the mesh about the origin and thins its detail.
void grow(TriangleMesh& mesh, float factor) {
  const std::vector<Vec3f> before = mesh.positions();
  for (Vec3f& x : mesh.positions()) x *= factor;
  thin_stretched_detail(mesh, before);
}

TEST(StretchedDetail, ThinsByTheGrowthOfTheAreaBeyondATolerance) {
  TriangleMesh mesh = sphere_with_detail();
  const std::vector<float> born = mesh.delta();
  for (int frame = 0; frame < 10; ++frame) grow(mesh, std::pow(2.0F, 0.1F));
  for (std::size_t v = 0; v < born.size(); ++v) EXPECT_NEAR(mesh.delta()[v], born[v] * 2.0 / 4.0, 1e-5);
}

TEST(StretchedDetail, KeepsEveryBitWhileTheAreaGrowsLittleOrShrinks) {
  TriangleMesh mesh = sphere_with_detail();
  const std::vector<float> born = mesh.delta();
  for (const float factor : {1.0F, 1.1F, 1.0F / 1.1F, 0.8F, 0.7F, 1.0F / 0.56F, 1.25F}) {
    grow(mesh, factor);
    EXPECT_EQ(mesh.delta(), born) << factor;
  }
}

TEST(StretchedDetail, ComesBackWhenTheSurfaceShrinksAgain) {
  TriangleMesh mesh = sphere_with_detail();
  const std::vector<float> born = mesh.delta();
  for (const float factor : {1.35F, 1.35F, 1.0F / 1.35F, 1.0F / 1.35F}) grow(mesh, factor);
  for (std::size_t v = 0; v < born.size(); ++v) EXPECT_NEAR(mesh.delta()[v], born[v], 1e-6);
}

TEST(StretchedDetail, SurvivesTrianglesWithoutArea) {
  TriangleMesh mesh = sphere_with_detail();
  const std::vector<float> born = mesh.delta();
  const std::vector<Vec3f> before = mesh.positions();
  std::fill(mesh.positions().begin(), mesh.positions().end(), Vec3f::Zero());
  thin_stretched_detail(mesh, before);
  EXPECT_EQ(mesh.delta(), born);
}

TEST(StretchedDetail, WhatItRemembersIsNotForFiles) {
  TriangleMesh mesh = sphere_with_detail();
  grow(mesh, 1.2F);
  const std::size_t index = mesh.attributes().find("stretch");
  ASSERT_NE(index, VertexAttributes::none);
  EXPECT_EQ(mesh.attributes()[index].use, AttributeUse::kInternal);
}

}  // namespace
}  // namespace particle_surface_tracker
