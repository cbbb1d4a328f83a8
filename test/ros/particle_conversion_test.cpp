#include "particle_surface_tracker/ros/particle_conversion.h"

#include <cstring>
#include <functional>
#include <limits>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "ros_test_support.h"

namespace particle_surface_tracker::test {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

PointCloud2 good_cloud() {
  return to_point_cloud(numbered_frame(3, 5), "world");
}

PointField& field(PointCloud2& cloud, const std::string& name) {
  for (PointField& candidate : cloud.fields) {
    if (candidate.name == name) return candidate;
  }
  throw std::logic_error("no field " + name);
}

void remove_field(PointCloud2& cloud, const std::string& name) {
  cloud.fields.erase(cloud.fields.begin() + (&field(cloud, name) - cloud.fields.data()));
}

void set_float(PointCloud2& cloud, std::size_t point, std::uint32_t offset, float value) {
  std::memcpy(&cloud.data[point * cloud.point_step + offset], &value, sizeof value);
}

TEST(ParticleConversion, RoundTripKeepsEveryBit) {
  const ParticleFrame frame = numbered_frame(3, 5);
  const PointCloud2 cloud = to_point_cloud(frame, "world");
  EXPECT_EQ(cloud.header.frame_id, "world");
  EXPECT_EQ(cloud.header.stamp, ros::Time(1000, 375000000));
  EXPECT_EQ(cloud.point_step, 28u);
  EXPECT_TRUE(is_numbered_frame(cloud, 3, 5));
}

TEST(ParticleConversion, VelocitiesMayBeAbsent) {
  ParticleFrame frame = numbered_frame(3, 5);
  frame.velocities.clear();
  const PointCloud2 cloud = to_point_cloud(frame, "world");
  EXPECT_EQ(cloud.point_step, 16u);
  const ParticleFrame read = to_particle_frame(cloud);
  EXPECT_TRUE(read.velocities.empty());
  EXPECT_EQ(read.positions, frame.positions);
}

TEST(ParticleConversion, RowsMayBePaddedAndFieldsInAnyOrder) {
  // Two rows of two points; id first, a field that nobody asked for, rows of 2 · 21 + 5 bytes.
  PointCloud2 cloud;
  cloud.width = 2;
  cloud.height = 2;
  cloud.point_step = 21;
  cloud.row_step = 47;
  cloud.data.assign(2 * 47, 0xff);
  const auto add = [&cloud](const char* name, std::uint32_t offset, std::uint8_t datatype) {
    PointField added;
    added.name = name;
    added.offset = offset;
    added.datatype = datatype;
    added.count = 1;
    cloud.fields.push_back(added);
  };
  add("id", 0, PointField::UINT32);
  add("kind", 4, PointField::UINT8);
  add("z", 5, PointField::FLOAT32);
  add("y", 9, PointField::FLOAT32);
  add("x", 13, PointField::FLOAT32);
  for (std::uint32_t n = 0; n < 4; ++n) {
    std::uint8_t* point = &cloud.data[(n / 2) * 47 + (n % 2) * 21];
    const std::uint32_t id = 40 - n;
    const float xyz[] = {1.0f + static_cast<float>(n), 2.0f, 3.0f};
    std::memcpy(point, &id, 4);
    std::memcpy(point + 13, &xyz[0], 4);
    std::memcpy(point + 9, &xyz[1], 4);
    std::memcpy(point + 5, &xyz[2], 4);
  }
  const ParticleFrame frame = to_particle_frame(cloud);
  EXPECT_EQ(frame.ids, (std::vector<std::uint32_t>{37, 38, 39, 40}));
  ASSERT_EQ(frame.size(), 4u);
  EXPECT_EQ(frame.positions[0], Vec3f(4, 2, 3));
  EXPECT_EQ(frame.positions[3], Vec3f(1, 2, 3));
}

TEST(ParticleConversion, CloudWithoutPointsIsAnEmptyFrame) {
  PointCloud2 bare;
  bare.header.stamp = ros::Time(5, 6);
  EXPECT_TRUE(to_particle_frame(bare).empty());
  EXPECT_EQ(to_particle_frame(bare).stamp_ns, 5000000006);
  EXPECT_TRUE(to_particle_frame(to_point_cloud(make_particle_frame(0, {}, {}), "world")).empty());
}

struct BadCloud {
  const char* name;
  std::function<void(PointCloud2&)> spoil;
  std::vector<const char*> words;  // That the error must contain.
};

class BadClouds : public testing::TestWithParam<BadCloud> {};

TEST_P(BadClouds, AreRefusedWithFieldAndValues) {
  PointCloud2 cloud = good_cloud();
  GetParam().spoil(cloud);
  const std::string text = error_of<InputError>([&cloud] { to_particle_frame(cloud); });
  for (const char* word : GetParam().words) EXPECT_NE(text.find(word), std::string::npos) << word << " in: " << text;
}

const BadCloud bad_clouds[] = {
    {"NoX", [](PointCloud2& c) { remove_field(c, "x"); }, {"'x'", "missing", "FLOAT32", "y z id"}},
    {"NoId", [](PointCloud2& c) { remove_field(c, "id"); }, {"'id'", "missing", "UINT32"}},
    {"NoFields", [](PointCloud2& c) { c.fields.clear(); }, {"'x'", "missing", "none"}},
    {"NoVy", [](PointCloud2& c) { remove_field(c, "vy"); }, {"vx vy vz", "2", "all three or none"}},
    {"DoubleX", [](PointCloud2& c) { field(c, "x").datatype = PointField::FLOAT64; }, {"'x'", "FLOAT64", "FLOAT32"}},
    {"FloatId", [](PointCloud2& c) { field(c, "id").datatype = PointField::FLOAT32; }, {"'id'", "FLOAT32", "UINT32"}},
    {"SignedId", [](PointCloud2& c) { field(c, "id").datatype = PointField::INT32; }, {"'id'", "INT32", "UINT32"}},
    {"UnknownType", [](PointCloud2& c) { field(c, "vz").datatype = 77; }, {"'vz'", "77", "FLOAT32"}},
    {"Count", [](PointCloud2& c) { field(c, "y").count = 3; }, {"'y'", "count 3", "wanted 1"}},
    {"CountZero", [](PointCloud2& c) { field(c, "y").count = 0; }, {"'y'", "count 0", "wanted 1"}},
    {"Twice", [](PointCloud2& c) { field(c, "vx").name = "x"; }, {"'x'", "twice"}},
    {"Same", [](PointCloud2& c) { field(c, "y").offset = 0; }, {"'x'", "'y'", "overlap"}},
    {"Overlap", [](PointCloud2& c) { field(c, "id").offset = 10; }, {"'z'", "'id'", "overlap", "10"}},
    {"OverlapByOther",
     [](PointCloud2& c) {
       PointField other = field(c, "x");
       other.name = "normal";
       other.offset = 2;
       c.fields.push_back(other);
     },
     {"'x'", "'normal'", "overlap"}},
    {"Beyond", [](PointCloud2& c) { field(c, "vz").offset = 25; }, {"'vz'", "25", "28", "point_step is 28"}},
    {"OffsetWraps", [](PointCloud2& c) { field(c, "vz").offset = 0xfffffffe; }, {"'vz'", "4294967294"}},
    {"PointStepSmall", [](PointCloud2& c) { c.point_step = 24; }, {"'vz'", "point_step is 24"}},
    {"PointStepZero", [](PointCloud2& c) { c.point_step = 0; }, {"'x'", "point_step is 0"}},
    {"PointStepLarge", [](PointCloud2& c) { c.point_step = 32; }, {"row_step is 140", "160"}},
    {"RowStepSmall", [](PointCloud2& c) { c.row_step = 139; }, {"row_step is 139", "140"}},
    {"RowStepZero", [](PointCloud2& c) { c.row_step = 0; }, {"row_step is 0", "140"}},
    {"RowStepLarge", [](PointCloud2& c) { c.row_step = 141; }, {"140 bytes", "141"}},
    {"Truncated", [](PointCloud2& c) { c.data.pop_back(); }, {"139 bytes", "140"}},
    {"TooMuchData", [](PointCloud2& c) { c.data.push_back(0); }, {"141 bytes", "140"}},
    {"NoData", [](PointCloud2& c) { c.data.clear(); }, {"0 bytes", "140"}},
    {"HeightZero", [](PointCloud2& c) { c.height = 0; }, {"height 0", "no points", "140 bytes"}},
    {"HeightTwo", [](PointCloud2& c) { c.height = 2; }, {"140 bytes", "height 2", "280"}},
    {"Overflow", [](PointCloud2& c) { c.width = c.height = 0x10000; }, {"65536", "more points"}},
    {"WidthOverflow", [](PointCloud2& c) { c.width = 0xffffffff; }, {"row_step", "4294967295"}},
    {"BigEndian", [](PointCloud2& c) { c.is_bigendian = true; }, {"is_bigendian", "little-endian"}},
};

INSTANTIATE_TEST_SUITE_P(All, BadClouds, testing::ValuesIn(bad_clouds),
                         [](const testing::TestParamInfo<BadCloud>& cloud) { return std::string(cloud.param.name); });

TEST(ParticleConversion, BadParticlesAreRefused) {
  const float bad_values[] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                              -std::numeric_limits<float>::infinity()};
  for (const float value : bad_values) {
    for (const std::uint32_t offset : {0u, 4u, 8u, 16u, 24u}) {
      PointCloud2 cloud = good_cloud();
      set_float(cloud, 2, offset, value);
      EXPECT_THROW(to_particle_frame(cloud), ParticleError) << value << " at " << offset;
    }
  }
  PointCloud2 cloud = good_cloud();
  std::memcpy(&cloud.data[cloud.point_step + 12], &cloud.data[12], 4);
  EXPECT_THROW(to_particle_frame(cloud), ParticleError);
}

}  // namespace
}  // namespace particle_surface_tracker::test
