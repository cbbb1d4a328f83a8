#include <exception>

#include <ros/ros.h>

#include "particle_surface_tracker/core/error.h"
#include "simulator_node.h"

namespace {

enum ExitCode { kOk = 0, kUsage = 1, kSimulation = 3, kOutput = 4 };

ExitCode fail(ExitCode code, const std::exception& error) {
  ROS_FATAL_STREAM(error.what());
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  ros::init(argc, argv, "simulator");
  // ROS shuts down with its last handle, and would not print what fail() has to say.
  const ros::NodeHandle handle;
  try {
    particle_surface_tracker::simulator::SimulatorNode(handle, ros::NodeHandle("~")).run();
  } catch (const particle_surface_tracker::ParameterError& error) {
    return fail(kUsage, error);
  } catch (const particle_surface_tracker::OutputError& error) {
    return fail(kOutput, error);
  } catch (const std::exception& error) {
    return fail(kSimulation, error);
  }
  return kOk;
}
