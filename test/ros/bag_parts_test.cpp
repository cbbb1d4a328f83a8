#include "ros/bag_parts.h"

#include <filesystem>

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

namespace fs = std::filesystem;

constexpr int kFrames = 9;

// The stamps go back once, and one comes twice: what is joined has the order of writing, not of the stamps.
sensor_msgs::PointCloud2ConstPtr cloud_of(int n) {
  ParticleFrame frame = numbered_frame(n, 4);
  if (n >= 6) frame.stamp_ns = numbered_frame(n - 4, 4).stamp_ns;
  if (n == 2) frame.stamp_ns = numbered_frame(1, 4).stamp_ns;
  return boost::make_shared<sensor_msgs::PointCloud2>(to_point_cloud(frame, "tank"));
}

// Large enough for some chunks of the bag.
TrackedMesh mesh_of(int n) {
  const TriangleMesh ball = make_sphere(Vec3d(n, 0, 0), 1.0, 5);
  return to_tracked_mesh(cloud_of(n)->header, ball, static_cast<std::uint32_t>(n));
}

template <typename Writer>
void write(Writer& writer, int begin, int end) {
  for (int n = begin; n < end; ++n) writer.write(cloud_of(n), mesh_of(n));
}

class BagPartsTest : public testing::Test {
 protected:
  BagPartsTest() {
    TrackingBagWriter whole(folder_ / "whole.bag", "/particles");
    write(whole, 0, kFrames);
    whole.close();
  }

  void expect_whole() const { EXPECT_TRUE(read_file(folder_ / "a.bag") == read_file(folder_ / "whole.bag")); }
  std::string part(const std::string& name) const { return folder_ / ("a.bag.parts/" + name); }

  TemporaryFolder folder_;
};

TEST_F(BagPartsTest, JoinedTheyAreTheBagWrittenInOneGo) {
  BagParts parts(folder_ / "a.bag", "/particles", {});
  write(parts, 0, 2);
  EXPECT_EQ(parts.end_part().parts, 1u);
  EXPECT_EQ(parts.end_part().parts, 1u) << "nothing was written between";
  EXPECT_TRUE(fs::exists(part("part_000000.bag")));
  write(parts, 2, 7);
  EXPECT_EQ(parts.end_part().parts, 2u);
  write(parts, 7, kFrames);
  const BagProgress progress = parts.join();
  EXPECT_TRUE(progress.has_whole);
  EXPECT_EQ(progress.parts, 0u);
  expect_whole();
  EXPECT_TRUE(fs::exists(part("part_000002.bag"))) << "a checkpoint may still refer to it";
  parts.remove_parts();
  EXPECT_FALSE(fs::exists(folder_ / "a.bag.parts"));
}

TEST_F(BagPartsTest, WhatWasWrittenAfterTheCheckpointIsWrittenAgain) {
  BagProgress kept;
  {
    BagParts parts(folder_ / "a.bag", "/particles", {});
    write(parts, 0, 3);
    kept = parts.end_part();
    write(parts, 3, 5);
    parts.end_part();
    write(parts, 5, 6);
  }
  BagParts parts(folder_ / "a.bag", "/particles", kept);
  EXPECT_FALSE(fs::exists(part("part_000002.bag")));
  write(parts, 3, kFrames);
  parts.join();
  expect_whole();
}

TEST_F(BagPartsTest, AWholeBagCanBeGoneOnWith) {
  BagProgress progress;
  {
    BagParts parts(folder_ / "a.bag", "/particles", {});
    write(parts, 0, 4);
    progress = parts.join();
    parts.remove_parts();
  }
  BagParts parts(folder_ / "a.bag", "/particles", progress);
  write(parts, 4, kFrames);
  parts.join();
  expect_whole();
}

TEST_F(BagPartsTest, WithoutFramesThereIsNoBag) {
  BagParts parts(folder_ / "a.bag", "/particles", {});
  EXPECT_FALSE(parts.join().has_whole);
  parts.remove_parts();
  EXPECT_FALSE(fs::exists(folder_ / "a.bag"));
  EXPECT_FALSE(fs::exists(folder_ / "a.bag.parts"));
}

TEST_F(BagPartsTest, MissingAndDamagedPartsAreSaid) {
  const auto open = [this](const BagProgress& from) { BagParts(folder_ / "a.bag", "/particles", from); };
  EXPECT_NE(error_of<InputError>([&] { open({true, 0}); }).find("a.bag"), std::string::npos);
  EXPECT_NE(error_of<InputError>([&] { open({false, 1}); }).find("part_000000.bag"), std::string::npos);
  write_file(folder_ / "file", "x");
  EXPECT_THROW(BagParts(folder_ / "file/a.bag", "/particles", {}), OutputError);

  BagParts parts(folder_ / "a.bag", "/particles", {});
  write(parts, 0, 3);
  parts.end_part();
  const std::string bytes = read_file(part("part_000000.bag"));
  write_file(part("part_000000.bag"), bytes.substr(0, bytes.size() / 2));
  EXPECT_NE(error_of<InputError>([&] { parts.join(); }).find("part_000000.bag"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "a.bag")) << "half a bag";
}

TEST_F(BagPartsTest, OtherFilesInTheFolderStay) {
  fs::create_directory(folder_ / "a.bag.parts");
  write_file(part("notes.txt"), "x");
  write_file(part("part_000007.bag"), "of an older run");
  BagParts parts(folder_ / "a.bag", "/particles", {});
  EXPECT_TRUE(fs::exists(part("notes.txt")));
  EXPECT_FALSE(fs::exists(part("part_000007.bag")));
}

}  // namespace
}  // namespace particle_surface_tracker::test
