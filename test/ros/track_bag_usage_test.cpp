// The program track_bag itself: options and input that it refuses, each with an exit code and one line that says why.

#include <gtest/gtest.h>

#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"
#include "support/shapes.h"
#include "track_bag_run.h"

namespace particle_surface_tracker::test {
namespace {

TEST_F(TrackBag, UsageErrors) {
  write_bag(3);
  expect_error(run(""), 1, {"--help"});
  expect_error(run("--bag @/in.bag --mesh implicit --out @/out"), 1, {"--spacing"});
  expect_error(run_standard("--nonsense"), 1, {"--nonsense"});
  expect_error(run_standard("stray"), 1, {"stray"});
  expect_error(run_standard("--format stl"), 1, {"--format", "stl"});
  expect_error(run_standard("--threads 0"), 1, {"--threads"});
  expect_error(run_standard("--first -1"), 1, {"--first"});
  expect_error(run_standard("--first 3"), 1, {"--first 3", "3 frames, 0 to 2"});
  expect_error(run_standard("--last 3"), 1, {"--last 3", "3 frames, 0 to 2"});
  expect_error(run_standard("--first 2 --last 1"), 1, {"--last 1", "--first 2"});
  expect_error(run_standard("--set tau"), 1, {"--set tau"});
  expect_error(run_standard("--set taau=1"), 1, {"taau"});
  expect_error(run_standard("--set tau=nan"), 1, {"tau", "nan"});
  expect_error(run_standard("--out-bag @/in.bag"), 1, {"same file"});
  for (const char* spacing : {"0", "-1", "nan", "inf", "abc", "1m", "''", "1e999"}) {
    expect_error(run(std::string("--bag @/in.bag --mesh implicit --out @/out --spacing ") + spacing), 1, {"--spacing"});
  }
}

TEST_F(TrackBag, SettingsAreAppliedAfterTheFile) {
  write_bag(1);
  write_file(folder_ / "p.yaml", "epsilon: 7\n");
  expect_error(run_standard("--config @/p.yaml"), 1, {"p.yaml", "line 1", "epsilon", "7"});
  write_file(folder_ / "p.yaml", "epsilon: 0.5\n");
  EXPECT_EQ(run_standard("--config @/p.yaml --set tau=0.4 --set advection=average").code, 0);
  expect_error(run_standard("--config @/p.yaml --set epsilon=9"), 1, {"epsilon", "9"});
  expect_error(run_standard("--config @/missing.yaml"), 2, {"missing.yaml"});
}

TEST_F(TrackBag, InputErrors) {
  expect_error(run_standard(), 2, {"in.bag", "No such file"});
  write_file(folder_ / "in.bag", "no bag");
  expect_error(run_standard(), 2, {"in.bag", "not a bag"});
  write_bag(2);
  expect_error(run_standard("--topic /other"), 2, {"/other", "/particles (sensor_msgs/PointCloud2)"});
  expect_error(run("--bag @/in.bag --mesh @/none.ply --spacing 0.2 --out @/out"), 2, {"none.ply"});
  write_file(folder_ / "bad.ply", "ply\nnot really");
  expect_error(run("--bag @/in.bag --mesh @/bad.ply --spacing 0.2 --out @/out"), 2, {"bad.ply"});
  write_bag(2, [](int n, sensor_msgs::PointCloud2& cloud) {
    if (n == 0) cloud = to_point_cloud(make_particle_frame(0, {}, {}), "world");
  });
  expect_error(run_standard(), 2, {"frame 0", "no particles", "--first"});
  write_bag(2, [](int, sensor_msgs::PointCloud2& cloud) { cloud.row_step += 1; });
  expect_error(run_standard(), 2, {"frame 0", "row_step"});
}

TEST_F(TrackBag, MeshAndParticlesThatDoNotBelongTogetherAreATrackingError) {
  write_bag(2);
  write_ply(folder_ / "ball.ply", make_sphere(Vec3d(0, 0, 50), 1.0, 3));
  expect_error(run_standard(), 3, {"frame 0", "246 r", "3 r"});
}

}  // namespace
}  // namespace particle_surface_tracker::test
