#include "sequences/topology_judge.h"

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

constexpr double r = 1.0;

struct Box {
  Vec3d lower, upper;
};

/// Bars along x, 3 r thick.
Box bar(double from, double to) {
  return {{from, 0, 0}, {to, 3, 3}};
}

/// A box with a single row of particles at its middle.
Box thread(double from, double to) {
  return {{from, 1, 1}, {to, 2, 2}};
}

TriangleMesh mesh_of(const std::vector<Box>& boxes) {
  std::vector<TriangleMesh> parts;
  for (const auto& [lower, upper] : boxes) parts.push_back(make_box(lower, upper));
  return joined(parts);
}

SurfaceBodies bodies_of(const std::vector<Box>& boxes) {
  const TriangleMesh mesh = mesh_of(boxes);
  return SurfaceBodies(mesh.positions(), mesh.triangles());
}

/// Particles at (i + ½) r in all boxes; ids follow from the places, so that they are the same in every frame.
ParticleFrame particles_in(const std::vector<Box>& boxes) {
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> ids;
  for (std::uint32_t id = 0; id < 40 * 3 * 3; ++id) {
    const std::uint32_t slice = id / 9, row = id / 3 % 3, column = id % 3;
    const Vec3d place(slice + 0.5, row + 0.5, column + 0.5);
    for (const auto& [lower, upper] : boxes) {
      if ((place.array() < lower.array()).any() || (place.array() > upper.array()).any()) continue;
      positions.push_back(place.cast<float>());
      ids.push_back(id);
      break;
    }
  }
  return make_particle_frame(0, std::move(positions), std::move(ids));
}

/// Judges frames in which the boxes are full of particles, those of φ = 0 or `liquid`.
class BoxJudge {
 public:
  TopologyJudgement judge(const std::vector<Box>& mesh, const std::vector<Box>& phi, const std::vector<Box>& liquid) {
    return judge_.judge(bodies_of(mesh), std::make_shared<SurfaceBodies>(bodies_of(phi)), particles_in(liquid));
  }
  TopologyJudgement judge(const std::vector<Box>& mesh, const std::vector<Box>& phi) { return judge(mesh, phi, phi); }

 private:
  TopologyJudge judge_{r};
};

const std::vector<Box> kWhole = {bar(0, 20)};
const std::vector<Box> kHalves = {bar(0, 10), bar(10.5, 20)};

}  // namespace

TEST(TopologyJudge, EqualSurfacesAreEqual) {
  for (const std::vector<Box>& boxes : {kWhole, kHalves}) {
    const TopologyJudgement judgement = BoxJudge().judge(boxes, boxes);
    EXPECT_EQ(judgement.wrong, 0u);
    EXPECT_EQ(judgement.wrong_now, 0u);
    EXPECT_EQ(judgement.mesh_bodies, boxes.size());
    EXPECT_EQ(judgement.phi_bodies, boxes.size());
    EXPECT_EQ(judgement.small_phi_bodies, 0u);
    EXPECT_TRUE(judgement.uncovered.empty());
    EXPECT_EQ(judgement.splits + judgement.merges, 0u);
  }
}

TEST(TopologyJudge, ASplitMayComeOneFrameLate) {
  BoxJudge judge;
  EXPECT_TRUE(judge.judge(kWhole, kWhole).is_equal());
  const TopologyJudgement late = judge.judge(kWhole, kHalves);
  EXPECT_EQ(late.splits, 1u);
  EXPECT_EQ(late.merges, 0u);
  EXPECT_EQ(late.wrong_now, 1u);
  EXPECT_EQ(late.wrong, 0u);
  const TopologyJudgement too_late = judge.judge(kWhole, kHalves);
  EXPECT_EQ(too_late.splits, 0u);
  EXPECT_EQ(too_late.wrong, 1u);
  EXPECT_TRUE(judge.judge(kHalves, kHalves).is_equal());
}

TEST(TopologyJudge, AMergeMayComeOneFrameLate) {
  BoxJudge judge;
  EXPECT_TRUE(judge.judge(kHalves, kHalves).is_equal());
  const TopologyJudgement late = judge.judge(kHalves, kWhole);
  EXPECT_EQ(late.merges, 1u);
  EXPECT_EQ(late.splits, 0u);
  EXPECT_EQ(late.wrong_now, 2u);
  EXPECT_EQ(late.wrong, 0u);
  EXPECT_EQ(judge.judge(kHalves, kWhole).wrong, 2u);
  EXPECT_TRUE(judge.judge(kWhole, kWhole).is_equal());
}

TEST(TopologyJudge, InTheFirstFrameNothingIsLate) {
  EXPECT_EQ(BoxJudge().judge(kWhole, kHalves).wrong, 1u);
  EXPECT_EQ(BoxJudge().judge({bar(0, 10)}, kHalves).wrong, 1u);
}

TEST(TopologyJudge, OneBodyMayBeLateWhileAnotherIsInTime) {
  // The left bar splits and the mesh follows at once; the right one merges and the mesh is late.
  const std::vector<Box> before = {bar(0, 10), bar(15, 20), bar(20.5, 25)};
  const std::vector<Box> after = {bar(0, 5), bar(5.5, 10), bar(15, 25)};
  BoxJudge judge;
  EXPECT_TRUE(judge.judge(before, before).is_equal());
  const TopologyJudgement mixed = judge.judge({bar(0, 5), bar(5.5, 10), bar(15, 20), bar(20.5, 25)}, after);
  EXPECT_EQ(mixed.wrong_now, 2u);
  EXPECT_EQ(mixed.wrong, 0u);
  EXPECT_EQ(mixed.splits, 1u);
  EXPECT_EQ(mixed.merges, 1u);
}

TEST(TopologyJudge, ADropBornAwayFromTheMeshMayBeMissedForOneFrame) {
  const std::vector<Box> with_drop = {bar(0, 10), bar(14, 16)};
  BoxJudge judge;
  judge.judge({bar(0, 10)}, {bar(0, 10)});
  const TopologyJudgement born = judge.judge({bar(0, 10)}, with_drop);
  EXPECT_EQ(born.wrong_now, 1u);
  EXPECT_EQ(born.wrong, 0u);
  EXPECT_EQ(born.uncovered.size(), 18u);
  EXPECT_EQ(judge.judge({bar(0, 10)}, with_drop).wrong, 1u);
}

TEST(TopologyJudge, ADropThatComesOffMayBeMissedForOneFrame) {
  BoxJudge judge;
  judge.judge({bar(0, 20)}, {bar(0, 20)});
  const std::vector<Box> off = {bar(0, 14), bar(17, 20)};
  EXPECT_EQ(judge.judge({bar(0, 14)}, off).wrong, 0u);
  EXPECT_EQ(judge.judge({bar(0, 14)}, off).wrong, 1u);
}

TEST(TopologyJudge, SmallComponentsOfPhiAreNotCompared) {
  const std::vector<Box> with_four = {bar(0, 10), thread(14, 18)};
  const std::vector<Box> with_eight = {bar(0, 10), thread(14, 22)};
  const TopologyJudgement without = BoxJudge().judge({bar(0, 10)}, with_four);
  EXPECT_EQ(without.small_phi_bodies, 1u);
  EXPECT_EQ(without.phi_bodies, 1u);
  EXPECT_TRUE(without.is_equal());
  EXPECT_TRUE(without.uncovered.empty());
  EXPECT_TRUE(BoxJudge().judge(with_four, with_four).is_equal());
  EXPECT_FALSE(BoxJudge().judge({bar(0, 10)}, with_eight).is_equal());
  EXPECT_TRUE(BoxJudge().judge(with_eight, with_eight).is_equal());
  // A droplet of the mesh whose own φ is gone, but not its particles.
  EXPECT_TRUE(BoxJudge().judge(with_four, {bar(0, 10)}, with_four).is_equal());
}

TEST(TopologyJudge, StrayAndDoubleComponentsOfTheMeshAreWrong) {
  // Away from all liquid.
  EXPECT_EQ(BoxJudge().judge({bar(0, 10), bar(30, 31)}, {bar(0, 10)}).wrong, 1u);
  // A scrap beside the mesh, within r of φ: the body of φ has two of the mesh then, and both are wrong.
  const Box scrap = {{10.2, 1, 1}, {10.4, 2, 2}};
  EXPECT_EQ(BoxJudge().judge({bar(0, 10), scrap}, {bar(0, 10)}).wrong, 2u);
  // Beside a small component it does not matter.
  EXPECT_TRUE(BoxJudge().judge({bar(0, 10), {{18.2, 1, 1}, {18.4, 2, 2}}}, {bar(0, 10), thread(14, 18)}).is_equal());
}

TEST(TopologyJudge, SaysWhichBodiesAreWrong) {
  const TopologyJudgement joined_too_long = BoxJudge().judge({bar(0, 20), bar(30, 40)}, {bar(0, 10), bar(10.5, 20)});
  ASSERT_EQ(joined_too_long.wrong_bodies.size(), 2u);
  const WrongBody& whole = joined_too_long.wrong_bodies[0];
  EXPECT_TRUE(whole.is_of_mesh);
  EXPECT_LE(whole.vertex.x(), 20.0F);
  ASSERT_EQ(whole.partners.size(), 2u);
  EXPECT_LE(whole.partners[0].x(), 10.0F);
  EXPECT_GE(whole.partners[1].x(), 10.5F);
  const WrongBody& stray = joined_too_long.wrong_bodies[1];
  EXPECT_TRUE(stray.is_of_mesh);
  EXPECT_GE(stray.vertex.x(), 30.0F);
  EXPECT_EQ(stray.particles, 0u);
  EXPECT_TRUE(stray.partners.empty());

  const TopologyJudgement missing = BoxJudge().judge({bar(0, 10)}, {bar(0, 10), bar(13, 20)});
  ASSERT_EQ(missing.wrong_bodies.size(), 1u);
  EXPECT_FALSE(missing.wrong_bodies[0].is_of_mesh);
  EXPECT_GE(missing.wrong_bodies[0].vertex.x(), 13.0F);
  EXPECT_GE(missing.wrong_bodies[0].particles, 8u);
}

TEST(TopologyJudge, BodiesOfTheMeshThatOverlapAreTwo) {
  EXPECT_EQ(BoxJudge().judge({bar(0, 12), bar(8, 20)}, kWhole).wrong, 2u);
}

TEST(TopologyJudge, ParticlesJustOutsideDoNotLinkBodies) {
  // Both surfaces are a little smaller than the liquid; the particles of each half stay with it.
  const std::vector<Box> shrunk = {bar(0.6, 9.4), bar(11.1, 19.4)};
  const TopologyJudgement judgement = BoxJudge().judge(shrunk, shrunk, kHalves);
  EXPECT_TRUE(judgement.is_equal());
  EXPECT_EQ(judgement.wrong_now, 0u);
  EXPECT_TRUE(judgement.uncovered.empty());
}

TEST(TopologyJudge, CountsParticlesThatTheMeshLost) {
  // The mesh covers 12 of 20 slices of nine particles, and one more lies within r.
  EXPECT_EQ(BoxJudge().judge({bar(0, 12)}, kWhole).uncovered.size(), 7u * 9u);
}

TEST(TopologyJudge, AHollowBodyIsOne) {
  const TriangleMesh hollow = joined({make_box({0, 0, 0}, {9, 9, 9}), turned(make_box({3, 3, 3}, {6, 6, 6}))});
  const ParticleFrame particles = fill_with_particles({0, 0, 0}, {9, 9, 9}, r, 0.0, 0, [](const Vec3d& x) {
    return (x.array() > 0.0).all() && (x.array() < 9.0).all() && ((x.array() < 3.0).any() || (x.array() > 6.0).any());
  });
  const SurfaceBodies mesh(hollow.positions(), hollow.triangles());
  const TopologyJudgement judgement =
      TopologyJudge(r).judge(mesh, std::make_shared<SurfaceBodies>(hollow.positions(), hollow.triangles()), particles);
  EXPECT_TRUE(judgement.is_equal());
  EXPECT_EQ(judgement.mesh_bodies, 1u);
  EXPECT_EQ(judgement.mesh_cavities, 1u);
  EXPECT_EQ(judgement.nested_solids + judgement.misplaced_cavities, 0u);
}

TEST(TopologyJudge, BodiesWithoutLiquid) {
  EXPECT_TRUE(BoxJudge().judge({}, {}).is_equal());
  EXPECT_EQ(BoxJudge().judge(kWhole, {}).wrong, 1u);
  EXPECT_EQ(BoxJudge().judge({}, kWhole).wrong, 1u);
}

}  // namespace particle_surface_tracker::test
