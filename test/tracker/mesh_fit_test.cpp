#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using ::testing::HasSubstr;

constexpr double r = 0.1;

ParticleFrame ball_of_particles(const Vec3d& center = Vec3d::Zero()) {
  return test::fill_with_particles(Vec3d::Constant(-2.0), Vec3d::Constant(2.0), r, 0.2, 9,
                                   [&](const Vec3d& x) { return (x - center).norm() < 1.0 - 0.3 * r; });
}

std::string mismatch(const TriangleMesh& mesh, const ParticleFrame& frame, double spacing = r) {
  try {
    check_mesh_fits_particles(mesh, frame, spacing);
  } catch (const TrackingError& error) {
    return error.what();
  }
  return "fits";
}

TriangleMesh scaled(const TriangleMesh& mesh, const Vec3f& factors) {
  std::vector<Vec3f> positions = mesh.positions();
  for (Vec3f& p : positions) p = p.cwiseProduct(factors);
  return TriangleMesh(std::move(positions), mesh.triangles());
}

TEST(MeshFit, TheMeshThatBoundsTheParticlesFits) {
  EXPECT_EQ(mismatch(test::make_sphere(Vec3d::Zero(), 1.0, 4), ball_of_particles()), "fits");
}

TEST(MeshFit, ACavityIsOutside) {
  const auto inner = test::turned(test::make_sphere(Vec3d::Zero(), 0.6, 4));
  const TriangleMesh shell = test::joined({test::make_sphere(Vec3d::Zero(), 1.0, 4), inner});
  const ParticleFrame hollow =
      test::fill_with_particles(Vec3d::Constant(-1.0), Vec3d::Constant(1.0), r, 0.2, 9,
                                [](const Vec3d& x) { return x.norm() < 1.0 - 0.3 * r && x.norm() > 0.6 + 0.3 * r; });
  EXPECT_EQ(mismatch(shell, hollow), "fits");
  EXPECT_THAT(mismatch(shell, ball_of_particles()), HasSubstr("% of the particles lie outside"));
}

TEST(MeshFit, WrongScalesAreFoundAtOnceAndWithTheFigures) {
  const TriangleMesh sphere = test::make_sphere(Vec3d::Zero(), 1.0, 4);
  EXPECT_THAT(mismatch(scaled(sphere, Vec3f::Constant(1000.0f)), ball_of_particles()), HasSubstr("median distance"));
  EXPECT_THAT(mismatch(scaled(sphere, Vec3f::Constant(0.001f)), ball_of_particles()), HasSubstr("% of the particles"));
  EXPECT_THAT(mismatch(scaled(sphere, Vec3f::Constant(0.8f)), ball_of_particles()), HasSubstr("% of the particles"));
}

TEST(MeshFit, AWrongOffsetIsFound) {
  EXPECT_THAT(mismatch(test::make_sphere(Vec3d(50, 0, 0), 1.0, 4), ball_of_particles()), HasSubstr("median distance"));
  EXPECT_THAT(mismatch(test::make_sphere(Vec3d(0.4, 0, 0), 1.0, 4), ball_of_particles()), HasSubstr("lie outside"));
}

TEST(MeshFit, AWrongAxisIsFound) {
  const TriangleMesh tall = scaled(test::make_sphere(Vec3d::Zero(), 1.0, 4), {0.4f, 1.0f, 0.4f});
  const ParticleFrame lying =
      test::fill_with_particles(Vec3d::Constant(-1.0), Vec3d::Constant(1.0), r, 0.2, 9,
                                [](const Vec3d& x) { return x.cwiseQuotient(Vec3d(0.4, 0.4, 1.0)).norm() < 0.95; });
  EXPECT_THAT(mismatch(tall, lying), HasSubstr("lie outside"));
}

TEST(MeshFit, AnAbsurdSpacingIsFound) {
  const TriangleMesh sphere = test::make_sphere(Vec3d::Zero(), 1.0, 4);
  EXPECT_THAT(mismatch(sphere, ball_of_particles(), 1e-9), HasSubstr("the particle spacing is given as 1e-09 m"));
  EXPECT_THAT(mismatch(sphere, ball_of_particles(), 1e3), HasSubstr("the particle spacing is given as 1000 m"));
}

TEST(MeshFit, ASingleParticleFitsTheDropAroundIt) {
  const ParticleFrame one = make_particle_frame(0, {{0, 0, 0}}, {5});
  EXPECT_EQ(mismatch(test::make_sphere(Vec3d::Zero(), 0.5 * r, 2), one), "fits");
}

}  // namespace
}  // namespace particle_surface_tracker
