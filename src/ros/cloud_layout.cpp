#include "cloud_layout.h"

#include <array>
#include <limits>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

struct Datatype {
  std::uint8_t code;
  const char* name;
  std::uint64_t size;
};

constexpr std::array<Datatype, 8> datatypes = {{{PointField::INT8, "INT8", 1},
                                                {PointField::UINT8, "UINT8", 1},
                                                {PointField::INT16, "INT16", 2},
                                                {PointField::UINT16, "UINT16", 2},
                                                {PointField::INT32, "INT32", 4},
                                                {PointField::UINT32, "UINT32", 4},
                                                {PointField::FLOAT32, "FLOAT32", 4},
                                                {PointField::FLOAT64, "FLOAT64", 8}}};

const Datatype* find_datatype(std::uint8_t code) {
  for (const Datatype& datatype : datatypes) {
    if (datatype.code == code) return &datatype;
  }
  return nullptr;
}

// Bytes that a field takes; a field of an unknown type takes one, so that it still has a place.
std::uint64_t size_of(const PointField& field) {
  const Datatype* datatype = find_datatype(field.datatype);
  return datatype == nullptr ? 1 : datatype->size * field.count;
}

std::string list_of_fields(const PointCloud2& cloud) {
  std::string list;
  for (const PointField& field : cloud.fields) list += (list.empty() ? "" : " ") + field.name;
  return list.empty() ? "none" : list;
}

const PointField* find_field(const PointCloud2& cloud, const std::string& name) {
  const PointField* found = nullptr;
  for (const PointField& field : cloud.fields) {
    if (field.name != name) continue;
    if (found != nullptr) throw InputError(fmt::format("point cloud: field '{}' occurs twice", name));
    found = &field;
  }
  return found;
}

void check_place(const PointCloud2& cloud, const PointField& field) {
  const std::uint64_t end = field.offset + size_of(field);
  if (end > cloud.point_step) {
    throw InputError(fmt::format("point cloud: field '{}' takes bytes {} to {} of a point, but point_step is {}",
                                 field.name, field.offset, end - 1, cloud.point_step));
  }
  for (const PointField& other : cloud.fields) {
    if (&other == &field || size_of(other) == 0) continue;
    if (other.offset < end && field.offset < other.offset + size_of(other)) {
      throw InputError(fmt::format("point cloud: fields '{}' (offset {}) and '{}' (offset {}) overlap", field.name,
                                   field.offset, other.name, other.offset));
    }
  }
}

std::optional<std::uint32_t> checked_offset(const PointCloud2& cloud, const std::string& name, std::uint8_t datatype) {
  const PointField* field = find_field(cloud, name);
  if (field == nullptr) return std::nullopt;
  if (field->datatype != datatype) {
    throw InputError(fmt::format("point cloud: field '{}' has datatype {}, wanted {}", name,
                                 datatype_name(field->datatype), datatype_name(datatype)));
  }
  if (field->count != 1) {
    throw InputError(fmt::format("point cloud: field '{}' has count {}, wanted 1", name, field->count));
  }
  check_place(cloud, *field);
  return field->offset;
}

std::uint32_t required_offset(const PointCloud2& cloud, const std::string& name, std::uint8_t datatype) {
  const std::optional<std::uint32_t> offset = checked_offset(cloud, name, datatype);
  if (offset) return *offset;
  throw InputError(fmt::format("point cloud: field '{}' is missing, wanted {}; it has: {}", name,
                               datatype_name(datatype), list_of_fields(cloud)));
}

void check_sizes(const PointCloud2& cloud) {
  const std::uint64_t points = std::uint64_t{cloud.width} * cloud.height;
  if (points > std::numeric_limits<std::uint32_t>::max()) {
    throw InputError(fmt::format("point cloud: width {} × height {} are more points than can be numbered", cloud.width,
                                 cloud.height));
  }
  if (points == 0 && !cloud.data.empty()) {
    throw InputError(fmt::format("point cloud: width {} × height {} are no points, but it has {} bytes of data",
                                 cloud.width, cloud.height, cloud.data.size()));
  }
  const std::uint64_t row = std::uint64_t{cloud.width} * cloud.point_step;
  if (cloud.row_step < row) {
    throw InputError(fmt::format("point cloud: row_step is {}, wanted at least width {} × point_step {} = {}",
                                 cloud.row_step, cloud.width, cloud.point_step, row));
  }
  const std::uint64_t size = std::uint64_t{cloud.height} * cloud.row_step;
  if (points != 0 && cloud.data.size() != size) {
    throw InputError(fmt::format("point cloud: it has {} bytes of data, wanted height {} × row_step {} = {}",
                                 cloud.data.size(), cloud.height, cloud.row_step, size));
  }
}

void find_velocity(const PointCloud2& cloud, CloudLayout& layout) {
  const char* const names[] = {"vx", "vy", "vz"};
  int found = 0;
  for (int axis = 0; axis < 3; ++axis) {
    layout.velocity[axis] = checked_offset(cloud, names[axis], PointField::FLOAT32);
    if (layout.velocity[axis]) ++found;
  }
  if (found == 1 || found == 2) {
    throw InputError(fmt::format("point cloud: of vx vy vz it has {}, wanted all three or none; it has: {}", found,
                                 list_of_fields(cloud)));
  }
}

}  // namespace

CloudLayout check_cloud_layout(const PointCloud2& cloud) {
  if (cloud.is_bigendian) throw InputError("point cloud: is_bigendian is true, wanted little-endian data");
  CloudLayout layout{};
  layout.position[0] = required_offset(cloud, "x", PointField::FLOAT32);
  layout.position[1] = required_offset(cloud, "y", PointField::FLOAT32);
  layout.position[2] = required_offset(cloud, "z", PointField::FLOAT32);
  layout.id = required_offset(cloud, "id", PointField::UINT32);
  find_velocity(cloud, layout);
  check_sizes(cloud);
  return layout;
}

std::string datatype_name(std::uint8_t datatype) {
  const Datatype* known = find_datatype(datatype);
  return known == nullptr ? fmt::format("{} (unknown)", datatype) : known->name;
}

}  // namespace particle_surface_tracker
