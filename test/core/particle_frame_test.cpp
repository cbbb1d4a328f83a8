#include "particle_surface_tracker/core/particle_frame.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

template <typename Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const ParticleError& error) {
    return error.what();
  }
  return "no ParticleError";
}

TEST(ParticleFrame, IsOrderedById) {
  const ParticleFrame frame =
      make_particle_frame(7, {{3, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {30, 10, 20}, {{0, 3, 0}, {0, 1, 0}, {0, 2, 0}});
  EXPECT_EQ(frame.stamp_ns, 7);
  EXPECT_THAT(frame.ids, ElementsAre(10, 20, 30));
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(frame.positions[i].x(), i + 1.0f);
    EXPECT_EQ(frame.velocities[i].y(), i + 1.0f);
  }
}

TEST(ParticleFrame, MayBeEmpty) {
  EXPECT_TRUE(make_particle_frame(0, {}, {}).empty());
}

TEST(ParticleFrame, PositionsThatAreNotFiniteAreCountedAndTheFirstIsNamed) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float inf = std::numeric_limits<float>::infinity();
  const std::string error = error_of([&] { make_particle_frame(0, {{0, 0, 0}, {0, nan, 0}, {inf, 0, 0}}, {5, 6, 7}); });
  EXPECT_THAT(error, HasSubstr("2 of 3"));
  EXPECT_THAT(error, HasSubstr("id 6"));
  EXPECT_THAT(error_of([&] { make_particle_frame(0, {{0, 0, 0}}, {1}, {{0, 0, -inf}}); }), HasSubstr("velocity"));
}

TEST(ParticleFrame, RepeatedIdsAreAnError) {
  EXPECT_THAT(error_of([] {
                make_particle_frame(0, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {4, 9, 4});
              }),
              HasSubstr("lowest such id is 4"));
}

TEST(ParticleFrame, ArraysOfDifferentLengthsAreAnError) {
  EXPECT_THAT(error_of([] { make_particle_frame(0, {{0, 0, 0}}, {1, 2}); }), HasSubstr("1 positions, 2 ids"));
  EXPECT_THAT(error_of([] {
                make_particle_frame(0, {{0, 0, 0}}, {1}, {{0, 0, 0}, {0, 0, 0}});
              }),
              HasSubstr("2 velocities"));
}

TEST(ParticleSpacing, OfACubicGridIsItsConstant) {
  const double r = 0.03;
  const ParticleFrame frame = test::fill_with_particles(Vec3d::Constant(-0.3), Vec3d::Constant(0.3), r, 0.0, 1,
                                                        [](const Vec3d& x) { return x.norm() < 0.25; });
  EXPECT_NEAR(estimate_particle_spacing(frame), r, 1e-6);
}

TEST(ParticleSpacing, IsFoundInAThreadAndInASheetAndForTwoDistantDrops) {
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t i = 0; i < 100; ++i) {
    const std::uint32_t row = i / 10;
    positions.emplace_back(0.5f * static_cast<float>(i % 10), 0.5f * static_cast<float>(row), 2.0f);
    ids.push_back(i);
  }
  EXPECT_DOUBLE_EQ(estimate_particle_spacing(make_particle_frame(0, positions, ids)), 0.5);
  for (Vec3f& p : positions) p = {p.x() + 10.0f * p.y(), 0.0f, 0.0f};
  EXPECT_NEAR(estimate_particle_spacing(make_particle_frame(0, positions, ids)), 0.5, 1e-6);
  EXPECT_DOUBLE_EQ(estimate_particle_spacing(
                       make_particle_frame(0, {{0, 0, 0}, {1, 0, 0}, {4096, 0, 0}, {4097, 0, 0}}, {0, 1, 2, 3})),
                   1.0);
}

TEST(ParticleSpacing, NeedsTwoDistinctPositions) {
  EXPECT_THROW(estimate_particle_spacing(make_particle_frame(0, {}, {})), ParticleError);
  EXPECT_THROW(estimate_particle_spacing(make_particle_frame(0, {{1, 1, 1}}, {0})), ParticleError);
  EXPECT_THROW(estimate_particle_spacing(make_particle_frame(0, {{1, 1, 1}, {1, 1, 1}}, {0, 1})), ParticleError);
}

}  // namespace
}  // namespace particle_surface_tracker
