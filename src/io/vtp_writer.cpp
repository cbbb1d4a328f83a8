#include "particle_surface_tracker/io/vtp_writer.h"

#include <cstdint>
#include <cstring>
#include <limits>

#include <fmt/format.h>

#include "color_bytes.h"
#include "file_bytes.h"

// VTK itself would bring the development files of half a desktop for this page.

namespace particle_surface_tracker {
namespace {

static_assert(std::numeric_limits<float>::is_iec559, "VTK's floats are IEEE 754");
static_assert(__BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__, "the header says LittleEndian");

/// Arrays of binary numbers behind the XML, each after its size, and the XML that tells where they are.
class Appended {
 public:
  template <typename Number>
  std::string array(const char* type, const std::string& name, std::size_t components,
                    const std::vector<Number>& values) {
    std::string element = fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n", type,
        name, components, bytes_.size());
    const std::uint64_t size = values.size() * sizeof(Number);
    bytes_.append(reinterpret_cast<const char*>(&size), sizeof(size));
    bytes_.append(reinterpret_cast<const char*>(values.data()), size);
    return element;
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string attribute_array(Appended& appended, const VertexAttribute& attribute) {
  if (attribute.name != TriangleMesh::color_name) {
    return appended.array("Float32", attribute.name, attribute.components, attribute.values);
  }
  // As bytes ParaView takes them for colours.
  std::vector<std::uint8_t> bytes;
  bytes.reserve(attribute.values.size());
  for (const float value : attribute.values) bytes.push_back(color_byte(value));
  return appended.array("UInt8", attribute.name, attribute.components, bytes);
}

std::string point_data(Appended& appended, const TriangleMesh& mesh) {
  std::string xml = "<PointData Scalars=\"delta\">\n";
  for (std::size_t i = 0; i < mesh.attributes().count(); ++i) {
    const VertexAttribute& attribute = mesh.attributes()[i];
    if (attribute.use == AttributeUse::kOutput) xml += attribute_array(appended, attribute);
  }
  return xml + appended.array("UInt32", "id", 1, mesh.ids()) + "</PointData>\n";
}

std::string points(Appended& appended, const TriangleMesh& mesh) {
  std::vector<float> coordinates;
  coordinates.reserve(3 * mesh.vertex_count());
  for (const Vec3f& position : mesh.positions())
    coordinates.insert(coordinates.end(), position.begin(), position.end());
  return "<Points>\n" + appended.array("Float32", "Points", 3, coordinates) + "</Points>\n";
}

std::string polygons(Appended& appended, const TriangleMesh& mesh) {
  std::vector<std::int64_t> corners, ends;
  corners.reserve(3 * mesh.triangle_count());
  ends.reserve(mesh.triangle_count());
  for (const Triangle& triangle : mesh.triangles()) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }
  return "<Polys>\n" + appended.array("Int64", "connectivity", 1, corners) +
         appended.array("Int64", "offsets", 1, ends) + "</Polys>\n";
}

}  // namespace

void write_vtp(const std::string& path, const TriangleMesh& mesh) {
  Appended appended;
  std::string file =
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n<PolyData>\n";
  file +=
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n", mesh.vertex_count(), mesh.triangle_count());
  file += point_data(appended, mesh);
  file += points(appended, mesh);
  file += polygons(appended, mesh);
  file += "</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
  file += appended.bytes();
  file += "\n</AppendedData>\n</VTKFile>\n";
  write_file_whole(path, file);
}

void write_pvd(const std::string& path, const std::vector<TimedFile>& files) {
  std::string xml = "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const TimedFile& file : files) {
    xml += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", file.time, file.name);
  }
  write_file_whole(path, xml + "</Collection>\n</VTKFile>\n");
}

}  // namespace particle_surface_tracker
