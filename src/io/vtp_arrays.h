#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "base64.h"

namespace particle_surface_tracker {

static_assert(std::numeric_limits<float>::is_iec559, "VTK's floats are IEEE 754");
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the header says LittleEndian");

// Every array stands in its own element, as base64 after its size. All of them behind the XML (AppendedData) would be a
// quarter smaller, raw or not, but ParaView 5.11 with libexpat 2.5.0-1+deb12u5, Debian 12's, refuses such files: "junk
// after document element".

/// Appends the XML of an array of a VTK file.
/// \param type in VTK's words.
template <typename Number>
void append_vtp_array(std::string& xml, const char* type, const std::string& name, std::size_t components,
                      const std::vector<Number>& values) {
  const std::uint64_t size = values.size() * sizeof(Number);
  std::string bytes;
  bytes.reserve(sizeof(size) + size);
  bytes.append(reinterpret_cast<const char*>(&size), sizeof(size));
  bytes.append(reinterpret_cast<const char*>(values.data()), size);
  xml += fmt::format("<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"binary\">\n", type, name,
                     components);
  append_base64(xml, bytes);
  xml += "\n</DataArray>\n";
}

/// The whole file around a piece of XML.
inline std::string vtp_file(const std::string& piece) {
  return "<?xml version=\"1.0\"?>\n"
         "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
         "<PolyData>\n" +
         piece + "</PolyData>\n</VTKFile>\n";
}

}  // namespace particle_surface_tracker
