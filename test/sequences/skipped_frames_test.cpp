// The tracker where it sees every fourth frame only, as a live node that is too slow does with policy `latest`.

#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/tracker/tracker.h"
#include "sequences/sequence_data.h"
#include "sequences/topology_figures.h"

namespace particle_surface_tracker::test {

namespace {

constexpr std::size_t kStep = 4;

class SkippedFrames : public testing::TestWithParam<const char*> {};

std::vector<TopologyFigures> track_some(const Sequence& sequence) {
  Parameters parameters;
  parameters.particle_spacing = sequence.spacing;
  Tracker tracker(parameters);
  TopologyFigureTaker taker(tracker);
  std::vector<TopologyFigures> figures;
  fmt::print("{}\n", topology_header());
  for (std::size_t n = 0; n < sequence.frames.size(); n += kStep) {
    const ParticleFrame& frame = sequence.frames[n];
    const FrameReport report = n == 0 ? tracker.start(sequence.mesh, frame) : tracker.advance(frame, n);
    figures.push_back(taker.take(frame, report));
    fmt::print("{}\n", topology_row(figures.back(), figures.front()));
  }
  return figures;
}

}  // namespace

TEST_P(SkippedFrames, EndWithTheTopologyAndVolumeOfTheLiquid) {
  PST_SKIP_WITHOUT(GetParam());
  const std::vector<TopologyFigures> figures = track_some(load_sequence(GetParam()));
  for (const TopologyFigures& frame : figures) EXPECT_TRUE(frame.is_valid()) << frame.frame;
  const TopologyFigures& last = figures.back();
  EXPECT_EQ(last.topology.wrong, 0u);
  EXPECT_NEAR(last.volume_ratio / figures.front().volume_ratio, 1.0, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Recorded, SkippedFrames, testing::Values("melting_bunny", "splitting_armadillo"),
                         [](const testing::TestParamInfo<const char*>& tested) { return std::string(tested.param); });

}  // namespace particle_surface_tracker::test
