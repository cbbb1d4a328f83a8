#include <array>
#include <limits>
#include <string_view>

#include <fmt/format.h>

#include "mesh_soup.h"
#include "text_scanner.h"

namespace particle_surface_tracker {
namespace {

using TexCoord = std::array<float, 2>;

constexpr TexCoord kNoTexCoord = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::quiet_NaN()};

/// Index into a list of `count`: OBJ counts from 1, or backwards from −1.
std::size_t resolve_index(std::string_view word, std::size_t count, const char* what) {
  const auto index = TextScanner::to_number<std::int64_t>(word, what);
  const std::int64_t resolved = index > 0 ? index - 1 : static_cast<std::int64_t>(count) + index;
  if (index == 0 || resolved < 0 || resolved >= static_cast<std::int64_t>(count)) {
    throw InputError(fmt::format("a face names {} {}, but {} are defined so far", what, index, count));
  }
  return static_cast<std::size_t>(resolved);
}

class ObjParser {
 public:
  MeshSoup parse(std::string_view text) {
    TextScanner lines(text, '#');
    while (lines.remaining() > 0) {
      ++line_number_;
      std::string line(lines.rest_of_line());
      while (lines.remaining() > 0 && !line.empty() && line.back() == '\\') {
        line.back() = ' ';
        line += lines.rest_of_line();
        ++line_number_;
      }
      try {
        parse_line(line);
      } catch (const InputError& error) {
        throw InputError(fmt::format("line {}: {}", line_number_, error.what()));
      }
    }
    // A vertex without a colour among coloured ones is white.
    if (!soup_.colors.empty()) soup_.colors.resize(soup_.positions.size(), {1.0F, 1.0F, 1.0F, 1.0F});
    if (texcoords_.empty()) soup_.corner_texcoords.clear();
    return std::move(soup_);
  }

 private:
  void parse_line(std::string_view line) {
    TextScanner words(line);
    const std::string_view keyword = words.word();
    if (keyword == "v") {
      parse_vertex(words);
    } else if (keyword == "vt") {
      const auto u = words.number<float>("a texture coordinate");
      texcoords_.push_back({u, words.at_end() ? 0.0F : words.number<float>("a texture coordinate")});
    } else if (keyword == "f") {
      parse_face(words);
    }
  }

  /// x y z; x y z w; x y z red green blue; x y z w red green blue.
  void parse_vertex(TextScanner& words) {
    std::array<float, 7> numbers = {};
    std::size_t count = 0;
    while (count < numbers.size() && (count < 3 || !words.at_end())) {
      numbers[count++] = words.number<float>("a coordinate");
    }
    soup_.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
    if (count < 6) return;
    const std::size_t red = count - 3;
    soup_.colors.resize(soup_.positions.size(), {1.0F, 1.0F, 1.0F, 1.0F});
    soup_.colors.back() = {numbers[red], numbers[red + 1], numbers[red + 2], 1.0F};
  }

  /// Corners are v, v/vt, v//vn or v/vt/vn.
  void parse_face(TextScanner& words) {
    for (std::string_view corner = words.word(); !corner.empty(); corner = words.word()) {
      const std::size_t slash = corner.find('/');
      const std::size_t vertex = resolve_index(corner.substr(0, slash), soup_.positions.size(), "vertex");
      soup_.corners.push_back(static_cast<std::uint32_t>(vertex));
      TexCoord texcoord = kNoTexCoord;
      if (slash != std::string_view::npos) {
        const std::string_view rest = corner.substr(slash + 1);
        const std::string_view index = rest.substr(0, rest.find('/'));
        if (!index.empty()) texcoord = texcoords_[resolve_index(index, texcoords_.size(), "texture coordinate")];
      }
      soup_.corner_texcoords.push_back(texcoord);
    }
    soup_.polygon_ends.push_back(soup_.corners.size());
  }

  MeshSoup soup_;
  std::vector<TexCoord> texcoords_;
  std::size_t line_number_ = 0;
};

}  // namespace

MeshSoup parse_obj(const std::string& content) {
  return ObjParser().parse(content);
}

}  // namespace particle_surface_tracker
