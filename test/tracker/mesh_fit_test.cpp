#include <algorithm>
#include <map>
#include <utility>

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

/// Every triangle as four, with vertices at the middles of its edges.
TriangleMesh halved(const TriangleMesh& mesh) {
  std::vector<Vec3f> positions = mesh.positions();
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [place, is_new] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(positions.size()));
    if (is_new) positions.push_back(0.5F * (positions[a] + positions[b]));
    return place->second;
  };
  std::vector<Triangle> triangles;
  for (const auto& [a, b, c] : mesh.triangles()) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    triangles.insert(triangles.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  return TriangleMesh(std::move(positions), std::move(triangles));
}

// Particles of a grid that the vertices lie on, too: rays through them meet vertices and edges only.
TEST(MeshFit, ParticlesInLineWithVerticesAreInside) {
  constexpr int n = 8;
  constexpr float step = 0.125F;  // exact
  TriangleMesh mesh = test::make_box(Vec3d::Zero(), Vec3d::Constant(n * static_cast<double>(step)));
  for (int level = 0; level < 3; ++level) mesh = halved(mesh);
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> ids;
  for (int i = 1; i < n; ++i) {
    for (int j = 1; j < n; ++j) {
      for (int k = 1; k < n; ++k) {
        positions.emplace_back(step * static_cast<float>(i), step * static_cast<float>(j),
                               step * static_cast<float>(k));
        ids.push_back(static_cast<std::uint32_t>(ids.size()));
      }
    }
  }
  EXPECT_EQ(mismatch(mesh, make_particle_frame(0, positions, ids), step), "fits");
}

}  // namespace
}  // namespace particle_surface_tracker
