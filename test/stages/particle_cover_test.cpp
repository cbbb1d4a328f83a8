// Re-meshed surface reaches out for particles that it just misses.

#include "particle_surface_tracker/stages/particle_cover.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sequences/mesh_judge.h"
#include "sequences/solid_judge.h"
#include "support/detailed_body.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

constexpr double kSpacing = 0.1;
constexpr double kRadius = 0.5;

/// Edges of about 0.06.
const TriangleMesh kBody = test::make_sphere(Vec3d::Zero(), kRadius, 4);

/// A particle outside the body, in units of r from its surface.
Vec3f particle_at(double distance, const Vec3d& direction = Vec3d(0.31, 0.47, 0.83)) {
  return (direction.normalized() * (kRadius + distance * kSpacing)).cast<float>();
}

double distance_to(const TriangleMesh& mesh, const Vec3f& particle) {
  return test::SolidJudge(mesh.positions(), mesh.triangles()).nearest(particle).distance;
}

TEST(ParticleCover, ReachesAParticleThatIsJustMissed) {
  TriangleMesh mesh = kBody;
  const Vec3f particle = particle_at(1.1);
  ASSERT_GT(distance_to(mesh, particle), kSpacing);
  const std::vector<std::uint32_t> moved = cover_particles(mesh, 0, {particle}, kSpacing);
  EXPECT_NEAR(distance_to(mesh, particle), 0.98 * kSpacing, 1e-3 * kSpacing);
  ASSERT_EQ(moved.size(), 3U);
  EXPECT_TRUE(std::is_sorted(moved.begin(), moved.end()));
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    const bool has_moved = mesh.positions()[v] != kBody.positions()[v];
    EXPECT_EQ(has_moved, std::binary_search(moved.begin(), moved.end(), v));
    EXPECT_LT((mesh.positions()[v] - kBody.positions()[v]).norm(), 0.2 * kSpacing);
  }
}

TEST(ParticleCover, IsContentWithWhatIsCovered) {
  TriangleMesh mesh = kBody;
  EXPECT_TRUE(cover_particles(mesh, 0, {particle_at(0.9)}, kSpacing).empty());
  EXPECT_TRUE(cover_particles(mesh, 0, {}, kSpacing).empty());
  EXPECT_EQ(mesh.positions(), kBody.positions());
}

TEST(ParticleCover, LeavesWhatIsFarAway) {
  TriangleMesh mesh = kBody;
  EXPECT_TRUE(cover_particles(mesh, 0, {particle_at(1.3), particle_at(50.0), Vec3f(1e30F, 0, 0)}, kSpacing).empty());
  EXPECT_EQ(mesh.positions(), kBody.positions());
}

TEST(ParticleCover, MovesTheFirstMeshALittleForAFrame) {
  const auto first_new_id = static_cast<std::uint32_t>(kBody.vertex_count());
  TriangleMesh mesh = kBody;
  // Where it belongs is still what its δ says.
  EXPECT_TRUE(cover_particles(mesh, first_new_id, {particle_at(1.1)}, kSpacing).empty());
  EXPECT_NEAR(distance_to(mesh, particle_at(1.1)), 0.98 * kSpacing, 1e-3 * kSpacing);
  mesh = kBody;
  EXPECT_TRUE(cover_particles(mesh, first_new_id, {particle_at(1.2)}, kSpacing).empty());
  EXPECT_EQ(mesh.positions(), kBody.positions());
}

TEST(ParticleCover, MovesOnlyTheNewCornersOfATriangle) {
  const std::uint32_t first_new_id = kBody.next_id() / 2;
  std::size_t all = 0;
  for (int n = 0; n < 200; ++n) {
    TriangleMesh mesh = kBody;
    const double angle = 0.03 * n;
    const Vec3f particle = particle_at(1.2, {std::cos(angle), std::sin(angle), 0.1});
    for (const std::uint32_t v : cover_particles(mesh, first_new_id, {particle}, kSpacing)) {
      EXPECT_GE(v, first_new_id);
      ++all;
    }
    for (std::uint32_t v = 0; v < first_new_id; ++v) ASSERT_EQ(mesh.positions()[v], kBody.positions()[v]) << n;
  }
  EXPECT_GT(all, 0U);
}

Vec3d center_of(const Triangle& triangle) {
  Vec3d center = Vec3d::Zero();
  for (const std::uint32_t v : triangle) center += kBody.positions()[v].cast<double>() / 3.0;
  return center;
}

/// Something small that lies close above the triangle beside the one that a particle is nearest to.
struct Speck {
  explicit Speck(double size) {
    const Triangle& nearest = kBody.triangles()[700];
    particle = particle_at(1.12, center_of(nearest));
    const auto beside = std::find_if(kBody.triangles().begin(), kBody.triangles().end(), [&](const Triangle& t) {
      return t != nearest && std::count_if(t.begin(), t.end(), [&](std::uint32_t v) {
                               return std::find(nearest.begin(), nearest.end(), v) != nearest.end();
                             }) == 2;
    });
    const Vec3d outwards = 0.3 * (center_of(*beside) - center_of(nearest));
    const Vec3d place = (center_of(*beside) + outwards) * (1.0 + (0.01 * kSpacing + size) / kRadius);
    mesh = test::joined({kBody, test::make_sphere(place, size, 0)});
  }

  Vec3f particle;
  TriangleMesh mesh;
};

TEST(ParticleCover, MakesNothingCrossAndSwallowsNothing) {
  TriangleMesh free = kBody;
  ASSERT_EQ(cover_particles(free, 0, {Speck(0.01 * kSpacing).particle}, kSpacing).size(), 3U);
  // The large one would be crossed; the small one would be inside, in one piece.
  for (const double size : {0.06 * kSpacing, 0.01 * kSpacing}) {
    Speck speck(size);
    ASSERT_EQ(test::count_self_intersecting_triangles(speck.mesh.positions(), speck.mesh.triangles()), 0U);
    ASSERT_EQ(distance_to(speck.mesh, speck.particle), distance_to(kBody, speck.particle)) << "the body is nearer";
    const TriangleMesh before = speck.mesh;
    EXPECT_TRUE(cover_particles(speck.mesh, 0, {speck.particle}, kSpacing).empty()) << size;
    EXPECT_EQ(speck.mesh.positions(), before.positions());
  }
}

TEST(ParticleCover, HoldsForManyParticlesAtARoughBody) {
  constexpr double r = 0.02;
  const test::DetailedBody body(r);
  TriangleMesh mesh = body.mesh();
  ASSERT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0U);
  const test::SolidJudge judge(mesh.positions(), mesh.triangles());
  std::mt19937 random(20171);
  std::uniform_int_distribution<std::size_t> vertex(0, mesh.vertex_count() - 1);
  std::normal_distribution<double> offset(0.0, r);
  std::vector<Vec3f> particles;
  while (particles.size() < 300) {
    const Vec3d near = mesh.positions()[vertex(random)].cast<double>();
    const Vec3f particle = (near + Vec3d(offset(random), offset(random), offset(random))).cast<float>();
    if (judge.winding_number(particle) != 0) continue;
    const double distance = judge.nearest(particle).distance;
    if (distance > r && distance < 1.25 * r) particles.push_back(particle);
  }
  EXPECT_GT(cover_particles(mesh, 0, particles, r).size(), 300U);
  EXPECT_EQ(test::count_self_intersecting_triangles(mesh.positions(), mesh.triangles()), 0U);
  const test::SolidJudge after(mesh.positions(), mesh.triangles());
  const auto covered = std::count_if(particles.begin(), particles.end(),
                                     [&](const Vec3f& particle) { return after.nearest(particle).distance <= r; });
  EXPECT_GT(covered, 295);
}

}  // namespace
}  // namespace particle_surface_tracker
