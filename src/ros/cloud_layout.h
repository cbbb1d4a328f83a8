#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <sensor_msgs/PointCloud2.h>

namespace particle_surface_tracker {

/// Where the numbers of a particle are in the bytes of a point.
struct CloudLayout {
  std::uint32_t position[3];
  std::uint32_t id;
  std::optional<std::uint32_t> velocity[3];  ///< All or none.
};

/// Checks everything that reading a cloud relies on: byte order, names, types, counts and offsets of the fields, point
/// and row steps, amount of data. Nothing of a cloud may be touched before.
/// \throw InputError that names field, value found and value wanted.
CloudLayout check_cloud_layout(const sensor_msgs::PointCloud2& cloud);

/// Name of a PointField datatype, or its number where it has no name.
std::string datatype_name(std::uint8_t datatype);

}  // namespace particle_surface_tracker
