// Nodelets of a manager and a node that run in processes of their own.

#include <algorithm>
#include <memory>

#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <particle_surface_tracker/SaveMesh.h>

#include "particle_surface_tracker/io/mesh_reader.h"
#include "ros_live/live_node.h"
#include "ros_live/node_process.h"

namespace particle_surface_tracker::test {
namespace {

// The particles of the ball, to everyone.
class RunningNodesTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    publisher = ros::NodeHandle().advertise<sensor_msgs::PointCloud2>("particles", 100);
    // Those in the manager share a connection; the maker of surfaces is there when they reach who takes them.
    ASSERT_TRUE(wait_until([] {
      return publisher.getNumSubscribers() == 2 && connection_count("/manager", "/surfaces") == 1;
    })) << publisher.getNumSubscribers();
  }
  static void TearDownTestSuite() { publisher.shutdown(); }

  static ros::Publisher publisher;  // The manager is one subscriber, the node the other.
};

ros::Publisher RunningNodesTest::publisher;

/// \param spacing 0: it is estimated.
FrameHandler offline_handler(AdvectionMethod advection, double spacing = 0.0) {
  FrameHandlerOptions options;
  options.estimate_spacing = spacing == 0.0;
  if (spacing > 0.0) options.parameters.particle_spacing = spacing;
  options.parameters.advection = advection;
  return FrameHandler(options);
}

TEST_F(RunningNodesTest, TrackEveryFrameAsTheFrameHandlerDoes) {
  Collector<TrackedMesh> one("/one/mesh");
  Collector<TrackedMesh> two("/two/mesh");
  Collector<TrackedMesh> alone("/alone/mesh");
  Collector<TrackedMesh> joining("/joining/mesh");
  Collector<TrackerStatus> statuses("/two/status");
  Collector<TrackerStatus> joining_statuses("/joining/status");
  ASSERT_TRUE(joining.wait_for_publisher());
  ASSERT_TRUE(joining_statuses.wait_for_publisher());
  ASSERT_TRUE(one.wait_for_publisher());
  ASSERT_TRUE(two.wait_for_publisher());
  ASSERT_TRUE(alone.wait_for_publisher());
  ASSERT_TRUE(statuses.wait_for_publisher());
  for (int n = 0; n < 5; ++n) publisher.publish(ball_cloud(n));
  ASSERT_EQ(one.wait_for(5).size(), 5u);
  ASSERT_EQ(two.wait_for(5).size(), 5u);
  ASSERT_EQ(alone.wait_for(5).size(), 5u);
  ASSERT_EQ(joining.wait_for(5).size(), 5u);
  ASSERT_EQ(statuses.wait_for(5).size(), 5u);
  ASSERT_EQ(joining_statuses.wait_for(5).size(), 5u);
  FrameHandler affine = offline_handler(AdvectionMethod::kAffine);
  FrameHandler average = offline_handler(AdvectionMethod::kAverage);
  FrameHandler given = offline_handler(AdvectionMethod::kAffine, kBallSpacing);
  for (int n = 0; n < 5; ++n) {
    affine.handle(*ball_cloud(n), static_cast<std::uint64_t>(n));
    average.handle(*ball_cloud(n), static_cast<std::uint64_t>(n));
    given.handle(*ball_cloud(n), static_cast<std::uint64_t>(n));
    const auto at = static_cast<std::size_t>(n);
    EXPECT_EQ(bytes_of(*one.wait_for(5)[at]), bytes_of(affine.message())) << n;
    EXPECT_EQ(bytes_of(*two.wait_for(5)[at]), bytes_of(average.message())) << n;
    EXPECT_EQ(bytes_of(*alone.wait_for(5)[at]), bytes_of(affine.message({true, false}))) << n;
    EXPECT_EQ(bytes_of(*joining.wait_for(5)[at]), bytes_of(given.message())) << n;
    EXPECT_EQ(statuses.wait_for(5)[at]->state, n == 0 ? TrackerStatus::STARTED : TrackerStatus::TRACKED);
  }
  EXPECT_EQ(joining_statuses.wait_for(5).back()->surfaces_joined, 4u);  // The first frame has none.
}

TEST_F(RunningNodesTest, LateSubscribersOfOtherProcessesGetTheLastMesh) {
  for (const char* topic : {"/one/mesh", "/two/mesh", "/alone/mesh"}) {
    Collector<TrackedMesh> meshes(topic);
    ASSERT_EQ(meshes.wait_for(1).size(), 1u) << topic;
    EXPECT_EQ(meshes.wait_for(1)[0]->header.stamp, ball_cloud(4)->header.stamp) << topic;
  }
}

TEST_F(RunningNodesTest, TheMeshIsSavedBelowTheFolder) {
  SaveMesh call;
  call.request.path = "running_nodes/ball.ply";
  ASSERT_TRUE(ros::service::call("/alone/save_mesh", call));
  ASSERT_TRUE(call.response.success) << call.response.message;
  Collector<TrackedMesh> meshes("/alone/mesh");
  ASSERT_EQ(meshes.wait_for(1).size(), 1u);
  EXPECT_EQ(3 * read_initial_mesh(call.response.path).mesh.vertex_count(), meshes.wait_for(1)[0]->vertices.size());
}

TEST_F(RunningNodesTest, DiagnosticsComeUnderTheNameOfEach) {
  Collector<diagnostic_msgs::DiagnosticArray> diagnostics("/diagnostics");
  for (const std::string name : {"one: input", "two: tracking", "alone: surface"}) {
    EXPECT_TRUE(wait_until([&] {
      const auto all = diagnostics.wait_for(0);
      return std::any_of(all.begin(), all.end(), [&](const auto& array) {
        return std::any_of(array->status.begin(), array->status.end(),
                           [&](const auto& status) { return status.name == name; });
      });
    })) << name;
  }
}

TEST_F(RunningNodesTest, ThoseThatCannotStartAreGone) {
  EXPECT_TRUE(wait_until([] {
    ros::master::V_TopicInfo topics;
    ros::master::getTopics(topics);
    return std::none_of(topics.begin(), topics.end(), [](const auto& topic) {
      return topic.name == "/bad_mesh/status" || topic.name == "/bad_parameter/status";
    });
  }));
  publisher.publish(ball_cloud(5));
  Collector<TrackerStatus> statuses("/one/status");
  ASSERT_TRUE(statuses.wait_for_publisher());
  publisher.publish(ball_cloud(6));
  EXPECT_GE(statuses.wait_for(1).size(), 1u);
}

}  // namespace
}  // namespace particle_surface_tracker::test
