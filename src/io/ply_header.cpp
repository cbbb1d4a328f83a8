#include "ply_header.h"

#include "text_scanner.h"

namespace particle_surface_tracker {
namespace {

PlyType parse_type(std::string_view name) {
  if (name == "char" || name == "int8") return PlyType::kInt8;
  if (name == "uchar" || name == "uint8") return PlyType::kUint8;
  if (name == "short" || name == "int16") return PlyType::kInt16;
  if (name == "ushort" || name == "uint16") return PlyType::kUint16;
  if (name == "int" || name == "int32") return PlyType::kInt32;
  if (name == "uint" || name == "uint32") return PlyType::kUint32;
  if (name == "float" || name == "float32") return PlyType::kFloat32;
  if (name == "double" || name == "float64") return PlyType::kFloat64;
  throw InputError(fmt::format("'{}' is no PLY type", name.substr(0, 40)));
}

PlyFormat parse_format(std::string_view name) {
  if (name == "ascii") return PlyFormat::kAscii;
  if (name == "binary_little_endian") return PlyFormat::kLittleEndian;
  if (name == "binary_big_endian") return PlyFormat::kBigEndian;
  throw InputError(fmt::format("'{}' is no PLY format", name.substr(0, 40)));
}

PlyProperty parse_property(TextScanner& words) {
  PlyProperty property;
  std::string_view type = words.word();
  if (type == "list") {
    property.is_list = true;
    property.count_type = parse_type(words.word());
    type = words.word();
  }
  property.type = parse_type(type);
  property.name = words.word();
  return property;
}

}  // namespace

std::size_t ply_type_size(PlyType type) {
  switch (type) {
    case PlyType::kInt8:
    case PlyType::kUint8:
      return 1;
    case PlyType::kInt16:
    case PlyType::kUint16:
      return 2;
    case PlyType::kInt32:
    case PlyType::kUint32:
    case PlyType::kFloat32:
      return 4;
    case PlyType::kFloat64:
      break;
  }
  return 8;
}

PlyHeader parse_ply_header(std::string_view content) {
  PlyHeader header;
  TextScanner lines(content);
  bool has_format = false;
  lines.rest_of_line();
  while (lines.remaining() > 0) {
    const std::string_view line = lines.rest_of_line();
    TextScanner words(line);
    const std::string_view keyword = words.word();
    if (keyword == "format") {
      header.format = parse_format(words.word());
      has_format = true;
    } else if (keyword == "element") {
      PlyElement element;
      element.name = words.word();
      element.count = words.number<std::uint64_t>("the number of an element");
      header.elements.push_back(std::move(element));
    } else if (keyword == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(parse_property(words));
    } else if (keyword == "end_header") {
      if (!has_format) throw InputError("its header names no format");
      // Without the end of this line the data would begin in the middle of nowhere.
      if (lines.remaining() == 0 && content.back() != '\n') break;
      header.size = content.size() - lines.remaining();
      return header;
    } else if (keyword != "comment" && keyword != "obj_info" && !keyword.empty()) {
      throw InputError(fmt::format("its header has a line that PLY does not know: '{}'", line.substr(0, 60)));
    }
  }
  throw InputError("its header ends early: no end_header");
}

}  // namespace particle_surface_tracker
