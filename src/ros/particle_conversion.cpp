#include "particle_surface_tracker/ros/particle_conversion.h"

#include <cstring>
#include <utility>
#include <vector>

#include "cloud_layout.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/time_conversion.h"

namespace particle_surface_tracker {
namespace {

template <typename Number>
Number read(const std::uint8_t* point, std::uint32_t offset) {
  Number number;
  std::memcpy(&number, point + offset, sizeof number);
  return number;
}

template <typename Number>
void append(std::vector<std::uint8_t>& data, const Number& number) {
  const auto* bytes = reinterpret_cast<const std::uint8_t*>(&number);
  data.insert(data.end(), bytes, bytes + sizeof number);
}

bool is_empty(const sensor_msgs::PointCloud2& cloud) {
  return std::uint64_t{cloud.width} * cloud.height == 0 && cloud.data.empty();
}

void add_field(sensor_msgs::PointCloud2& cloud, const char* name, std::uint8_t datatype) {
  sensor_msgs::PointField field;
  field.name = name;
  field.offset = cloud.point_step;
  field.datatype = datatype;
  field.count = 1;
  cloud.fields.push_back(field);
  cloud.point_step += 4;
}

}  // namespace

ParticleFrame to_particle_frame(const sensor_msgs::PointCloud2& cloud) {
  const std::int64_t stamp_ns = to_nanoseconds(cloud.header.stamp);
  // Many publishers leave out the fields of a cloud without points.
  if (is_empty(cloud)) return make_particle_frame(stamp_ns, {}, {});

  const CloudLayout layout = check_cloud_layout(cloud);
  const std::size_t count = std::size_t{cloud.width} * cloud.height;
  std::vector<Vec3f> positions(count);
  std::vector<std::uint32_t> ids(count);
  std::vector<Vec3f> velocities(layout.velocity[0] ? count : 0);
  std::size_t n = 0;
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    const std::uint8_t* point = cloud.data.data() + std::size_t{row} * cloud.row_step;
    for (std::uint32_t column = 0; column < cloud.width; ++column, ++n, point += cloud.point_step) {
      ids[n] = read<std::uint32_t>(point, layout.id);
      for (int axis = 0; axis < 3; ++axis) {
        positions[n][axis] = read<float>(point, layout.position[axis]);
        if (layout.velocity[axis]) velocities[n][axis] = read<float>(point, *layout.velocity[axis]);
      }
    }
  }
  return make_particle_frame(stamp_ns, std::move(positions), std::move(ids), std::move(velocities));
}

void check_particle_cloud(const sensor_msgs::PointCloud2& cloud) {
  if (!is_empty(cloud)) check_cloud_layout(cloud);
}

sensor_msgs::PointCloud2 to_point_cloud(const ParticleFrame& frame, const std::string& frame_id) {
  using sensor_msgs::PointField;
  sensor_msgs::PointCloud2 cloud;
  cloud.header.stamp = to_ros_time(frame.stamp_ns);
  cloud.header.frame_id = frame_id;
  cloud.height = 1;
  cloud.width = static_cast<std::uint32_t>(frame.size());
  cloud.is_dense = true;
  for (const char* name : {"x", "y", "z"}) add_field(cloud, name, PointField::FLOAT32);
  add_field(cloud, "id", PointField::UINT32);
  const bool has_velocities = !frame.velocities.empty();
  if (has_velocities) {
    for (const char* name : {"vx", "vy", "vz"}) add_field(cloud, name, PointField::FLOAT32);
  }
  cloud.row_step = cloud.width * cloud.point_step;
  cloud.data.reserve(cloud.row_step);
  for (std::size_t n = 0; n < frame.size(); ++n) {
    for (int axis = 0; axis < 3; ++axis) append(cloud.data, frame.positions[n][axis]);
    append(cloud.data, frame.ids[n]);
    for (int axis = 0; has_velocities && axis < 3; ++axis) append(cloud.data, frame.velocities[n][axis]);
  }
  return cloud;
}

}  // namespace particle_surface_tracker
