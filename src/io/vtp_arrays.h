#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace particle_surface_tracker {

static_assert(std::numeric_limits<float>::is_iec559, "VTK's floats are IEEE 754");
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the header says LittleEndian");

/// Arrays of binary numbers behind the XML of a VTK file, each after its size, and the XML that tells where they are.
class VtpArrays {
 public:
  /// \param type in VTK's words.
  /// \return the element that stands for the array.
  template <typename Number>
  std::string add(const char* type, const std::string& name, std::size_t components,
                  const std::vector<Number>& values) {
    std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, bytes_.size());
    const std::uint64_t size = values.size() * sizeof(Number);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof(size));
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return element;
  }

  /// The whole file around a piece of XML.
  std::string file_around(const std::string& piece) const {
    return "<?xml version=\"1.0\"?>\n"
           "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n"
           "<PolyData>\n" +
           piece + "</PolyData>\n<AppendedData encoding=\"raw\">\n_" + bytes_ + "\n</AppendedData>\n</VTKFile>\n";
  }

 private:
  std::string bytes_;
};

}  // namespace particle_surface_tracker
