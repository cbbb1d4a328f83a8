// Whether it pays to make implicit surfaces beside the tracking: the nodelets ImplicitSurfaceNodelet and TrackerNodelet
// in one manager against TrackerNodelet alone, with the particles of a bag as fast as they are tracked. Needs a master:
// bench/overlap.

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <ctime>
#include <limits>
#include <string>
#include <thread>
#include <vector>

#include <nodelet/loader.h>
#include <particle_surface_tracker/TrackerStatus.h>
#include <ros/ros.h>
#include <sensor_msgs/PointCloud2.h>
#include <CLI/CLI.hpp>

#include "arrivals.h"
#include "particle_surface_tracker/ros/particle_bag.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "particle_surface_tracker/tracker/make_implicit_surface.h"

namespace particle_surface_tracker {
namespace {

struct Options {
  std::string bag;
  std::string topic = "/particles";
  std::string mesh = "implicit";
  double spacing = 0.0;
  std::size_t first = 0;
  std::size_t last = std::numeric_limits<std::size_t>::max();
  int runs = 3;
  int ahead = 4;
};

/// What a run took after its first frame, which is fitted and not tracked.
struct Cost {
  double wall = 0.0;  ///< [s] per frame.
  double cpu = 0.0;   ///< [s] per frame, all threads.
  std::uint64_t joined = 0;
};

using Clouds = std::vector<sensor_msgs::PointCloud2ConstPtr>;

/// Unpacked, so that bz2 is not measured.
Clouds read_clouds(const Options& options) {
  ParticleBag bag(options.bag, options.topic);
  Clouds clouds;
  for (std::size_t n = options.first; n < bag.size() && n <= options.last; ++n) clouds.push_back(bag.read(n));
  if (clouds.size() < 2) throw std::runtime_error("there are no two frames to track");
  return clouds;
}

/// Of all threads.
double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void load(nodelet::Loader& manager, const std::string& name, const std::string& type) {
  if (!manager.load(name, "particle_surface_tracker/" + type, {}, {}))
    throw std::runtime_error(type + " does not load");
}

Cost measure(const Options& options, const Clouds& clouds, bool with_maker) {
  ros::param::set("/tracker/mesh", options.mesh);
  ros::param::set("/tracker/spacing", options.spacing);
  ros::param::set("/tracker/surfaces", with_maker ? "surfaces" : "");
  ros::param::set("/tracker/surface_wait", 5.0);
  ros::param::set("/maker/spacing", options.spacing);
  ros::Publisher publisher = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("particles", 100);
  nodelet::Loader manager(/*provide_ros_api*/ false);
  load(manager, "/tracker", "TrackerNodelet");
  if (with_maker) load(manager, "/maker", "ImplicitSurfaceNodelet");
  // The subscribers of a process share one connection.
  while (publisher.getNumSubscribers() == 0) ros::WallDuration(0.01).sleep();

  Cost cost;
  Arrivals<TrackerStatus> statuses("/tracker/status");
  publisher.publish(clouds[0]);
  auto begin = statuses.wait_for(1);
  const double cpu_before = cpu_seconds();
  const int count = static_cast<int>(clouds.size());
  for (int sent = 1, answered = 1; answered < count; ++answered) {
    for (; sent < count && sent < answered + options.ahead; ++sent) publisher.publish(clouds[sent]);
    const auto end = statuses.wait_for(answered + 1);
    const auto status = statuses.last();
    if (status->frames_failed + status->frames_invalid != 0) throw std::runtime_error(status->reason);
    cost.wall = std::chrono::duration<double>(end - begin).count();
    cost.joined = status->surfaces_joined;
  }
  cost.cpu = cpu_seconds() - cpu_before;
  for (double* value : {&cost.wall, &cost.cpu}) *value /= count - 1;
  if (with_maker) manager.unload("/maker");
  manager.unload("/tracker");
  return cost;
}

/// What the maker makes, with all processors to itself: all that can be taken off the tracker.
Cost measure_surfaces(const Options& options, const Clouds& clouds) {
  Parameters parameters;
  parameters.particle_spacing = options.spacing;
  Cost cost;
  const double cpu_before = cpu_seconds();
  const auto begin = std::chrono::steady_clock::now();
  for (std::size_t n = 1; n < clouds.size(); ++n) make_implicit_surface(to_particle_frame(*clouds[n]), parameters);
  const double frames = static_cast<double>(clouds.size() - 1);
  cost.wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() / frames;
  cost.cpu = (cpu_seconds() - cpu_before) / frames;
  return cost;
}

template <typename Value>
double median(const std::vector<Cost>& costs, Value value) {
  std::vector<double> values;
  for (const Cost& cost : costs) values.push_back(value(cost));
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

void print(const char* what, const Cost& cost) {
  std::printf(
      "  %-18s %7.3f frames/s   %6.3f s of processor time a frame   %4.2f processors busy   %llu surfaces joined\n",
      what, 1.0 / cost.wall, cost.cpu, cost.cpu / cost.wall, static_cast<unsigned long long>(cost.joined));
  std::fflush(stdout);
}

Cost medians(const std::vector<Cost>& costs) {
  Cost cost;
  cost.wall = median(costs, [](const Cost& c) { return c.wall; });
  cost.cpu = median(costs, [](const Cost& c) { return c.cpu; });
  cost.joined = costs.back().joined;
  return cost;
}

void compare(const Options& options) {
  const Clouds clouds = read_clouds(options);
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  std::printf("%zu frames, %d runs in turn, %u processors\n", clouds.size(), options.runs, processors);
  std::vector<Cost> alone, both, surfaces;
  for (int run = 0; run < options.runs; ++run) {
    alone.push_back(measure(options, clouds, /*with_maker*/ false));
    print("tracker alone", alone.back());
    both.push_back(measure(options, clouds, /*with_maker*/ true));
    print("maker and tracker", both.back());
    surfaces.push_back(measure_surfaces(options, clouds));
    print("surfaces alone", surfaces.back());
  }
  const Cost one = medians(alone), two = medians(both), made = medians(surfaces);
  std::printf("medians:\n");
  print("tracker alone", one);
  print("maker and tracker", two);
  print("surfaces alone", made);
  const double share = std::max(made.wall / one.wall, made.cpu / one.cpu);
  std::printf("overlap: %.2f times the frames/s, %.2f times the processor time\n", one.wall / two.wall,
              two.cpu / one.cpu);
  std::printf(
      "what can go ahead is %.0f %% of a frame: %.0f %% of its wall time, %.0f %% of its processor time. So at most "
      "%.2f times the "
      "frames/s, where processors are free for it\n",
      100 * share, 100 * made.wall / one.wall, 100 * made.cpu / one.cpu, 1.0 / (1.0 - share));
}

}  // namespace
}  // namespace particle_surface_tracker

int main(int argc, char** argv) {
  using namespace particle_surface_tracker;
  ros::init(argc, argv, "overlap_benchmark");
  Options options;
  CLI::App app("Throughput of ImplicitSurfaceNodelet and TrackerNodelet in one manager against TrackerNodelet alone.",
               "overlap_benchmark");
  app.add_option("--bag", options.bag, "bag of particles")->required();
  app.add_option("--topic", options.topic, "topic of the particles")->capture_default_str();
  app.add_option("--mesh", options.mesh, "mesh of the first frame, or implicit")->capture_default_str();
  app.add_option("--spacing", options.spacing, "particle spacing r [m]")->required()->check(CLI::PositiveNumber);
  app.add_option("--first", options.first, "first frame")->capture_default_str();
  app.add_option("--last", options.last, "last frame (default: all)");
  app.add_option("--runs", options.runs, "runs of each")->check(CLI::PositiveNumber)->capture_default_str();
  app.add_option("--ahead", options.ahead, "frames on their way at once")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  ros::AsyncSpinner spinner(3);
  spinner.start();
  const ros::NodeHandle keeps_the_node_alive;
  try {
    compare(options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "overlap_benchmark: %s\n", error.what());
    return 1;
  }
  return 0;
}
