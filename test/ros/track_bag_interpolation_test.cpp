// The program track_bag itself: fields of the particles in its bags and mesh files.

#include <cstring>
#include <vector>

#include <gtest/gtest.h>
#include <particle_surface_tracker/TrackedMesh.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "particle_surface_tracker/io/vtp_writer.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "ros_test_support.h"
#include "track_bag_run.h"

namespace particle_surface_tracker::test {
namespace {

/// Adds a field that is x of the particle.
void add_height(sensor_msgs::PointCloud2& cloud) {
  const std::vector<std::uint8_t> points = cloud.data;
  const std::uint32_t step = cloud.point_step;
  sensor_msgs::PointField field;
  field.name = "height";
  field.offset = step;
  field.datatype = sensor_msgs::PointField::FLOAT32;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step = step + 4;
  cloud.row_step = cloud.point_step * cloud.width;
  cloud.data.clear();
  for (std::size_t at = 0; at < points.size(); at += step) {
    const auto begin = points.begin() + static_cast<std::ptrdiff_t>(at);
    cloud.data.insert(cloud.data.end(), begin, begin + step);
    cloud.data.insert(cloud.data.end(), begin, begin + 4);  // The first number of a point is x.
  }
}

std::vector<TrackedMesh> meshes_of(const std::string& path) {
  rosbag::Bag bag(path);
  std::vector<TrackedMesh> meshes;
  for (const rosbag::MessageInstance& instance : rosbag::View(bag, rosbag::TopicQuery("/tracked_mesh"))) {
    meshes.push_back(*instance.instantiate<TrackedMesh>());
  }
  return meshes;
}

TEST_F(TrackBag, InterpolatedFieldsAreInBagsAndMeshFiles) {
  write_bag(3, [](int, sensor_msgs::PointCloud2& cloud) { add_height(cloud); });
  const Outcome outcome =
      run_standard("--interpolate height,velocity height --format vtp --out-bag @/out.bag --report @/report.jsonl");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("interpolation"), std::string::npos) << outcome.out;
  // These particles have no velocities, which is said once; the report has it of every frame.
  const std::string text = "'velocity' is to be interpolated, but the particles have not fields vx vy vz";
  EXPECT_NE(outcome.err.find("frame 0: " + text), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find(text), outcome.err.rfind(text)) << outcome.err;
  for (const Json& line : report()) EXPECT_EQ(line["warnings"].back().get<std::string>().rfind(text, 0), 0u);

  const std::vector<TrackedMesh> meshes = meshes_of(folder_ / "out.bag");
  ASSERT_EQ(meshes.size(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    ASSERT_EQ(meshes[n].interpolated.size(), 1u);
    const InterpolatedField& field = meshes[n].interpolated[0];
    EXPECT_EQ(field.name, "height");
    ASSERT_EQ(field.values.size(), meshes[n].ids.size());
    for (std::size_t v = 0; v < field.values.size(); ++v) {
      // The particles around a vertex lie on one side of it.
      ASSERT_NEAR(field.values[v], meshes[n].vertices[3 * v], 1.5 * r) << v;
    }
    // A mesh file is the message as export_meshes writes it.
    write_vtp(folder_ / "exported.vtp", to_mesh_with_fields(meshes[n]));
    const std::string file = read_file(folder_ / ("out/frame_00000" + std::to_string(n) + ".vtp"));
    EXPECT_EQ(file, read_file(folder_ / "exported.vtp")) << n;
    EXPECT_NE(file.find("Name=\"height\""), std::string::npos);
  }
}

TEST_F(TrackBag, InterpolationChangesNothingElseAndDependsOnNoThreads) {
  write_bag(3, [](int, sensor_msgs::PointCloud2& cloud) { add_height(cloud); });
  ASSERT_EQ(run_standard("--interpolate height --out-bag @/out.bag --threads 1").code, 0);
  std::vector<TrackedMesh> with = meshes_of(folder_ / "out.bag");
  ASSERT_EQ(run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/threads --interpolate height --threads 3").code,
            0);
  for (const std::string& name : files_in("out")) {
    EXPECT_EQ(read_file(folder_ / ("threads/" + name)), read_file(folder_ / ("out/" + name))) << name;
  }
  ASSERT_EQ(run_standard("--out-bag @/out.bag").code, 0);
  const std::vector<TrackedMesh> without = meshes_of(folder_ / "out.bag");
  ASSERT_EQ(with.size(), without.size());
  for (std::size_t n = 0; n < with.size(); ++n) {
    EXPECT_FALSE(with[n].interpolated.empty());
    with[n].interpolated.clear();
    EXPECT_TRUE(with[n] == without[n]) << n;
  }
}

TEST_F(TrackBag, InterpolateWantsNames) {
  write_bag(1);
  expect_error(run_standard("--interpolate ''"), 1, {"--interpolate"});
  expect_error(run_standard("--interpolate"), 1, {"--interpolate"});
}

}  // namespace
}  // namespace particle_surface_tracker::test
