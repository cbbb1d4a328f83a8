#include "sequences/topology_figures.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "sequences/mesh_judge.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

TopologyFigures good_frame(std::uint64_t frame) {
  TopologyFigures figures;
  figures.frame = frame;
  figures.is_manifold = figures.is_manifold_welded = true;
  figures.volume_ratio = 1.02;
  figures.originals = 1.0;
  return figures;
}

std::vector<TopologyFigures> good_sequence(std::size_t count) {
  std::vector<TopologyFigures> figures;
  for (std::size_t n = 0; n < count; ++n) figures.push_back(good_frame(n));
  return figures;
}

/// Whether each limit is kept, in the order of judge_figures(): valid, crossing, topology, covered, volume, originals.
std::vector<bool> passed(const std::vector<TopologyFigures>& figures, const SequenceLimits& limits = {}) {
  std::vector<bool> all;
  for (const SequenceVerdict& verdict : judge_figures(figures, limits)) all.push_back(verdict.passed);
  return all;
}

std::size_t columns_of(const std::string& csv) {
  return static_cast<std::size_t>(std::count(csv.begin(), csv.end(), ',')) + 1;
}

}  // namespace

TEST(TopologyFigures, AGoodSequencePassesEverything) {
  EXPECT_EQ(passed(good_sequence(100)), std::vector<bool>(6, true));
}

TEST(TopologyFigures, OneInvalidFrameFails) {
  for (const int what : {0, 1, 2, 3}) {
    std::vector<TopologyFigures> figures = good_sequence(1000);
    if (what == 0) figures[7].is_manifold = false;
    if (what == 1) figures[7].is_manifold_welded = false;
    if (what == 2) figures[7].topology.nested_solids = 1;
    if (what == 3) figures[7].topology.misplaced_cavities = 1;
    EXPECT_EQ(passed(figures), (std::vector<bool>{false, true, true, true, true, true})) << what;
  }
}

TEST(TopologyFigures, SelfIntersectionsCountOnAverage) {
  std::vector<TopologyFigures> figures = good_sequence(10);
  figures[3].self_intersecting = 0.0099;
  EXPECT_TRUE(passed(figures)[1]);
  figures[4].self_intersecting = 0.0002;
  EXPECT_FALSE(passed(figures)[1]);
}

TEST(TopologyFigures, OneFrameInAHundredMayDifferInTopology) {
  std::vector<TopologyFigures> figures = good_sequence(100);
  figures[3].topology.wrong = 2;
  figures[4].topology.wrong_now = 2;
  figures[5].topology.uncovered.resize(3);
  EXPECT_EQ(passed(figures), std::vector<bool>(6, true));
  figures[6].topology.wrong = 1;
  figures[6].topology.uncovered.resize(1);
  EXPECT_EQ(passed(figures), (std::vector<bool>{true, true, false, false, true, true}));
}

TEST(TopologyFigures, NotesSayWhereSomethingIsWrong) {
  TopologyFigures figures = good_sequence(1).front();
  EXPECT_EQ(topology_notes(figures), "");
  figures.frame = 7;
  figures.topology.wrong_bodies = {{true, {1.0F, 2.0F, 3.0F}, 12, {{4.0F, 5.0F, 6.0F}}},
                                   {false, {7.0F, 8.0F, 9.0F}, 20, {}}};
  figures.topology.uncovered = {{0.5F, 0.25F, 0.125F}};
  EXPECT_EQ(
      topology_notes(figures),
      "frame 7: wrong is a body of the mesh at (1.0000, 2.0000, 3.0000) with 12 particles; its partners: (4.0000, "
      "5.0000, 6.0000)\n"
      "frame 7: wrong is a body of φ = 0 at (7.0000, 8.0000, 9.0000) with 20 particles; its partners: none\n"
      "frame 7: outside by more than r is the particle at (0.5000, 0.2500, 0.1250)\n");
}

TEST(TopologyFigures, VolumeIsRelativeToTheFirstFrame) {
  std::vector<TopologyFigures> figures = good_sequence(3);
  figures[1].volume_ratio = 1.02 * 0.951;
  EXPECT_TRUE(passed(figures)[4]);
  EXPECT_FALSE(passed(figures, limits_for("melting_bunny"))[4]);
  EXPECT_FALSE(passed(figures, limits_for("splitting_armadillo"))[4]);
  figures[1].volume_ratio = 1.02 * 1.051;
  EXPECT_FALSE(passed(figures)[4]);
  figures[1].volume_ratio = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(passed(figures)[4]);
}

TEST(TopologyFigures, OriginalVerticesCountAtTheEnd) {
  std::vector<TopologyFigures> figures = good_sequence(3);
  figures[2].originals = 0.7;
  EXPECT_TRUE(passed(figures, limits_for("two_drops"))[5]);
  EXPECT_TRUE(passed(figures, limits_for("splitting_armadillo"))[5]);
  EXPECT_FALSE(passed(figures, limits_for("melting_bunny"))[5]);
}

TEST(TopologyFigures, TheSummarySaysWhatFailsAndTheMarksOfAnEvent) {
  std::vector<TopologyFigures> figures = good_sequence(10);
  figures[2].is_manifold = false;
  figures[3].topology.splits = 2;
  figures[3].marks["flagged_cells"] = 50;
  figures[5].topology.merges = 2;
  figures[5].marks["flagged_cells"] = 30;
  const std::string summary = summary_of("name", figures, {});
  for (const char* words : {"name: 10 frames", "FAIL  frames with a valid mesh", "90.000 %", "pass  largest change",
                            "2 splits and 2 merges", "flagged_cells 80 (20.0 for each)"}) {
    EXPECT_NE(summary.find(words), std::string::npos) << words << "\n" << summary;
  }
}

TEST(TopologyFigures, CsvRowsHaveTheColumnsOfTheHead) {
  TopologyFigures figures = good_frame(0);
  EXPECT_EQ(columns_of(topology_csv_row(figures, figures)), columns_of(topology_csv_header()));
  figures.marks["flagged_cells"] = 3;
  EXPECT_EQ(columns_of(topology_csv_row(figures, figures)), columns_of(topology_csv_header()));
}

TEST(TopologyFigures, OfATrackedBall) {
  const double r = 0.2;
  const auto in_ball = [](const Vec3d& x) { return x.norm() < 0.95; };
  ParticleFrame particles = fill_with_particles(Vec3d(-1, -1, -1), Vec3d(1, 1, 1), r, 0.0, 0, in_ball);
  Parameters parameters;
  parameters.particle_spacing = r;
  Tracker tracker(parameters);
  TopologyFigureTaker taker(tracker);
  FrameReport report = tracker.start(make_sphere(Vec3d::Zero(), 1.0, 3), particles);
  const TopologyFigures first = taker.take(particles, report);
  for (Vec3f& position : particles.positions) position.x() += 0.01f;
  report = tracker.advance(particles, 1);
  const TopologyFigures second = taker.take(particles, report);
  for (const TopologyFigures& figures : {first, second}) {
    EXPECT_TRUE(figures.is_valid());
    EXPECT_TRUE(figures.topology.is_equal());
    EXPECT_EQ(figures.topology.mesh_bodies, 1u);
    EXPECT_EQ(figures.topology.phi_bodies, 1u);
    EXPECT_TRUE(figures.topology.uncovered.empty());
    EXPECT_EQ(figures.self_intersecting, 0.0);
    EXPECT_EQ(figures.originals, 1.0);
    EXPECT_EQ(figures.marks.at("flagged_cells"), 0u);
  }
  EXPECT_EQ(second.frame, 1u);
  EXPECT_NEAR(second.volume_ratio / first.volume_ratio, 1.0, 0.01);
}

TEST(WeldedByPosition, FindsWhatAReaderWouldJoin) {
  // Two boxes that touch in a corner.
  const TriangleMesh boxes = joined({make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 1, 1}, {2, 2, 2})});
  EXPECT_TRUE(find_surface_defects(boxes.vertex_count(), boxes.triangles()).none());
  const SurfaceDefects welded =
      find_surface_defects(boxes.vertex_count(), welded_by_position(boxes.positions(), boxes.triangles()));
  EXPECT_EQ(welded.non_manifold_vertices, 1u);
  EXPECT_EQ(welded.unused_vertices, 1u);
}

}  // namespace particle_surface_tracker::test
