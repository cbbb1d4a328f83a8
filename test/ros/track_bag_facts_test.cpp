// The program track_bag itself: what it finds out about surface, times and bag, in the report and at the end.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/io/mesh_writer.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "support/shapes.h"
#include "track_bag_run.h"

namespace particle_surface_tracker::test {
namespace {

constexpr double kRadius = 0.7;

/// Two balls of liquid that meet, and come apart again.
sensor_msgs::PointCloud2 two_balls(int n) {
  const ParticleFrame ball = fill_with_particles(-Vec3d::Ones(), Vec3d::Ones(), 0.2, 0.0, 0,
                                                 [](const Vec3d& x) { return x.norm() < kRadius - 0.05; });
  std::vector<Vec3f> positions;
  std::vector<std::uint32_t> ids;
  for (const int side : {-1, 1}) {
    const auto shift = static_cast<float>(side * (0.5 + 0.1 * std::abs(5 - n)));
    for (const Vec3f& position : ball.positions) {
      ids.push_back(static_cast<std::uint32_t>(ids.size()));
      positions.push_back(position + Vec3f(shift, 0, 0));
    }
  }
  return to_point_cloud(make_particle_frame(n * std::int64_t{10000000}, std::move(positions), std::move(ids)), "tank");
}

TEST_F(TrackBag, ChangesOfTopologyAreCounted) {
  write_bag(11, [](int n, sensor_msgs::PointCloud2& cloud) { cloud = two_balls(n); });
  write_ply(folder_ / "ball.ply",
            joined({make_sphere(Vec3d(-1, 0, 0), kRadius, 3), make_sphere(Vec3d(1, 0, 0), kRadius, 3)}));
  const Outcome outcome = run_standard("--report @/report.jsonl");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(report().size(), 11u);
  int splits = 0, merges = 0, gone = 0, cells = 0;
  for (const Json& line : report()) {
    splits += line["topology"]["splits"].get<int>();
    merges += line["topology"]["merges"].get<int>();
    gone += line["topology"]["gone"].get<int>();
    cells += line["topology"]["remeshed_cells"].get<int>();
  }
  EXPECT_EQ(report()[0]["components"], 2);
  EXPECT_EQ(report()[10]["components"], 2 + splits - merges - gone);
  EXPECT_GE(merges, 1);
  EXPECT_GE(splits, 1);
  EXPECT_NE(outcome.out.find(fmt::format("pieces: {} split off, {} merged, {} gone; {} re-meshed cells\n", splits,
                                         merges, gone, cells)),
            std::string::npos)
      << outcome.out;
}

TEST_F(TrackBag, WorstTriangleAndLongestFrameAreSaid) {
  write_bag(3);
  const Outcome outcome = run_standard("--report @/report.jsonl");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const auto lines = report();
  ASSERT_EQ(lines.size(), 3u);
  const auto angle = [](const Json& line) { return line["smallest_angle"].get<double>(); };
  const auto time = [](const Json& line) { return line["times"]["total"].get<double>(); };
  const auto worst =
      std::min_element(lines.begin(), lines.end(), [&](const Json& a, const Json& b) { return angle(a) < angle(b); });
  const auto longest =
      std::max_element(lines.begin(), lines.end(), [&](const Json& a, const Json& b) { return time(a) < time(b); });
  EXPECT_GT(angle(*worst), 0.0);
  EXPECT_LE(angle(*worst), 60.0);
  for (const std::string& text :
       {fmt::format("smallest angle of a triangle: {:.2f} deg, in frame {}\n", angle(*worst), worst - lines.begin()),
        fmt::format("longest frame: {}, {:.3f} s\n", longest - lines.begin(), time(*longest)),
        std::string(" x real time), ")}) {
    EXPECT_NE(outcome.out.find(text), std::string::npos) << text << outcome.out;
  }
  EXPECT_EQ(outcome.out.find("missing"), std::string::npos) << outcome.out;
}

TEST_F(TrackBag, GapsOfNumbersAreFound) {
  write_bag(5, [](int n, sensor_msgs::PointCloud2& cloud) {
    cloud.header.seq = static_cast<std::uint32_t>(n < 3 ? 10 + n : 12 + n);
    // What cannot be used is not missing.
    if (n == 1) cloud.data.pop_back();
  });
  const Outcome outcome = run_standard("--report @/report.jsonl");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(report().size(), 5u);
  for (const std::size_t n : {0, 2, 3, 4}) EXPECT_EQ(report()[n]["missing_frames"], n == 3 ? 2 : 0) << n;
  EXPECT_NE(outcome.err.find("frame 3: 2 frames are missing before it"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.out.find("2 frames are missing in the bag, in 1 gap\n"), std::string::npos) << outcome.out;
}

TEST_F(TrackBag, GapsOfStampsAndTimesThatStandStillAreFound) {
  write_bag(8, [](int n, sensor_msgs::PointCloud2& cloud) {
    // The stamps are every 10 ms; one is missing, and the last two are that of the frame before.
    if (n >= 5) cloud.header.stamp += ros::Duration(0, 10000000);
    if (n >= 6) cloud.header.stamp = ros::Time(1000, 60000000);
  });
  const Outcome outcome = run_standard("--report @/report.jsonl");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  ASSERT_EQ(report().size(), 8u);
  for (std::size_t n = 0; n < 8; ++n) EXPECT_EQ(report()[n]["missing_frames"], n == 5 ? 1 : 0) << n;
  EXPECT_NE(outcome.out.find("1 frame is missing in the bag, in 1 gap\n"), std::string::npos) << outcome.out;
  const std::string text = "its stamp is that of the frame before";
  EXPECT_EQ(report()[6]["warnings"].back(), text);
  EXPECT_EQ(report()[7]["warnings"].back(), text);
  EXPECT_NE(outcome.err.find("frame 6: " + text), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(text), outcome.err.rfind(text)) << outcome.err;
}

}  // namespace
}  // namespace particle_surface_tracker::test
