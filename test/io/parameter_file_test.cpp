#include "particle_surface_tracker/io/parameter_file.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

class ParameterFile : public testing::Test {
 protected:
  Parameters read(const std::string& text) {
    folder_.write("a.yaml", text);
    Parameters parameters;
    read_parameter_file(path_, parameters);
    return parameters;
  }

  // Error of the kind, with all words, for a file of this text.
  template <typename Kind>
  void expect_error(const std::string& text, const std::vector<std::string>& words) {
    try {
      read(text);
      ADD_FAILURE() << "no error for: " << text;
    } catch (const Kind& error) {
      const std::string message = error.what();
      EXPECT_NE(message.find(path_), std::string::npos) << message;
      for (const std::string& word : words) EXPECT_NE(message.find(word), std::string::npos) << word << ": " << message;
    }
  }

  test::TemporaryFolder folder_;
  std::string path_ = folder_ / "a.yaml";
};

TEST_F(ParameterFile, SetsWhatItNamesAndNothingElse) {
  const Parameters read_values = read("# A comment.\ntau: 0.75\nadvection: average\naffine_min_neighbors: 9\n");
  EXPECT_EQ(read_values.tau, 0.75);
  EXPECT_EQ(read_values.advection, AdvectionMethod::kAverage);
  EXPECT_EQ(read_values.affine_min_neighbors, 9);
  EXPECT_EQ(read_values.epsilon, Parameters().epsilon);
}

TEST_F(ParameterFile, EmptyFilesSetNothing) {
  EXPECT_EQ(read("").tau, Parameters().tau);
  EXPECT_EQ(read("# only a comment\n").tau, Parameters().tau);
}

TEST_F(ParameterFile, BadParametersAreNamedWithTheirLine) {
  expect_error<ParameterError>("tau: 0.5\n\ntaau: 1\n", {"line 3", "taau", "tau"});
  expect_error<ParameterError>("tau: half\n", {"line 1", "tau", "half"});
  expect_error<ParameterError>("\ntau: -1\n", {"line 2", "tau", "-1"});
  expect_error<ParameterError>("tau: .nan\n", {"line 1", "tau"});
  expect_error<ParameterError>("affine_min_neighbors: 2.5\n", {"line 1", "affine_min_neighbors", "2.5"});
  expect_error<ParameterError>("advection: magic\n", {"line 1", "advection", "magic", "affine"});
  expect_error<ParameterError>("tau: 0.5\ntau: 0.6\n", {"line 2", "tau", "twice"});
  expect_error<ParameterError>("tau: [0.5]\n", {"line 1", "tau", "one number"});
  expect_error<ParameterError>("tau:\n", {"line 1", "tau", "one number"});
  expect_error<ParameterError>("epsilon: 0.5\ntracker:\n  tau: 0.5\n", {"line 2", "tracker"});
}

TEST_F(ParameterFile, WhatIsNotAMapIsRefused) {
  expect_error<ParameterError>("- tau\n- epsilon\n", {"line 1", "name: value"});
  expect_error<ParameterError>("tau\n", {"line 1", "name: value"});
  expect_error<ParameterError>("? [a, b]\n: 1\n", {"line 1", "plain text"});
}

TEST_F(ParameterFile, WhatCannotBeReadIsAnInputError) {
  expect_error<InputError>("tau: [0.5\n", {"line", "YAML"});
  expect_error<InputError>("tau: 0.5\n  epsilon: 1\n", {"line 2", "YAML"});
  Parameters parameters;
  EXPECT_THROW(read_parameter_file(folder_ / "missing.yaml", parameters), InputError);
  EXPECT_THROW(read_parameter_file(folder_.path().string(), parameters), Error);
}

TEST_F(ParameterFile, AnErrorLeavesTheParametersAlone) {
  std::ofstream(path_) << "tau: 0.75\nepsilon: 7\n";
  Parameters parameters;
  EXPECT_THROW(read_parameter_file(path_, parameters), ParameterError);
  EXPECT_EQ(parameters.tau, Parameters().tau);
}

}  // namespace
}  // namespace particle_surface_tracker
