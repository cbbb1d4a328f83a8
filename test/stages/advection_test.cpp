#include "particle_surface_tracker/stages/advection.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/instruction_set.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

constexpr double r = 0.1;

Parameters with(AdvectionMethod method) {
  Parameters parameters;
  parameters.particle_spacing = r;
  parameters.advection = method;
  return parameters;
}

template <typename Map>
ParticleFrame moved(const ParticleFrame& frame, Map&& map) {
  ParticleFrame result = frame;
  for (Vec3f& p : result.positions) p = map(p.cast<double>()).template cast<float>();
  return result;
}

std::vector<Vec3f> advected(const std::vector<Vec3f>& vertices, const ParticleFrame& from, const ParticleFrame& to,
                            const Parameters& parameters) {
  const ParticleMotion motion = match_particles(from, to, parameters);
  return advect(vertices, motion, ParticleGrid(motion.positions, r), parameters);
}

ParticleFrame ball(double radius, double jitter) {
  return test::fill_with_particles(Vec3d::Constant(-radius), Vec3d::Constant(radius), r, jitter, 3,
                                   [&](const Vec3d& x) { return x.norm() < radius - 0.4 * r; });
}

Eigen::Isometry3d slanted_turn(double angle) {
  Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
  motion.translate(Vec3d(0.03, -0.02, 0.05));
  motion.rotate(Eigen::AngleAxisd(angle, Vec3d(1, 2, 3).normalized()));
  return motion;
}

TEST(MatchParticles, GoesByIdAndCountsBirthsAndDeaths) {
  const ParticleFrame earlier = make_particle_frame(0, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}}, {2, 4, 6, 8});
  const ParticleFrame later = make_particle_frame(1, {{2.5, 0, 0}, {9, 0, 0}, {0.5, 0, 0}}, {6, 7, 2});
  const ParticleMotion motion = match_particles(earlier, later, with(AdvectionMethod::kAffine));
  ASSERT_EQ(motion.positions.size(), 2u);
  EXPECT_EQ(motion.positions[0], Vec3f(0, 0, 0));
  EXPECT_EQ(motion.displacements[0], Vec3f(0.5, 0, 0));
  EXPECT_EQ(motion.positions[1], Vec3f(2, 0, 0));
  EXPECT_EQ(motion.displacements[1], Vec3f(0.5, 0, 0));
  EXPECT_EQ(motion.gone, 2u);
  EXPECT_EQ(motion.born, 1u);
}

TEST(MatchParticles, ATeleportIsADeathAndABirth) {
  const ParticleFrame earlier = make_particle_frame(0, {{0, 0, 0}, {1, 0, 0}}, {1, 2});
  const ParticleFrame later = make_particle_frame(1, {{0, 0, 0}, {1, 5, 0}}, {1, 2});
  const ParticleMotion motion = match_particles(earlier, later, with(AdvectionMethod::kAffine));
  EXPECT_EQ(motion.positions.size(), 1u);
  EXPECT_EQ(motion.gone, 1u);
  EXPECT_EQ(motion.born, 1u);
}

TEST(Advection, AverageIsTheFormulaOfThePaper) {
  const ParticleFrame from = ball(0.5, 0.3);
  std::mt19937 random(20170701);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const ParticleFrame to = moved(from, [&](const Vec3d& x) {
    return Vec3d(x + 0.5 * r * Vec3d(uniform(random), uniform(random), uniform(random)));
  });
  const std::vector<Vec3f> vertices = test::make_sphere(Vec3d::Zero(), 0.5, 2).positions();
  const std::vector<Vec3f> result = advected(vertices, from, to, with(AdvectionMethod::kAverage));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    Vec3d sum = Vec3d::Zero();
    double weight = 0.0;
    for (std::size_t j = 0; j < from.size(); ++j) {
      const double q = (from.positions[j] - vertices[v]).cast<double>().squaredNorm() / (4 * r * r);
      if (q >= 1.0) continue;
      sum += std::pow(1 - q, 3) * (to.positions[j] - from.positions[j]).cast<double>();
      weight += std::pow(1 - q, 3);
    }
    const Vec3d expected = vertices[v].cast<double>() + sum / weight;
    EXPECT_LT((result[v].cast<double>() - expected).norm(), 2e-6 * r) << v;
  }
}

TEST(Advection, AffineCarriesRigidMotionExactly) {
  for (const double jitter : {0.0, 0.3}) {
    const ParticleFrame from = ball(0.6, jitter);
    const Eigen::Isometry3d motion = slanted_turn(0.3);
    const std::vector<Vec3f> vertices = test::make_sphere(Vec3d::Zero(), 0.6, 3).positions();
    const auto result = advected(vertices, from, moved(from, [&](const Vec3d& x) { return Vec3d(motion * x); }),
                                 with(AdvectionMethod::kAffine));
    for (std::size_t v = 0; v < vertices.size(); ++v) {
      EXPECT_LT((result[v].cast<double>() - motion * vertices[v].cast<double>()).norm(), 1e-4 * r) << v;
    }
  }
}

TEST(Advection, AffineCarriesRigidMotionOfSheetsAndThreads) {
  const Eigen::Isometry3d motion = slanted_turn(0.2);
  const auto turn = [&](const Vec3d& x) { return Vec3d(motion * x); };
  const ParticleFrame sheet = test::fill_with_particles(Vec3d(-0.5, -0.5, 0), Vec3d(0.5, 0.5, 0), r, 0.0, 1,
                                                        [](const Vec3d& x) { return x.z() < r; });
  const std::vector<Vec3f> above = {{0.01f, 0.02f, 0.1f}, {0.11f, -0.07f, 0.0f}};
  const auto on_sheet = advected(above, sheet, moved(sheet, turn), with(AdvectionMethod::kAffine));
  for (std::size_t v = 0; v < above.size(); ++v) {
    EXPECT_LT((on_sheet[v].cast<double>() - motion * above[v].cast<double>()).norm(), 1e-3 * r) << v;
  }
  // A thread knows nothing of a turn about itself; a turn about an axis across it is carried.
  const ParticleFrame thread = make_particle_frame(
      0, {{-0.3f, 0, 0}, {-0.2f, 0, 0}, {-0.1f, 0, 0}, {0, 0, 0}, {0.1f, 0, 0}, {0.2f, 0, 0}, {0.3f, 0, 0}},
      {0, 1, 2, 3, 4, 5, 6});
  const Eigen::AngleAxisd across(0.2, Vec3d::UnitZ());
  const std::vector<Vec3f> beside = {{0.02f, 0.05f, 0.0f}, {0.02f, 0.0f, 0.05f}};
  const auto on_thread = advected(beside, thread, moved(thread, [&](const Vec3d& x) { return Vec3d(across * x); }),
                                  with(AdvectionMethod::kAffine));
  for (std::size_t v = 0; v < beside.size(); ++v) {
    EXPECT_LT((on_thread[v].cast<double>() - across * beside[v].cast<double>()).norm(), 1e-3 * r) << v;
  }
}

TEST(Advection, AffineIsBoundedWhereBodiesCollide) {
  // Two blocks run into each other at 1 r per frame; a fit without bounds throws vertices between them far away.
  const ParticleFrame from =
      test::fill_with_particles(Vec3d(-0.5, -0.3, -0.3), Vec3d(0.5, 0.3, 0.3), r, 0.2, 5,
                                [](const Vec3d& x) { return std::abs(x.x()) > r && x.cwiseAbs().maxCoeff() < 0.5; });
  const ParticleFrame to = moved(from, [](const Vec3d& x) { return Vec3d(x - Vec3d(std::copysign(r, x.x()), 0, 0)); });
  std::vector<Vec3f> vertices;
  for (int i = -15; i <= 15; ++i) {
    for (int j = -30; j <= 30; ++j)
      vertices.emplace_back(0.01f * static_cast<float>(i), 0.01f * static_cast<float>(j), 0.02f);
  }
  const auto affine = advected(vertices, from, to, with(AdvectionMethod::kAffine));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    EXPECT_LT((affine[v] - vertices[v]).norm(), 2.0 * r) << vertices[v].transpose();
  }
}

TEST(Advection, RestLeavesEveryBit) {
  const ParticleFrame frame = ball(0.5, 0.3);
  const std::vector<Vec3f> vertices = test::make_sphere(Vec3d(0.001, 0.002, 0.003), 0.49, 3).positions();
  for (const AdvectionMethod method : {AdvectionMethod::kAverage, AdvectionMethod::kAffine}) {
    EXPECT_EQ(advected(vertices, frame, frame, with(method)), vertices);
  }
}

TEST(Advection, RestLeavesEveryBitBesideSomethingThatMoves) {
  ParticleFrame from = ball(0.3, 0.3);
  const std::size_t resting = from.size();
  for (std::size_t n = 0; n < resting; ++n) {
    from.positions.push_back(from.positions[n] - Vec3f(1.0f, 0.0f, 0.0f));
    from.ids.push_back(static_cast<std::uint32_t>(from.ids.back() + 1));
  }
  ParticleFrame to = from;
  for (std::size_t n = resting; n < to.size(); ++n) to.positions[n] += Vec3f(0.013f, 0.007f, -0.011f);
  const std::vector<Vec3f> vertices = test::make_sphere(Vec3d(0.001, 0.002, 0.003), 0.29, 3).positions();
  for (const AdvectionMethod method : {AdvectionMethod::kAverage, AdvectionMethod::kAffine}) {
    EXPECT_EQ(advected(vertices, from, to, with(method)), vertices);
  }
}

TEST(Advection, InstructionSetsDoNotChangeIt) {
  const ParticleFrame from = ball(0.5, 0.3);
  const ParticleFrame to = moved(from, [](const Vec3d& x) -> Vec3d {
    return slanted_turn(0.2) * x + 0.02 * Vec3d(x.y() * x.z(), std::sin(9.0 * x.x()), x.x() * x.x());
  });
  // Also some that lie so far outside that the first radius does not do.
  std::vector<Vec3f> vertices = test::make_sphere(Vec3d(0.001, 0.002, 0.003), 0.49, 4).positions();
  const std::vector<Vec3f> outside = test::make_sphere(Vec3d::Zero(), 0.68, 2).positions();
  vertices.insert(vertices.end(), outside.begin(), outside.end());
  for (const AdvectionMethod method : {AdvectionMethod::kAverage, AdvectionMethod::kAffine}) {
    std::vector<Vec3f> first;
    for (const InstructionSet set : {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
      if (!is_supported(set)) continue;
      const ForcedInstructionSet forced(set);
      const std::vector<Vec3f> result = advected(vertices, from, to, with(method));
      if (first.empty()) first = result;
      EXPECT_EQ(result, first);
    }
  }
}

TEST(Advection, AVertexWithoutNeighborsFollowsTheNearestParticle) {
  const ParticleFrame from = make_particle_frame(0, {{0, 0, 0}, {100, 0, 0}}, {1, 2});
  const ParticleFrame to = make_particle_frame(1, {{0.1f, 0, 0}, {100, 0.2f, 0}}, {1, 2});
  const std::vector<Vec3f> vertices = {{0.3f, 0, 0}, {-20, 0, 0}, {70, 5, 5}};
  for (const AdvectionMethod method : {AdvectionMethod::kAverage, AdvectionMethod::kAffine}) {
    const auto result = advected(vertices, from, to, with(method));
    EXPECT_LT((result[0] - Vec3f(0.4f, 0, 0)).norm(), 1e-5f);
    EXPECT_LT((result[1] - Vec3f(-19.9f, 0, 0)).norm(), 1e-5f);
    EXPECT_LT((result[2] - Vec3f(70, 5.2f, 5)).norm(), 1e-5f);
  }
}

TEST(Advection, WithoutCommonParticlesNothingMoves) {
  const ParticleFrame from = make_particle_frame(0, {{0, 0, 0}}, {1});
  const ParticleFrame to = make_particle_frame(1, {{0.1f, 0, 0}}, {2});
  const std::vector<Vec3f> vertices = {{0.05f, 0, 0}};
  EXPECT_EQ(advected(vertices, from, to, with(AdvectionMethod::kAffine)), vertices);
}

}  // namespace
}  // namespace particle_surface_tracker
