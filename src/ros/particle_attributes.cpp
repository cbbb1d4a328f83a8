#include "particle_attributes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>

#include <fmt/format.h>

namespace particle_surface_tracker {
namespace {

using sensor_msgs::PointCloud2;
using sensor_msgs::PointField;

constexpr float kNone = std::numeric_limits<float>::quiet_NaN();

template <typename Number>
Number read(const std::uint8_t* bytes) {
  Number number;
  std::memcpy(&number, bytes, sizeof number);
  return number;
}

/// The points of a cloud in the order of their ids, so that sums do not depend on the order of the cloud.
std::vector<const std::uint8_t*> points_by_id(const PointCloud2& cloud) {
  const auto id = std::find_if(cloud.fields.begin(), cloud.fields.end(), [](const auto& f) { return f.name == "id"; });
  std::vector<const std::uint8_t*> points;
  if (id == cloud.fields.end()) return points;
  points.reserve(std::size_t{cloud.width} * cloud.height);
  for (std::uint32_t row = 0; row < cloud.height; ++row) {
    const std::uint8_t* point = cloud.data.data() + std::size_t{row} * cloud.row_step;
    for (std::uint32_t column = 0; column < cloud.width; ++column, point += cloud.point_step) points.push_back(point);
  }
  std::sort(points.begin(), points.end(), [offset = id->offset](const std::uint8_t* a, const std::uint8_t* b) {
    return read<std::uint32_t>(a + offset) < read<std::uint32_t>(b + offset);
  });
  return points;
}

/// A field that holds one value of one of some types, inside the point.
const PointField* find_field(const PointCloud2& cloud, const std::string& name,
                             const std::vector<std::uint8_t>& types) {
  for (const PointField& field : cloud.fields) {
    if (field.name != name || field.count != 1) continue;
    if (std::find(types.begin(), types.end(), field.datatype) == types.end()) continue;
    const std::uint64_t size = field.datatype == PointField::FLOAT64 ? 8 : 4;
    if (field.offset + size <= cloud.point_step) return &field;
  }
  return nullptr;
}

float finite(double value) {
  const auto number = static_cast<float>(value);
  return std::isfinite(number) ? number : kNone;
}

float scalar_at(const std::uint8_t* point, const PointField& field) {
  const std::uint8_t* bytes = point + field.offset;
  return finite(field.datatype == PointField::FLOAT64 ? read<double>(bytes) : double{read<float>(bytes)});
}

using Attribute = ParticleAttributes::Attribute;
using Points = std::vector<const std::uint8_t*>;

std::optional<Attribute> read_velocity(const PointCloud2& cloud, const Points& points) {
  Attribute attribute{"velocity", 3, {}};
  std::array<const PointField*, 3> axes{};
  int axis = 0;
  for (const char* name : {"vx", "vy", "vz"}) {
    axes[axis] = find_field(cloud, name, {PointField::FLOAT32});
    if (axes[axis++] == nullptr) return std::nullopt;
  }
  for (const std::uint8_t* point : points) {
    for (const PointField* field : axes) attribute.values.push_back(scalar_at(point, *field));
  }
  return attribute;
}

/// PCL packs colours as 0xAARRGGBB, into a float or an integer; alpha is of no use in `rgb`.
std::optional<Attribute> read_color(const PointCloud2& cloud, const std::string& name, const Points& points) {
  const PointField* field = find_field(cloud, name, {PointField::FLOAT32, PointField::UINT32, PointField::INT32});
  if (field == nullptr) return std::nullopt;
  Attribute attribute{name, 4, {}};
  for (const std::uint8_t* point : points) {
    const auto packed = read<std::uint32_t>(point + field->offset);
    for (const int shift : {16, 8, 0}) attribute.values.push_back(static_cast<float>((packed >> shift) & 255) / 255.0f);
    attribute.values.push_back(name == "rgba" ? static_cast<float>(packed >> 24) / 255.0f : 1.0f);
  }
  return attribute;
}

std::optional<Attribute> read_scalar(const PointCloud2& cloud, const std::string& name, const Points& points) {
  const PointField* field = find_field(cloud, name, {PointField::FLOAT32, PointField::FLOAT64});
  if (field == nullptr) return std::nullopt;
  Attribute attribute{name, 1, {}};
  for (const std::uint8_t* point : points) attribute.values.push_back(scalar_at(point, *field));
  return attribute;
}

std::string describe_wanted(const std::string& name) {
  if (name == "velocity") return "fields vx vy vz (FLOAT32)";
  if (name == "rgb" || name == "rgba") return fmt::format("a field {} (FLOAT32 or UINT32, packed)", name);
  return fmt::format("a field {} (FLOAT32 or FLOAT64, count 1)", name);
}

}  // namespace

ParticleAttributes read_particle_attributes(const PointCloud2& cloud, const std::vector<std::string>& names) {
  ParticleAttributes particles;
  const Points points = points_by_id(cloud);
  if (points.empty()) return particles;
  for (const std::string& name : names) {
    std::optional<Attribute> attribute = name == "velocity"                ? read_velocity(cloud, points)
                                         : name == "rgb" || name == "rgba" ? read_color(cloud, name, points)
                                                                           : read_scalar(cloud, name, points);
    if (attribute) {
      particles.attributes.push_back(std::move(*attribute));
    } else {
      particles.missing.push_back(
          fmt::format("'{}' is to be interpolated, but the particles have not {}", name, describe_wanted(name)));
    }
  }
  if (particles.attributes.empty()) return particles;
  std::array<const PointField*, 3> axes{};
  int axis = 0;
  for (const char* name : {"x", "y", "z"}) axes[axis++] = find_field(cloud, name, {PointField::FLOAT32});
  for (const std::uint8_t* point : points) {
    particles.positions.emplace_back(scalar_at(point, *axes[0]), scalar_at(point, *axes[1]),
                                     scalar_at(point, *axes[2]));
  }
  return particles;
}

}  // namespace particle_surface_tracker
