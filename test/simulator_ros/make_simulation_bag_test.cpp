// Runs the program make_simulation_bag itself and reads what it writes.

#include <sys/wait.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rosbag/view.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/ros/particle_bag.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros/ros_test_support.h"
#include "simulation.h"

namespace particle_surface_tracker::simulator {
namespace {

using test::read_file;
using test::TemporaryFolder;
using ::testing::HasSubstr;

struct Outcome {
  int code;
  std::string err;
};

// Runs with these arguments; @ stands for the folder.
Outcome run(const TemporaryFolder& folder, const std::string& arguments) {
  std::string command = "'" PST_MAKE_SIMULATION_BAG "' --quiet " + arguments + " 2>@/stderr";
  for (std::size_t at = command.find('@'); at != std::string::npos; at = command.find('@')) {
    command.replace(at, 1, folder.path().string());
  }
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder / "stderr")};
}

SimulationSettings few_frames() {
  SimulationSettings settings;
  settings.parameters.spacing = 0.06;
  settings.parameters.viscosity = 0.3;
  settings.frames = 3;
  settings.start_time = 7.25;
  settings.frame_id = "tank";
  return settings;
}

const char* const few_frames_arguments =
    " --bag @/s.bag --mesh-out @/s.ply --topic /drops --spacing 0.06 --viscosity 0.3 --frames 3 --start-time 7.25 "
    "--frame-id tank";

TEST(MakeSimulationBag, HasTheCloudsOfTheSimulation) {
  const TemporaryFolder folder;
  const Outcome outcome = run(folder, few_frames_arguments);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  Simulation simulation(few_frames());
  rosbag::Bag bag(folder / "s.bag");
  rosbag::View view(bag, rosbag::TopicQuery("/drops"));
  ASSERT_EQ(view.size(), 3U);
  for (const rosbag::MessageInstance& message : view) {
    const auto cloud = message.instantiate<sensor_msgs::PointCloud2>();
    ASSERT_TRUE(cloud);
    EXPECT_EQ(cloud->data, simulation.cloud()->data);
    EXPECT_EQ(cloud->header.frame_id, "tank");
    EXPECT_EQ(message.getTime(), cloud->header.stamp);
    EXPECT_NEAR(cloud->header.stamp.toSec(), 7.25 + simulation.frame() / 60.0, 1e-9);
    simulation.advance();
  }
  EXPECT_FALSE(simulation.advance()) << "the simulation has no more frames than the bag";
}

TEST(MakeSimulationBag, TheTrackersReaderReadsIt) {
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder, few_frames_arguments).code, 0);
  ParticleBag bag(folder / "s.bag", "/drops");
  const ParticleFrame first = to_particle_frame(*bag.read(0));
  const ParticleFrame last = to_particle_frame(*bag.read(2));
  EXPECT_EQ(first.ids, last.ids);
  EXPECT_NEAR(estimate_particle_spacing(first), 0.06, 1e-5);
  // Two frames of free fall: an id is the same particle in both.
  const double fallen = 0.5 * 9.81 / 900.0;
  for (std::size_t i = 0; i < first.size(); ++i) {
    const Vec3d moved = (last.positions[i] - first.positions[i]).cast<double>();
    ASSERT_LT((moved + Vec3d(0.0, 0.0, fallen)).norm(), 1e-5);
  }
}

TEST(MakeSimulationBag, WritesTheMeshOfTheFirstFrame) {
  const TemporaryFolder folder;
  ASSERT_EQ(run(folder, few_frames_arguments).code, 0);
  const TriangleMesh mesh = read_initial_mesh(folder / "s.ply").mesh;
  EXPECT_EQ(mesh.positions(), Simulation(few_frames()).scene().mesh.positions());
}

TEST(MakeSimulationBag, CanWriteTheMeshAlone) {
  const TemporaryFolder folder;
  EXPECT_EQ(run(folder, "--mesh-out @/s.ply").code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder / "s.ply"));
  EXPECT_EQ(run(folder, "").code, 1) << "nothing to write";
}

TEST(MakeSimulationBag, SaysWhatIsWrongWithItsOptions) {
  const TemporaryFolder folder;
  const auto expect_usage_error = [&](const std::string& arguments, const std::string& text) {
    const Outcome outcome = run(folder, "--bag @/s.bag " + arguments);
    EXPECT_EQ(outcome.code, 1) << arguments;
    EXPECT_THAT(outcome.err, HasSubstr(text));
    EXPECT_FALSE(std::filesystem::exists(folder / "s.bag"));
  };
  expect_usage_error("--frames 0", "frames is 0");
  expect_usage_error("--start-time 0", "start_time is 0 s");
  expect_usage_error("--start-time nan", "start_time is nan s");
  expect_usage_error("--frame-id ''", "frame_id is empty");
  expect_usage_error("--spacing 1", "spacing is 1 m");
  expect_usage_error("--viscosity -1", "viscosity is -1 m^2/s");
  expect_usage_error("--viscosity thick", "viscosity");
  expect_usage_error("--colour red", "--colour");
}

TEST(MakeSimulationBag, SaysWhatCannotBeSimulatedOrWritten) {
  const TemporaryFolder folder;
  const Outcome wild = run(folder, "--bag @/s.bag --spacing 0.06 --gravity 1000 --frame-interval 1");
  EXPECT_EQ(wild.code, 3);
  EXPECT_THAT(wild.err, HasSubstr("more than 1000 substeps"));
  const Outcome nowhere = run(folder, "--bag @/missing/s.bag --spacing 0.06 --frames 1");
  EXPECT_EQ(nowhere.code, 4);
  EXPECT_THAT(nowhere.err, HasSubstr("/missing/s.bag"));
}

}  // namespace
}  // namespace particle_surface_tracker::simulator
