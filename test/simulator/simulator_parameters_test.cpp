#include "simulator_parameters.h"

#include <cmath>
#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::simulator {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

SimulatorParameters valid() {
  SimulatorParameters parameters;
  parameters.spacing = 0.03;
  parameters.obstacles = {{{0.0, 0.0, 0.5}, 0.3}};
  return parameters;
}

std::string error_of(const SimulatorParameters& parameters) {
  try {
    check_simulator_parameters(parameters);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no ParameterError";
}

TEST(SimulatorParameters, DefaultsAreValidOnceTheSpacingIsGiven) {
  EXPECT_NO_THROW(check_simulator_parameters(valid()));
  EXPECT_THAT(error_of(SimulatorParameters{}), HasSubstr("spacing is 0 m"));
}

TEST(SimulatorParameters, TableHasEveryNumberOnce) {
  SimulatorParameters parameters;
  double value = 1000.0;
  for (const auto& [info, field] : simulator_parameter_table()) {
    EXPECT_LT(parameters.*field, 1000.0) << info.name << " is in the table twice";
    parameters.*field = value++;
    EXPECT_FALSE(info.name.empty());
    EXPECT_FALSE(info.text.empty()) << info.name;
  }
  EXPECT_EQ(simulator_parameter_table().size() * sizeof(double) + sizeof(decltype(parameters.obstacles)),
            sizeof(parameters));
}

TEST(SimulatorParameters, DefaultsAreInTheirRanges) {
  for (const auto& [info, field] : simulator_parameter_table()) {
    EXPECT_GE(valid().*field, info.minimum) << info.name;
    EXPECT_LE(valid().*field, info.maximum) << info.name;
  }
}

TEST(SimulatorParameters, BeyondItsRangeIsAnError) {
  for (const auto& [info, field] : simulator_parameter_table()) {
    const double below = info.minimum - std::max(1e-6, 1e-3 * info.maximum);
    const double above = info.maximum * 1.001;
    for (const double value : {below, above, std::nan(""), std::numeric_limits<double>::infinity()}) {
      SimulatorParameters parameters = valid();
      parameters.*field = value;
      EXPECT_THAT(error_of(parameters), HasSubstr(info.name + " is ")) << value;
    }
  }
}

TEST(SimulatorParameters, ObstaclesMustBeBallsOfSomeSize) {
  SimulatorParameters parameters = valid();
  for (const double radius : {0.059, 0.0, -1.0, std::nan("")}) {
    parameters.obstacles[0].radius = radius;
    EXPECT_THAT(error_of(parameters), AllOf(HasSubstr("obstacles[0].radius"), HasSubstr("0.06 m")));
  }
  parameters = valid();
  parameters.obstacles[0].center.y() = std::nan("");
  EXPECT_THAT(error_of(parameters), HasSubstr("obstacles[0].center"));
}

TEST(SimulatorParameters, ObstaclesMustLeaveGaps) {
  SimulatorParameters parameters = valid();
  parameters.obstacles.push_back({{0.0, 0.0, 1.15}, 0.3});
  EXPECT_THAT(error_of(parameters), AllOf(HasSubstr("obstacles[1]"), HasSubstr("to obstacles[0]")));
  parameters.obstacles[1].center.z() = 1.17;
  EXPECT_EQ(error_of(parameters), "no ParameterError");

  parameters = valid();
  parameters.obstacles[0].center.x() = -1.15;
  EXPECT_THAT(error_of(parameters), HasSubstr("a wall of the tank"));

  parameters = valid();
  parameters.obstacles[0].center.z() = 0.35;
  EXPECT_THAT(error_of(parameters), HasSubstr("the floor"));
  parameters.obstacles[0].center.z() = 0.0;
  EXPECT_EQ(error_of(parameters), "no ParameterError") << "a dome on the floor";
}

}  // namespace
}  // namespace particle_surface_tracker::simulator
