#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "fluid_simulator.h"
#include "liquid_bodies.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker::simulator {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

template <class Expected>
std::string error_of(const SimulatorParameters& parameters, const ParticleFrame& start) {
  try {
    FluidSimulator simulator(parameters, start);
    simulator.step();
  } catch (const Expected& error) {
    return error.what();
  }
  return "not the expected error";
}

ParticleFrame good() {
  return block(Vec3d(0.0, 0.0, 0.5 * test_spacing), 4, 4, 4);
}

TEST(FluidSimulatorErrors, AGoodStartIsNone) {
  EXPECT_EQ(error_of<Error>(test_parameters(), good()), "not the expected error");
}

TEST(FluidSimulatorErrors, BadParameters) {
  SimulatorParameters parameters = test_parameters();
  parameters.viscosity = -1.0;
  EXPECT_THAT(error_of<ParameterError>(parameters, good()), HasSubstr("viscosity is -1 m^2/s"));
}

TEST(FluidSimulatorErrors, NoParticles) {
  EXPECT_THAT(error_of<ParticleError>(test_parameters(), {}), HasSubstr("no particles"));
}

TEST(FluidSimulatorErrors, NotFinite) {
  ParticleFrame start = good();
  start.positions[5].z() = std::nanf("");
  EXPECT_THAT(error_of<ParticleError>(test_parameters(), start), HasSubstr("not finite"));
  start = good();
  start.velocities[5].z() = INFINITY;
  EXPECT_THAT(error_of<ParticleError>(test_parameters(), start), HasSubstr("not finite"));
}

TEST(FluidSimulatorErrors, RepeatedIds) {
  ParticleFrame start = good();
  start.ids[3] = 7;
  EXPECT_THAT(error_of<ParticleError>(test_parameters(), start), HasSubstr("repeat the id"));
}

TEST(FluidSimulatorErrors, InsideAnObstacleOrBehindAWall) {
  SimulatorParameters parameters = test_parameters();
  parameters.obstacles = {{{0.0, 0.0, 0.0}, 0.1}};
  EXPECT_THAT(error_of<ParticleError>(parameters, good()), AllOf(HasSubstr("of 64 particles"), HasSubstr("id 0")));
  ParticleFrame start = good();
  start.positions[9].z() = 0.4F * static_cast<float>(test_spacing);
  EXPECT_THAT(error_of<ParticleError>(test_parameters(), start), AllOf(HasSubstr("1 of 64"), HasSubstr("id 9")));
  start.positions[9].x() = 2.0F;
  EXPECT_THAT(error_of<ParticleError>(test_parameters(), start), AllOf(HasSubstr("1 of 64"), HasSubstr("id 9")));
}

TEST(FluidSimulatorErrors, SpacingThatDoesNotFitTheParticles) {
  SimulatorParameters parameters = test_parameters();
  parameters.spacing = 0.03;
  EXPECT_THAT(error_of<ParticleError>(parameters, block(Vec3d(0.0, 0.0, 1.0), 9, 9, 9)),
              AllOf(HasSubstr("0.03 m"), HasSubstr("seems to be 0.025 m")));
}

TEST(FluidSimulatorErrors, TooFast) {
  ParticleFrame start = good();
  start.velocities[0].x() = 1e6F;
  EXPECT_THAT(error_of<ParticleError>(test_parameters(), start), HasSubstr("more than 1000 substeps"));
}

}  // namespace
}  // namespace particle_surface_tracker::simulator
