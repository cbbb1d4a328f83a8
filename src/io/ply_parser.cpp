#include <array>
#include <cstring>
#include <limits>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "mesh_soup.h"
#include "ply_header.h"
#include "text_scanner.h"

namespace particle_surface_tracker {
namespace {

/// Values of an ascii file.
class TextValues {
 public:
  explicit TextValues(std::string_view data) : scanner_(data) {}
  double next(PlyType type) {
    // A float must be rounded once, from its digits.
    return type == PlyType::kFloat32 ? static_cast<double>(scanner_.number<float>("a value"))
                                     : scanner_.number<double>("a value");
  }
  std::size_t remaining() const { return scanner_.remaining() + 1; }
  static std::size_t least_size(PlyType) { return 2; }

 private:
  TextScanner scanner_;
};

/// Values of a binary file.
class BinaryValues {
 public:
  BinaryValues(std::string_view data, bool big_endian) : data_(data), big_endian_(big_endian) {}

  double next(PlyType type) {
    const std::size_t size = ply_type_size(type);
    if (data_.size() < size) throw InputError("it ends early");
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t shift = 8 * (big_endian_ ? size - 1 - k : k);
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(data_[k])) << shift;
    }
    data_.remove_prefix(size);
    return to_value(bits, type);
  }

  std::size_t remaining() const { return data_.size(); }
  static std::size_t least_size(PlyType type) { return ply_type_size(type); }

 private:
  static double to_value(std::uint64_t bits, PlyType type) {
    switch (type) {
      case PlyType::kInt8:
        return static_cast<std::int8_t>(bits);
      case PlyType::kInt16:
        return static_cast<std::int16_t>(bits);
      case PlyType::kInt32:
        return static_cast<std::int32_t>(bits);
      case PlyType::kUint8:
      case PlyType::kUint16:
      case PlyType::kUint32:
        return static_cast<double>(bits);
      case PlyType::kFloat32: {
        const auto low_bits = static_cast<std::uint32_t>(bits);
        float value;
        std::memcpy(&value, &low_bits, sizeof(value));
        return value;
      }
      case PlyType::kFloat64:
        break;
    }
    double value;
    std::memcpy(&value, &bits, sizeof(value));
    return value;
  }

  std::string_view data_;
  bool big_endian_;
};

/// Where a property of a vertex goes.
enum class Role { kNone, kPosition, kColor, kTexcoord };

struct Destination {
  Role role = Role::kNone;
  std::size_t component = 0;
  double scale = 1.0;
};

Destination destination_of(const PlyProperty& property) {
  if (property.is_list) return {};
  const auto find = [&property](std::initializer_list<const char*> names) -> std::optional<std::size_t> {
    std::size_t index = 0;
    for (const char* name : names) {
      if (property.name == name) return index;
      ++index;
    }
    return std::nullopt;
  };
  if (const auto k = find({"x", "y", "z"})) return {Role::kPosition, *k};
  if (const auto k = find({"s", "t", "u", "v", "texture_u", "texture_v", "texture_s", "texture_t"})) {
    return {Role::kTexcoord, *k % 2};
  }
  if (const auto k = find({"red", "green", "blue", "alpha", "r", "g", "b", "a"})) {
    const double scale = property.type == PlyType::kUint8    ? 1.0 / 255.0
                         : property.type == PlyType::kUint16 ? 1.0 / 65535.0
                                                             : 1.0;
    return {Role::kColor, *k % 4, scale};
  }
  return {};
}

class PlyParser {
 public:
  explicit PlyParser(const PlyHeader& header) : header_(header) {}

  template <typename Values>
  MeshSoup parse(Values values) {
    for (const PlyElement& element : header_.elements) {
      check_size(element, values);
      try {
        if (element.name == "vertex") {
          read_vertices(element, values);
        } else if (element.name == "face") {
          read_faces(element, values);
        } else {
          skip(element, values);
        }
      } catch (const InputError& error) {
        throw InputError(fmt::format("element {} of {}: {}", element.name, element.count, error.what()));
      }
    }
    return std::move(soup_);
  }

 private:
  /// A count that cannot be true must not reserve memory.
  template <typename Values>
  static void check_size(const PlyElement& element, const Values& values) {
    std::size_t least = 0;
    for (const PlyProperty& property : element.properties) {
      least += Values::least_size(property.is_list ? property.count_type : property.type);
    }
    if (least > 0 && element.count <= values.remaining() / least) return;
    if (element.count == 0) return;
    throw InputError(fmt::format("it ends early: {} bytes are left for {} of element '{}'", values.remaining(),
                                 element.count, element.name));
  }

  template <typename Values>
  static std::size_t list_length(const PlyProperty& property, Values& values) {
    const double count = values.next(property.count_type);
    if (!(count >= 0.0)) throw InputError(fmt::format("a list '{}' of {} values", property.name, count));
    if (count > static_cast<double>(values.remaining())) throw InputError("it ends early");
    return static_cast<std::size_t>(count);
  }

  template <typename Values>
  static void skip(const PlyProperty& property, Values& values) {
    const std::size_t count = property.is_list ? list_length(property, values) : 1;
    for (std::size_t k = 0; k < count; ++k) values.next(property.type);
  }

  template <typename Values>
  static void skip(const PlyElement& element, Values& values) {
    for (std::uint64_t i = 0; i < element.count; ++i) {
      for (const PlyProperty& property : element.properties) skip(property, values);
    }
  }

  template <typename Values>
  void read_vertices(const PlyElement& element, Values& values) {
    std::vector<Destination> destinations;
    bool has_color = false, has_texcoord = false;
    std::array<bool, 3> has_coordinate = {};
    for (const PlyProperty& property : element.properties) {
      destinations.push_back(destination_of(property));
      const Destination& destination = destinations.back();
      has_color |= destination.role == Role::kColor;
      has_texcoord |= destination.role == Role::kTexcoord;
      if (destination.role == Role::kPosition) has_coordinate[destination.component] = true;
    }
    if (!has_coordinate[0] || !has_coordinate[1] || !has_coordinate[2]) {
      throw InputError("its vertices lack x, y or z");
    }
    soup_.positions.resize(element.count);
    if (has_color) soup_.colors.resize(element.count, {0.0F, 0.0F, 0.0F, 1.0F});
    if (has_texcoord) soup_.texcoords.resize(element.count, {0.0F, 0.0F});
    for (std::uint64_t v = 0; v < element.count; ++v) {
      for (std::size_t k = 0; k < destinations.size(); ++k) {
        read_vertex_property(element.properties[k], destinations[k], v, values);
      }
    }
  }

  template <typename Values>
  void read_vertex_property(const PlyProperty& property, const Destination& destination, std::size_t vertex,
                            Values& values) {
    switch (destination.role) {
      case Role::kNone:
        skip(property, values);
        return;
      case Role::kPosition:
        soup_.positions[vertex][static_cast<int>(destination.component)] =
            static_cast<float>(values.next(property.type));
        return;
      case Role::kColor:
        soup_.colors[vertex][destination.component] =
            static_cast<float>(values.next(property.type) * destination.scale);
        return;
      case Role::kTexcoord:
        soup_.texcoords[vertex][destination.component] = static_cast<float>(values.next(property.type));
        return;
    }
  }

  template <typename Values>
  void read_faces(const PlyElement& element, Values& values) {
    soup_.polygon_ends.reserve(element.count);
    soup_.corners.reserve(3 * element.count);
    for (std::uint64_t f = 0; f < element.count; ++f) {
      std::size_t texcoord_count = 0;
      const std::size_t first_corner = soup_.corners.size();
      for (const PlyProperty& property : element.properties) {
        if (property.is_list && (property.name == "vertex_indices" || property.name == "vertex_index")) {
          read_corners(property, values);
        } else if (property.is_list && property.name == "texcoord") {
          texcoord_count = read_corner_texcoords(property, values);
        } else {
          skip(property, values);
        }
      }
      soup_.polygon_ends.push_back(soup_.corners.size());
      align_corner_texcoords(first_corner, texcoord_count);
    }
  }

  template <typename Values>
  void read_corners(const PlyProperty& property, Values& values) {
    const std::size_t count = list_length(property, values);
    for (std::size_t k = 0; k < count; ++k) {
      const double index = values.next(property.type);
      // What is no index becomes one that no vertex has.
      const bool is_index = index >= 0.0 && index < 4294967295.0;
      soup_.corners.push_back(is_index ? static_cast<std::uint32_t>(index) : 0xffffffffU);
    }
  }

  template <typename Values>
  std::size_t read_corner_texcoords(const PlyProperty& property, Values& values) {
    const std::size_t count = list_length(property, values);
    face_texcoords_.resize(count);
    for (float& value : face_texcoords_) value = static_cast<float>(values.next(property.type));
    return count;
  }

  /// Keeps the texture coordinates of corners in step with the corners; faces without any get NaN.
  void align_corner_texcoords(std::size_t first_corner, std::size_t count) {
    constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
    if (count == 0 && soup_.corner_texcoords.empty()) return;
    soup_.corner_texcoords.resize(soup_.corners.size(), {kNaN, kNaN});
    for (std::size_t k = 0; 2 * k + 1 < count && first_corner + k < soup_.corners.size(); ++k) {
      soup_.corner_texcoords[first_corner + k] = {face_texcoords_[2 * k], face_texcoords_[2 * k + 1]};
    }
  }

  const PlyHeader& header_;
  MeshSoup soup_;
  std::vector<float> face_texcoords_;
};

}  // namespace

MeshSoup parse_ply(const std::string& content) {
  const PlyHeader header = parse_ply_header(content);
  const std::string_view data = std::string_view(content).substr(header.size);
  PlyParser parser(header);
  if (header.format == PlyFormat::kAscii) return parser.parse(TextValues(data));
  return parser.parse(BinaryValues(data, header.format == PlyFormat::kBigEndian));
}

}  // namespace particle_surface_tracker
