#include "particle_surface_tracker/core/parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

using ::testing::HasSubstr;

template <typename Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "no ParameterError";
}

Parameters valid() {
  Parameters parameters;
  parameters.particle_spacing = 0.1;
  return parameters;
}

TEST(Parameters, DefaultsAreThoseOfThePaper) {
  const Parameters p;
  EXPECT_EQ(p.tau, 0.5);
  EXPECT_EQ(p.epsilon, 0.35);
  EXPECT_EQ(p.dx_phi, 0.5);
  EXPECT_EQ(p.dx_gamma, 0.5);
  EXPECT_EQ(p.advection_radius, 2.0);
  EXPECT_EQ(p.influence_radius, 4.0);
  EXPECT_EQ(p.projection_tolerance, 0.005);
  EXPECT_EQ(p.band_factor, 1.25);
}

TEST(Parameters, DefaultsAreValidOnceTheSpacingIsGiven) {
  EXPECT_NO_THROW(check_parameters(valid()));
  EXPECT_THAT(error_of([] { check_parameters(Parameters{}); }), HasSubstr("particle_spacing is 0 m"));
}

TEST(Parameters, EveryParameterReadsBackAsItWasWritten) {
  const Parameters original = valid();
  Parameters copy;
  copy.advection = AdvectionMethod::kAverage;
  copy.projection = ProjectionMethod::kOneStep;
  copy.particle_spacing = 1.0 / 3.0;
  for (const ParameterInfo& info : parameter_table()) {
    const std::string changed = get_parameter(copy, info.name);
    Parameters again;
    set_parameter(again, info.name, changed);
    EXPECT_EQ(get_parameter(again, info.name), changed) << info.name;
    set_parameter(copy, info.name, get_parameter(original, info.name));
    EXPECT_EQ(get_parameter(copy, info.name), get_parameter(original, info.name)) << info.name;
    EXPECT_FALSE(info.text.empty()) << info.name;
  }
}

TEST(Parameters, EndsOfEveryRangeAreValidAndBeyondThemIsAnError) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type == ParameterInfo::Type::kChoice) continue;
    Parameters p = valid();
    const std::string beyond = info.type == ParameterInfo::Type::kInteger
                                   ? std::to_string(static_cast<int>(info.maximum) + 1)
                                   : std::to_string(info.maximum * 1.01);
    EXPECT_THAT(error_of([&] { set_parameter(p, info.name, beyond); }), HasSubstr(info.name));
    EXPECT_EQ(get_parameter(p, info.name), get_parameter(valid(), info.name)) << "a refused value must change nothing";
  }
}

TEST(Parameters, UnknownNameSuggestsTheNearest) {
  Parameters p = valid();
  EXPECT_THAT(error_of([&] { set_parameter(p, "epsilom", "0.5"); }), HasSubstr("'epsilon'"));
  EXPECT_THAT(error_of([&] { get_parameter(p, "dx_gama"); }), HasSubstr("'dx_gamma'"));
}

TEST(Parameters, TextThatIsNoNumberIsAnError) {
  Parameters p = valid();
  for (const char* text : {"", "half", "0.5r", "0,5", "nan", "inf", "-1", "1e999", " 0.5"}) {
    EXPECT_THAT(error_of([&] { set_parameter(p, "tau", text); }), HasSubstr("tau")) << text;
  }
  EXPECT_THAT(error_of([&] { set_parameter(p, "projection_max_steps", "2.5"); }), HasSubstr("whole number"));
  EXPECT_THAT(error_of([&] { set_parameter(p, "advection", "cubic"); }), HasSubstr("average, affine"));
}

TEST(Parameters, SpacingMustBePositiveAndFinite) {
  Parameters p;
  for (const char* text : {"0", "-0.1", "nan", "inf", "1e300"}) {
    EXPECT_THAT(error_of([&] { set_parameter(p, "particle_spacing", text); }), HasSubstr("particle_spacing")) << text;
  }
}

TEST(Parameters, ValuesThatContradictEachOtherAreAnError) {
  Parameters p = valid();
  p.eigenvalue_low = p.eigenvalue_high;
  EXPECT_THAT(error_of([&] { check_parameters(p); }), HasSubstr("eigenvalue_low"));
  p = valid();
  p.affine_max_radius = 1.0;
  EXPECT_THAT(error_of([&] { check_parameters(p); }), HasSubstr("affine_max_radius"));
}

}  // namespace
}  // namespace particle_surface_tracker
