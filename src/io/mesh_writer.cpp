#include "particle_surface_tracker/io/mesh_writer.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <string_view>

#include <fmt/compile.h>
#include <fmt/format.h>

#include "color_bytes.h"
#include "file_bytes.h"

// No Debian library writes binary PLY with vertex properties of any name, so the few lines that it takes are here.

namespace particle_surface_tracker {
namespace {

static_assert(std::numeric_limits<float>::is_iec559, "PLY floats are IEEE 754");

/// One attribute as it lies in a vertex record.
struct Column {
  const VertexAttribute* attribute;
  bool as_bytes;  ///< Colours: one unsigned byte for each number.
};

std::vector<Column> columns_of(const TriangleMesh& mesh) {
  std::vector<Column> columns;
  for (std::size_t i = 0; i < mesh.attributes().count(); ++i) {
    const VertexAttribute& attribute = mesh.attributes()[i];
    if (attribute.use == AttributeUse::kOutput && attribute.name != TriangleMesh::delta_name) {
      columns.push_back({&attribute, attribute.name == TriangleMesh::color_name});
    }
  }
  // Colours and texture coordinates first, as the formats' readers know them; the others stay in their order.
  const auto rank = [](const Column& column) {
    if (column.attribute->name == TriangleMesh::color_name) return 0;
    return column.attribute->name == TriangleMesh::texcoord_name ? 1 : 2;
  };
  std::stable_sort(columns.begin(), columns.end(),
                   [&rank](const Column& a, const Column& b) { return rank(a) < rank(b); });
  return columns;
}

std::string property_name(const VertexAttribute& attribute, std::size_t component) {
  static constexpr const char* color_names[] = {"red", "green", "blue", "alpha"};
  static constexpr const char* texcoord_names[] = {"s", "t"};
  static constexpr const char* normal_names[] = {"nx", "ny", "nz"};
  if (attribute.name == TriangleMesh::color_name && component < std::size(color_names)) return color_names[component];
  if (attribute.name == TriangleMesh::texcoord_name && component < std::size(texcoord_names)) {
    return texcoord_names[component];
  }
  if (attribute.name == normal_attribute && component < std::size(normal_names)) return normal_names[component];
  return attribute.components == 1 ? attribute.name : fmt::format("{}_{}", attribute.name, component);
}

std::string ply_header(const TriangleMesh& mesh, const std::vector<Column>& columns) {
  std::string header = fmt::format(
      "ply\nformat binary_little_endian 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property float delta\nproperty uint id\n",
      mesh.vertex_count());
  for (const Column& column : columns) {
    for (std::size_t k = 0; k < column.attribute->components; ++k) {
      header +=
          fmt::format("property {} {}\n", column.as_bytes ? "uchar" : "float", property_name(*column.attribute, k));
    }
  }
  header += fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.triangle_count());
  return header;
}

/// Writes little-endian numbers one after the other into memory that is large enough.
class ByteSink {
 public:
  explicit ByteSink(char* begin) : at_(begin) {}
  void put(std::uint8_t value) { *at_++ = static_cast<char>(value); }
  void put(std::uint32_t value) {
    for (int shift = 0; shift < 32; shift += 8) put(static_cast<std::uint8_t>(value >> shift));
  }
  void put(float value) {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    put(bits);
  }

 private:
  char* at_;
};

/// The values of an attribute that OBJ has a place for; none if there is no such attribute of that many components.
const float* find_values(const VertexAttributes& attributes, const char* name, std::size_t components) {
  const std::size_t index = attributes.find(name);
  if (index == VertexAttributes::none || attributes[index].components != components) return nullptr;
  return attributes[index].values.data();
}

void append_obj_triangles(fmt::memory_buffer& text, const TriangleMesh& mesh, bool with_texcoords) {
  const auto out = std::back_inserter(text);
  for (const Triangle& t : mesh.triangles()) {
    const std::uint64_t a = t[0] + 1ULL, b = t[1] + 1ULL, c = t[2] + 1ULL;
    if (with_texcoords) {
      fmt::format_to(out, FMT_COMPILE("f {}/{} {}/{} {}/{}\n"), a, a, b, b, c, c);
    } else {
      fmt::format_to(out, FMT_COMPILE("f {} {} {}\n"), a, b, c);
    }
  }
}

}  // namespace

void write_ply(const std::string& path, const TriangleMesh& mesh) {
  const std::vector<Column> columns = columns_of(mesh);
  std::size_t vertex_size = 5 * sizeof(float);
  for (const Column& column : columns) vertex_size += column.attribute->components * (column.as_bytes ? 1 : 4);
  std::string bytes = ply_header(mesh, columns);
  const std::size_t header_size = bytes.size();
  constexpr std::size_t kTriangleSize = 1 + 3 * sizeof(std::uint32_t);
  bytes.resize(header_size + mesh.vertex_count() * vertex_size + mesh.triangle_count() * kTriangleSize);

  ByteSink sink(bytes.data() + header_size);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    for (const float coordinate : mesh.positions()[v]) sink.put(coordinate);
    sink.put(mesh.delta()[v]);
    sink.put(mesh.ids()[v]);
    for (const Column& column : columns) {
      const std::size_t components = column.attribute->components;
      for (std::size_t k = 0; k < components; ++k) {
        const float value = column.attribute->values[v * components + k];
        if (column.as_bytes) {
          sink.put(color_byte(value));
        } else {
          sink.put(value);
        }
      }
    }
  }
  for (const Triangle& triangle : mesh.triangles()) {
    sink.put(std::uint8_t{3});
    for (const std::uint32_t vertex : triangle) sink.put(vertex);
  }
  write_file_whole(path, bytes);
}

void write_obj(const std::string& path, const TriangleMesh& mesh) {
  const float* colors = find_values(mesh.attributes(), TriangleMesh::color_name, 4);
  const float* texcoords = find_values(mesh.attributes(), TriangleMesh::texcoord_name, 2);
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3f& p = mesh.positions()[v];
    fmt::format_to(out, FMT_COMPILE("v {:.9g} {:.9g} {:.9g}"), p.x(), p.y(), p.z());
    if (colors != nullptr) {
      const float* c = colors + 4 * v;
      fmt::format_to(out, FMT_COMPILE(" {:.9g} {:.9g} {:.9g}"), c[0], c[1], c[2]);
    }
    text.push_back('\n');
  }
  for (std::size_t v = 0; texcoords != nullptr && v < mesh.vertex_count(); ++v) {
    fmt::format_to(out, FMT_COMPILE("vt {:.9g} {:.9g}\n"), texcoords[2 * v], texcoords[2 * v + 1]);
  }
  append_obj_triangles(text, mesh, texcoords != nullptr);
  write_file_whole(path, std::string_view(text.data(), text.size()));
}

}  // namespace particle_surface_tracker
