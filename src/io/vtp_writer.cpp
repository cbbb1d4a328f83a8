#include "particle_surface_tracker/io/vtp_writer.h"

#include <cstdint>

#include <fmt/format.h>

#include "color_bytes.h"
#include "file_bytes.h"
#include "vtp_arrays.h"

// VTK itself would bring the development files of half a desktop for this page.

namespace particle_surface_tracker {
namespace {

std::string attribute_array(const VertexAttribute& attribute) {
  if (attribute.name != TriangleMesh::color_name) {
    return vtp_array("Float32", attribute.name, attribute.components, attribute.values);
  }
  // As bytes ParaView takes them for colours.
  std::vector<std::uint8_t> bytes;
  bytes.reserve(attribute.values.size());
  for (const float value : attribute.values) bytes.push_back(color_byte(value));
  return vtp_array("UInt8", attribute.name, attribute.components, bytes);
}

std::string point_data(const TriangleMesh& mesh) {
  std::string xml = "<PointData Scalars=\"delta\">\n";
  for (std::size_t i = 0; i < mesh.attributes().count(); ++i) {
    const VertexAttribute& attribute = mesh.attributes()[i];
    if (attribute.use == AttributeUse::kOutput) xml += attribute_array(attribute);
  }
  return xml + vtp_array("UInt32", "id", 1, mesh.ids()) + "</PointData>\n";
}

std::string points(const TriangleMesh& mesh) {
  std::vector<float> coordinates;
  coordinates.reserve(3 * mesh.vertex_count());
  for (const Vec3f& position : mesh.positions())
    coordinates.insert(coordinates.end(), position.begin(), position.end());
  return "<Points>\n" + vtp_array("Float32", "Points", 3, coordinates) + "</Points>\n";
}

std::string polygons(const TriangleMesh& mesh) {
  std::vector<std::int64_t> corners, ends;
  corners.reserve(3 * mesh.triangle_count());
  ends.reserve(mesh.triangle_count());
  for (const Triangle& triangle : mesh.triangles()) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }
  return "<Polys>\n" + vtp_array("Int64", "connectivity", 1, corners) + vtp_array("Int64", "offsets", 1, ends) +
         "</Polys>\n";
}

}  // namespace

void write_vtp(const std::string& path, const TriangleMesh& mesh) {
  std::string piece =
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n", mesh.vertex_count(), mesh.triangle_count());
  piece += point_data(mesh);
  piece += points(mesh);
  piece += polygons(mesh);
  write_file_whole(path, vtp_file(piece + "</Piece>\n"));
}

}  // namespace particle_surface_tracker
