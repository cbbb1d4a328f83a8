// A bag that replay.launch plays to its nodelet, against track_bag on the same bag.

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <map>
#include <memory>

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/time_conversion.h"
#include "ros/ros_test_support.h"
#include "ros_live/counted_command.h"
#include "ros_live/live_node.h"

namespace particle_surface_tracker::test {
namespace {

using Meshes = std::map<std::int64_t, std::string>;  // Bytes by stamp.

struct Scene {
  std::string bag;
  std::string mesh;
  std::string spacing;
};

Meshes track_offline(const Scene& scene, const TemporaryFolder& folder) {
  const std::string command = "'" PST_TRACK_BAG "' --quiet --format none --out '" + folder / "out" + "' --bag '" +
                              scene.bag + "' --mesh '" + scene.mesh + "' --spacing " + scene.spacing + " --out-bag '" +
                              folder / "tracked.bag" + "'";
  const int status = std::system(command.c_str());
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) throw std::runtime_error("failed: " + command);
  Meshes meshes;
  const rosbag::Bag bag(folder / "tracked.bag");
  for (const rosbag::MessageInstance& message : rosbag::View(bag, rosbag::TopicQuery("/tracked_mesh"))) {
    const auto mesh = message.instantiate<TrackedMesh>();
    meshes[to_nanoseconds(mesh->header.stamp)] = bytes_of(*mesh);
  }
  return meshes;
}

// Every frame of the bag is tracked, and to the same bytes as by track_bag. Meshes that were published before the
// subscription of this program was through are not seen; the counters of the statuses tell of them too.
void expect_same_as_offline(const Scene& scene, const std::string& rate) {
  const TemporaryFolder folder;
  const Meshes wanted = track_offline(scene, folder);
  Collector<TrackedMesh> meshes("/tracker/mesh");
  Collector<TrackerStatus> statuses("/tracker/status");
  Command replay(launch("replay.launch",
                        {"bag:=" + scene.bag, "mesh:=" + scene.mesh, "spacing:=" + scene.spacing, "rate:=" + rate}));
  const auto is_last = [&] {
    const auto answers = statuses.wait_for(0);
    return !answers.empty() && to_nanoseconds(answers.back()->header.stamp) == wanted.rbegin()->first;
  };
  for (int minute = 0; minute < 8 && replay.running() && !is_last(); ++minute) wait_until(is_last);
  ASSERT_TRUE(is_last());
  const TrackerStatus last = *statuses.wait_for(0).back();
  EXPECT_EQ(last.run, 1u);
  EXPECT_EQ(last.frame, wanted.size() - 1);
  EXPECT_EQ(last.frames_received, wanted.size());
  EXPECT_EQ(last.frames_tracked, wanted.size());
  EXPECT_EQ(last.frames_missing, 0u);
  EXPECT_EQ(last.frames_skipped + last.frames_dropped + last.frames_invalid + last.frames_failed, 0u);

  const auto all_seen = [&] {
    const auto received = meshes.wait_for(0);
    return !received.empty() && to_nanoseconds(received.back()->header.stamp) == wanted.rbegin()->first;
  };
  ASSERT_TRUE(wait_until(all_seen));
  const auto received = meshes.wait_for(0);
  EXPECT_GT(2 * received.size(), wanted.size());
  std::size_t same = 0;
  for (const auto& mesh : received) same += bytes_of(*mesh) == wanted.at(to_nanoseconds(mesh->header.stamp)) ? 1 : 0;
  EXPECT_EQ(same, received.size());
  std::cout << same << " of " << wanted.size() << " meshes compared\n";
}

// A bag of the ball and its mesh.
Scene ball_scene(const TemporaryFolder& folder, int frames) {
  Scene scene{folder / "ball.bag", folder / "ball.ply", "0.2"};
  write_ply(scene.mesh, ball_mesh());
  rosbag::Bag bag(scene.bag, rosbag::bagmode::Write);
  for (int n = 0; n < frames; ++n) bag.write("/particles", ball_cloud(n)->header.stamp, ball_cloud(n));
  bag.close();
  return scene;
}

// Ten times as fast as recorded: the player has to wait for the tracker.
TEST(Replay, GivesTheMeshesOfTrackBag) {
  const TemporaryFolder folder;
  expect_same_as_offline(ball_scene(folder, 400), "10");
}

TEST(Replay, LoopedBagStartsAgainWithItsMesh) {
  const TemporaryFolder folder;
  const Scene scene = ball_scene(folder, 30);
  Collector<TrackerStatus> statuses("/tracker/status");
  Command replay(launch("replay.launch", {"bag:=" + scene.bag, "mesh:=" + scene.mesh, "spacing:=0.2", "loop:=true"}));
  ASSERT_TRUE(wait_until([&] {
    const auto answers = statuses.wait_for(0);
    return !answers.empty() && answers.back()->run == 3;
  }));
  std::uint32_t run = 1;
  for (const auto& status : statuses.wait_for(0)) {
    ASSERT_TRUE(status->state == TrackerStatus::STARTED || status->state == TrackerStatus::TRACKED) << status->reason;
    if (status->run == run) continue;
    EXPECT_EQ(status->run, run + 1);
    EXPECT_EQ(status->state, TrackerStatus::STARTED);
    EXPECT_EQ(status->header.stamp, ball_cloud(0)->header.stamp);
    EXPECT_EQ(status->frames_tracked, 30u * run + 1);
    run = status->run;
  }
}

TEST(Replay, MeltingBunnyGivesTheMeshesOfTrackBag) {
  const char* folder = std::getenv("PST_DATA_DIR");
  const std::string data = folder != nullptr ? folder : PST_DEFAULT_DATA_DIR;
  const Scene scene{data + "/melting_bunny.bag", data + "/melting_bunny.ply", "0.02964"};
  if (access(scene.bag.c_str(), R_OK) != 0) {
    GTEST_SKIP() << "no " << scene.bag << "; PST_DATA_DIR names the folder of the recorded sequences";
  }
  // Far faster than the tracker.
  expect_same_as_offline(scene, "10");
}

}  // namespace
}  // namespace particle_surface_tracker::test
