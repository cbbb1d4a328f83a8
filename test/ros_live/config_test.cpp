// The parameters of dynamic_reconfigure against those of the library.

#include <algorithm>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "ros/live/parameter_server.h"

namespace particle_surface_tracker {
namespace {

using Type = ParameterInfo::Type;

std::string type_of(const ParameterInfo& info) {
  return info.type == Type::kReal ? "double" : info.type == Type::kInteger ? "int" : "str";
}

TrackerConfig::AbstractParamDescriptionConstPtr find(const std::string& name) {
  for (const auto& description : TrackerConfig::__getParamDescriptions__()) {
    if (description->name == name) return description;
  }
  return nullptr;
}

// The line of cfg/Tracker.cfg that a number needs.
std::string line_of(const ParameterInfo& info) {
  return fmt::format("group.add(\"{}\", {}_t, {}, \"{}{}\", {})", info.name, type_of(info),
                     info.needs_reset ? "RESET" : "LIVE", info.text, info.unit.empty() ? "" : " [" + info.unit + "]",
                     get_parameter(Parameters(), info.name));
}

TEST(Config, HasEveryParameterOfTheTable) {
  std::size_t count = 0;
  for (const ParameterInfo& info : parameter_table()) {
    if (info.name == "particle_spacing") continue;  // That is ~spacing, which may be estimated.
    ++count;
    const auto description = find(info.name);
    ASSERT_TRUE(description) << "cfg/Tracker.cfg lacks:\n" << line_of(info);
    EXPECT_EQ(description->type, type_of(info)) << info.name;
    EXPECT_EQ(description->level, info.needs_reset ? 2u : 1u) << info.name;
    EXPECT_EQ(description->description.find('[') != std::string::npos, !info.unit.empty()) << line_of(info);
    if (!info.unit.empty()) {
      EXPECT_NE(description->description.find("[" + info.unit + "]"), std::string::npos) << line_of(info);
    }
    for (const std::string& value : info.choices) {
      EXPECT_NE(description->edit_method.find("'" + value + "'"), std::string::npos) << info.name << ": " << value;
    }
  }
  EXPECT_EQ(TrackerConfig::__getParamDescriptions__().size(), count)
      << "cfg/Tracker.cfg has one that the table has not";
}

TEST(Config, DefaultsAreThoseOfTheLibrary) {
  Parameters parameters;
  parameters.tau = 0.123;
  apply_config(TrackerConfig::__getDefault__(), parameters);
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(get_parameter(parameters, info.name), get_parameter(Parameters(), info.name)) << info.name;
  }
}

TEST(Config, ASliderReachesTheDefaultAndEndsWithinTheRange) {
  for (const ParameterInfo& info : parameter_table()) {
    if (info.type == Type::kChoice || info.name == "particle_spacing") continue;
    EXPECT_LE(std::stod(get_parameter(Parameters(), info.name)), info.slider_maximum) << info.name;
    EXPECT_LE(info.slider_maximum, info.maximum) << info.name;
    EXPECT_LE(info.slider_maximum, info.unit == "deg" ? 180.0 : 500.0) << info.name << ": of no use as a slider";
    Parameters parameters;
    EXPECT_NO_THROW(set_parameter(parameters, info.name, fmt::format("{}", info.maximum))) << info.name;
  }
}

TEST(Config, EveryParameterIsInAGroup) {
  std::size_t grouped = 0;
  for (const auto& group : TrackerConfig::__getGroupDescriptions__()) {
    if (group->id != 0) grouped += group->parameters.size();
  }
  EXPECT_EQ(grouped, TrackerConfig::__getParamDescriptions__().size());
}

TEST(Config, ValuesComeBackBitForBit) {
  Parameters parameters;
  parameters.particle_spacing = 0.01;
  parameters.tau = 1.0 / 3.0;
  parameters.projection_max_steps = 7;
  parameters.advection = AdvectionMethod::kAverage;
  Parameters back;
  back.particle_spacing = 0.01;
  apply_config(to_config(parameters), back);
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(get_parameter(back, info.name), get_parameter(parameters, info.name)) << info.name;
  }
}

TEST(Config, ValuesOutOfRangeChangeNothing) {
  TrackerConfig config = to_config(Parameters());
  config.tau = 0.25;
  config.epsilon = 2.0;
  Parameters parameters;
  EXPECT_THROW(apply_config(config, parameters), ParameterError);
  EXPECT_EQ(parameters.tau, Parameters().tau);
  config.epsilon = 0.5;
  config.eigenvalue_low = 3.0;
  EXPECT_THROW(apply_config(config, parameters), ParameterError);
}

}  // namespace
}  // namespace particle_surface_tracker
