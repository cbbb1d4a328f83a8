#include <array>
#include <string_view>

#include <fmt/format.h>

#include "mesh_soup.h"
#include "text_scanner.h"

namespace particle_surface_tracker {
namespace {

/// Words left on the line of a vertex after its coordinates: its colour and texture coordinates.
struct VertexLayout {
  bool has_texcoord = false, has_color = false, has_normal = false;
};

/// The first word is [ST][C][N]OFF. Files in four or n dimensions and binary ones are not meshes in space as others
/// are.
VertexLayout parse_keyword(std::string_view keyword) {
  VertexLayout layout;
  const auto take = [&keyword](std::string_view prefix) {
    if (keyword.substr(0, prefix.size()) != prefix) return false;
    keyword.remove_prefix(prefix.size());
    return true;
  };
  layout.has_texcoord = take("ST");
  layout.has_color = take("C");
  layout.has_normal = take("N");
  if (keyword != "OFF") throw InputError("its first word is not OFF, COFF, NOFF, STOFF or a combination of these");
  return layout;
}

/// Colours in files are whole numbers up to 255, or fractions.
std::array<float, 4> parse_color(TextScanner& line, std::size_t components) {
  std::array<float, 4> color = {0.0F, 0.0F, 0.0F, 1.0F};
  bool is_fraction = false;
  for (std::size_t k = 0; k < components; ++k) {
    const std::string_view word = line.word();
    is_fraction = is_fraction || word.find('.') != std::string_view::npos;
    color[k] = TextScanner::to_number<float>(word, "a colour");
  }
  if (is_fraction) return color;
  for (std::size_t k = 0; k < components; ++k) color[k] /= 255.0F;
  return color;
}

std::size_t count_words(std::string_view line) {
  TextScanner words(line);
  std::size_t count = 0;
  while (!words.word().empty()) ++count;
  return count;
}

void parse_vertex(TextScanner& file, const VertexLayout& layout, MeshSoup& soup) {
  Vec3f position;
  for (float& coordinate : position) coordinate = file.number<float>("a coordinate");
  soup.positions.push_back(position);
  if (!layout.has_texcoord && !layout.has_color && !layout.has_normal) return;

  const std::string_view rest = file.rest_of_line();
  TextScanner line(rest);
  std::size_t words = count_words(rest);
  if (layout.has_normal) {
    for (int k = 0; k < 3; ++k) line.number<float>("a normal");
    words -= 3;
  }
  if (layout.has_color) {
    const std::size_t components = words - (layout.has_texcoord ? 2 : 0) >= 4 ? 4 : 3;
    soup.colors.push_back(parse_color(line, components));
  }
  if (layout.has_texcoord) {
    const auto u = line.number<float>("a texture coordinate");
    soup.texcoords.push_back({u, line.number<float>("a texture coordinate")});
  }
}

}  // namespace

MeshSoup parse_off(const std::string& content) {
  TextScanner file(content, '#');
  const VertexLayout layout = parse_keyword(file.word());
  const auto vertex_count = file.number<std::uint32_t>("the number of vertices");
  const auto face_count = file.number<std::uint32_t>("the number of faces");
  file.number<std::uint32_t>("the number of edges");
  // Every number takes two characters at least; a count that cannot be true must not reserve memory.
  if (file.remaining() / 6 + 1 < vertex_count || file.remaining() / 2 + 1 < face_count) {
    throw InputError(fmt::format("it is too short for {} vertices and {} faces", vertex_count, face_count));
  }

  MeshSoup soup;
  soup.positions.reserve(vertex_count);
  for (std::uint32_t v = 0; v < vertex_count; ++v) parse_vertex(file, layout, soup);
  for (std::uint32_t f = 0; f < face_count; ++f) {
    const auto corner_count = file.number<std::uint32_t>("the number of a face's corners");
    for (std::uint32_t k = 0; k < corner_count; ++k) {
      soup.corners.push_back(file.number<std::uint32_t>("a vertex index"));
    }
    soup.polygon_ends.push_back(soup.corners.size());
    // Colours of faces.
    file.rest_of_line();
  }
  return soup;
}

}  // namespace particle_surface_tracker
