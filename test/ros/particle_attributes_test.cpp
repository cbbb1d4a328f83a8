#include "ros/particle_attributes.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <gtest/gtest.h>

#include "particle_surface_tracker/ros/particle_conversion.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr double r = 0.1;

ParticleFrame block() {
  ParticleFrame frame = fill_with_particles(Vec3d::Zero(), Vec3d::Ones(), r, 0.2, 3, [](const Vec3d&) { return true; });
  for (const Vec3f& position : frame.positions) frame.velocities.push_back(Vec3f(1, 2, position.z()));
  return frame;
}

/// Adds a field whose bytes are those of a value for every particle.
template <typename Value, typename ValueAt>
PointCloud2 with_field(const PointCloud2& cloud, const std::string& name, std::uint8_t type, ValueAt&& value_at) {
  PointCloud2 wider = cloud;
  PointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = type;
  field.count = 1;
  wider.fields.push_back(field);
  wider.point_step += sizeof(Value);
  wider.row_step = wider.point_step * wider.width;
  wider.data.clear();
  for (std::uint32_t p = 0; p < cloud.width; ++p) {
    const std::uint8_t* point = &cloud.data[std::size_t{p} * cloud.point_step];
    wider.data.insert(wider.data.end(), point, point + cloud.point_step);
    const Value value = value_at(p);
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(&value);
    wider.data.insert(wider.data.end(), bytes, bytes + sizeof value);
  }
  return wider;
}

std::vector<Vec3f> middle() {
  return {{0.5f, 0.5f, 0.5f}};
}

TEST(ParticleAttributes, VelocityIsAMeanOfTheNeighbours) {
  const auto particles = read_particle_attributes(to_point_cloud(block(), "tank"), {"velocity"});
  EXPECT_TRUE(particles.missing.empty());
  const auto at = interpolate(particles, middle(), r);
  ASSERT_EQ(at.size(), 1u);
  EXPECT_EQ(at[0].name, "velocity");
  EXPECT_EQ(at[0].components, 3u);
  ASSERT_EQ(at[0].values.size(), 3u);
  EXPECT_NEAR(at[0].values[0], 1.0, 1e-6);
  EXPECT_NEAR(at[0].values[1], 2.0, 1e-6);
  EXPECT_NEAR(at[0].values[2], 0.5, 0.5 * r);
}

TEST(ParticleAttributes, ColoursAreUnpacked) {
  const PointCloud2 plain = to_point_cloud(block(), "tank");
  const auto color = [](std::uint32_t) { return std::uint32_t{0x80ff3300}; };
  const auto rgba =
      read_particle_attributes(with_field<std::uint32_t>(plain, "rgba", PointField::UINT32, color), {"rgba"});
  const auto rgb =
      read_particle_attributes(with_field<std::uint32_t>(plain, "rgb", PointField::FLOAT32, color), {"rgb"});
  const auto with_alpha = interpolate(rgba, middle(), r);
  const auto without = interpolate(rgb, middle(), r);
  ASSERT_EQ(with_alpha.size(), 1u);
  ASSERT_EQ(without.size(), 1u);
  const float wanted[] = {1.0f, 0.2f, 0.0f, 128.0f / 255.0f};
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_NEAR(with_alpha[0].values[n], wanted[n], 1e-6) << n;
    EXPECT_NEAR(without[0].values[n], n == 3 ? 1.0f : wanted[n], 1e-6) << n;
  }
}

TEST(ParticleAttributes, ScalarsOfBothTypesAreRead) {
  const PointCloud2 plain = to_point_cloud(block(), "tank");
  const PointCloud2 single = with_field<float>(plain, "heat", PointField::FLOAT32, [](auto) { return 4.0f; });
  const PointCloud2 both = with_field<double>(single, "age", PointField::FLOAT64, [](auto) { return 5.0; });
  const auto at = interpolate(read_particle_attributes(both, {"age", "heat"}), middle(), r);
  ASSERT_EQ(at.size(), 2u);
  EXPECT_EQ(at[0].name, "age");
  EXPECT_NEAR(at[0].values.at(0), 5.0, 1e-6);
  EXPECT_NEAR(at[1].values.at(0), 4.0, 1e-6);
}

TEST(ParticleAttributes, ValuesThatAreNotFiniteDoNotCount) {
  const PointCloud2 cloud =
      with_field<float>(to_point_cloud(block(), "tank"), "heat", PointField::FLOAT32,
                        [](std::uint32_t p) { return p % 2 == 0 ? std::numeric_limits<float>::infinity() : 4.0f; });
  const auto at = interpolate(read_particle_attributes(cloud, {"heat"}), middle(), r);
  EXPECT_NEAR(at.at(0).values.at(0), 4.0, 1e-6);
}

TEST(ParticleAttributes, FarFromAllParticlesTheNearestCounts) {
  const PointCloud2 cloud =
      with_field<float>(to_point_cloud(block(), "tank"), "heat", PointField::FLOAT32, [](auto) { return 4.0f; });
  const auto at = interpolate(read_particle_attributes(cloud, {"heat"}), {{50.0f, 0.0f, 0.0f}}, r);
  EXPECT_EQ(at.at(0).values.at(0), 4.0f);
}

TEST(ParticleAttributes, WhatTheParticlesDoNotHaveIsSaid) {
  ParticleFrame frame = block();
  frame.velocities.clear();
  PointCloud2 cloud = to_point_cloud(frame, "tank");
  const auto particles = read_particle_attributes(cloud, {"velocity", "rgb", "heat", "id"});
  EXPECT_TRUE(particles.attributes.empty());
  ASSERT_EQ(particles.missing.size(), 4u);
  EXPECT_NE(particles.missing[0].find("vx vy vz"), std::string::npos);
  EXPECT_NE(particles.missing[2].find("'heat'"), std::string::npos);
  EXPECT_TRUE(interpolate(particles, middle(), r).empty());
  // A field whose bytes would lie behind the point.
  cloud = with_field<float>(cloud, "heat", PointField::FLOAT32, [](auto) { return 4.0f; });
  cloud.fields.back().offset += 2;
  EXPECT_EQ(read_particle_attributes(cloud, {"heat"}).missing.size(), 1u);
}

TEST(ParticleAttributes, TheOrderOfTheCloudDoesNotMatter) {
  ParticleFrame frame = block();
  const PointCloud2 cloud = to_point_cloud(frame, "tank");
  PointCloud2 turned = cloud;
  for (std::uint32_t p = 0; p < cloud.width; ++p) {
    std::copy_n(&cloud.data[std::size_t{p} * cloud.point_step], cloud.point_step,
                &turned.data[std::size_t{cloud.width - 1 - p} * cloud.point_step]);
  }
  const std::vector<Vec3f> places = {{0.5f, 0.5f, 0.5f}, {0.1f, 0.9f, 0.3f}};
  EXPECT_EQ(interpolate(read_particle_attributes(cloud, {"velocity"}), places, r).at(0).values,
            interpolate(read_particle_attributes(turned, {"velocity"}), places, r).at(0).values);
}

}  // namespace
}  // namespace particle_surface_tracker::test
