#include <string>

#include <gtest/gtest.h>

#include "frame_handler_cases.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::test {
namespace {

Checkpoint saved(const FrameHandler& handler) {
  Checkpoint checkpoint;
  handler.save(checkpoint);
  return checkpoint;
}

TEST(FrameHandlerCheckpoint, GoesOnFromACheckpointWithTheSameMessages) {
  FrameHandler handler(ball_options());
  for (const int n : {0, 1, 2}) handler.handle(ball_cloud(n), static_cast<std::uint64_t>(n));
  FrameHandlerOptions without_mesh = ball_options();
  without_mesh.mesh.reset();
  without_mesh.estimate_spacing = true;
  FrameHandler resumed(without_mesh);
  resumed.load(saved(handler));
  EXPECT_TRUE(resumed.started());
  EXPECT_FALSE(resumed.message({false, true}).velocities.empty());
  expect_same_messages(resumed, handler);
  for (const int n : {3, 4}) {
    handler.handle(ball_cloud(n), static_cast<std::uint64_t>(n));
    resumed.handle(ball_cloud(n), static_cast<std::uint64_t>(n));
    expect_same_messages(resumed, handler);
  }
}

TEST(FrameHandlerCheckpoint, ACheckpointThatDoesNotFitChangesNothing) {
  FrameHandler handler(ball_options());
  handler.handle(ball_cloud(0), 0);
  const Checkpoint checkpoint = saved(handler);
  FrameHandlerOptions other = ball_options();
  other.parameters.dx_phi = 0.4;
  other.parameters.dx_gamma = 0.6;
  other.parameters.tau = 0.4;
  FrameHandler different(other);
  try {
    different.load(checkpoint);
    ADD_FAILURE() << "it was taken over";
  } catch (const ParameterError& error) {
    const std::string text = error.what();
    EXPECT_NE(text.find("dx_phi is 0.5 there and 0.4 here"), std::string::npos) << text;
    EXPECT_NE(text.find("dx_gamma"), std::string::npos) << text;
    EXPECT_EQ(text.find("tau"), std::string::npos) << "it can change at any time: " << text;
  }
  EXPECT_FALSE(different.started());

  Checkpoint foreign = checkpoint;
  foreign.sections.clear();
  EXPECT_THROW(handler.load(foreign), InputError);
  foreign.sections = checkpoint.sections;
  foreign.sections.begin()->second.pop_back();
  EXPECT_THROW(handler.load(foreign), InputError);
  foreign = checkpoint;
  foreign.tracker.frame.band = -1.0;
  EXPECT_THROW(handler.load(foreign), TrackingError);
  EXPECT_EQ(handler.message().header.stamp, ros::Time(1, 0));
  EXPECT_EQ(handler.message().topology_version, 1u);
}

TEST(FrameHandlerCheckpoint, WhatCanChangeStaysAsItIsHereAndVersionsGoUp) {
  FrameHandler handler(ball_options());
  handler.handle(ball_cloud(0), 0);
  const Checkpoint checkpoint = saved(handler);
  Parameters parameters = ball_options().parameters;
  parameters.tau = 0.4;
  handler.set_parameters(parameters);
  handler.handle(ball_cloud(1), 1);
  handler.load(checkpoint);
  EXPECT_EQ(handler.tracker().parameters().tau, 0.4);
  EXPECT_EQ(handler.message().header.stamp, ros::Time(1, 0));
  EXPECT_EQ(handler.message().topology_version, 2u) << "other triangles may have had version 1 since";
}

}  // namespace
}  // namespace particle_surface_tracker::test
