#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "frame_handler_cases.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::test {
namespace {

TEST(FrameHandlerParameters, SpacingIsEstimatedFromTheFirstCloud) {
  FrameHandlerOptions options = ball_options();
  options.parameters.particle_spacing = 0.0;
  options.estimate_spacing = true;
  FrameHandler handler(options);
  handler.handle(ball_cloud(0), 0);
  EXPECT_NEAR(handler.tracker().parameters().particle_spacing, r, 1e-6);
}

TEST(FrameHandlerParameters, ParametersThatCannotChangeWaitForTheReset) {
  FrameHandlerOptions options = ball_options();
  options.estimate_spacing = true;
  FrameHandler handler(options);
  Parameters parameters = options.parameters;
  parameters.dx_phi = 0.4;
  EXPECT_TRUE(handler.set_parameters(parameters).empty());
  handler.handle(ball_cloud(0), 0);
  EXPECT_EQ(handler.tracker().parameters().dx_phi, 0.4);

  parameters.tau = 0.6;
  parameters.dx_phi = 0.3;
  EXPECT_EQ(handler.set_parameters(parameters), std::vector<std::string>{"dx_phi"});
  EXPECT_EQ(handler.tracker().parameters().tau, 0.6);
  EXPECT_EQ(handler.tracker().parameters().dx_phi, 0.4);
  EXPECT_NEAR(handler.tracker().parameters().particle_spacing, r, 1e-6);
  handler.reset();
  handler.handle(ball_cloud(0), 0);
  EXPECT_EQ(handler.tracker().parameters().dx_phi, 0.3);
  EXPECT_EQ(handler.tracker().parameters().tau, 0.6);

  parameters.epsilon = 2.0;
  EXPECT_THROW(handler.set_parameters(parameters), ParameterError);
  EXPECT_EQ(handler.tracker().parameters().epsilon, Parameters().epsilon);
}

TEST(FrameHandlerParameters, BadParametersAreRefusedAtOnce) {
  FrameHandlerOptions options = ball_options();
  options.parameters.particle_spacing = 0.0;
  EXPECT_THROW(FrameHandler{options}, ParameterError);
  options.estimate_spacing = true;
  EXPECT_NO_THROW(FrameHandler{options});
  options.parameters.epsilon = 2.0;
  EXPECT_THROW(FrameHandler{options}, ParameterError);
}

}  // namespace
}  // namespace particle_surface_tracker::test
