// The parameter files in config/.

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/io/parameter_file.h"

namespace particle_surface_tracker {
namespace {

Parameters parameters_of(const std::filesystem::path& path) {
  Parameters parameters;
  parameters.particle_spacing = 0.01;
  read_parameter_file(path.string(), parameters);
  return parameters;
}

std::set<std::string> changed_by(const std::filesystem::path& path) {
  const Parameters parameters = parameters_of(path);
  std::set<std::string> names;
  for (const ParameterInfo& info : parameter_table()) {
    if (info.name != "particle_spacing" &&
        get_parameter(parameters, info.name) != get_parameter(Parameters(), info.name)) {
      names.insert(info.name);
    }
  }
  return names;
}

TEST(Presets, EveryFileIsValid) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(PST_CONFIG)) {
    if (entry.path().extension() != ".yaml") continue;
    names.insert(entry.path().stem().string());
    EXPECT_NO_THROW(check_parameters(parameters_of(entry.path()))) << entry.path();
  }
  EXPECT_EQ(names, (std::set<std::string>{"default", "preview", "splash", "viscous"}));
}

TEST(Presets, TheDefaultFileHoldsEveryParameter) {
  std::ifstream file(PST_CONFIG "/default.yaml");
  const std::string text(std::istreambuf_iterator<char>(file), {});
  for (const ParameterInfo& info : parameter_table()) {
    if (info.name == "particle_spacing") continue;
    EXPECT_NE(text.find("\n" + info.name + ": "), std::string::npos) << info.name;
  }
}

TEST(Presets, ChangeWhatTheySay) {
  const std::filesystem::path config(PST_CONFIG);
  EXPECT_EQ(changed_by(config / "default.yaml"), std::set<std::string>());
  EXPECT_EQ(changed_by(config / "viscous.yaml"), std::set<std::string>({"detection", "stretched_detail"}));
  EXPECT_EQ(changed_by(config / "splash.yaml"), std::set<std::string>({"delta_half_life"}));
  EXPECT_EQ(changed_by(config / "preview.yaml"),
            std::set<std::string>({"dx_phi", "influence_radius", "dx_gamma", "epsilon", "projection_tolerance"}));
}

}  // namespace
}  // namespace particle_surface_tracker
