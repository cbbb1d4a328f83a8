#include "particle_surface_tracker/io/vtp_writer.h"

#include <cstdint>

#include <fmt/format.h>

#include "color_bytes.h"
#include "file_bytes.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "vtp_arrays.h"

// VTK itself would bring the development files of half a desktop for this page.

namespace particle_surface_tracker {
namespace {

void append_attribute(std::string& xml, const VertexAttribute& attribute) {
  if (attribute.name != TriangleMesh::color_name) {
    append_vtp_array(xml, "Float32", attribute.name, attribute.components, attribute.values);
    return;
  }
  // As bytes ParaView takes them for colours.
  std::vector<std::uint8_t> bytes;
  bytes.reserve(attribute.values.size());
  for (const float value : attribute.values) bytes.push_back(color_byte(value));
  append_vtp_array(xml, "UInt8", attribute.name, attribute.components, bytes);
}

void append_point_data(std::string& xml, const TriangleMesh& mesh) {
  const bool has_normals = mesh.attributes().find(normal_attribute) != VertexAttributes::none;
  xml += fmt::format("<PointData Scalars=\"delta\"{}>\n",
                     has_normals ? fmt::format(" Normals=\"{}\"", normal_attribute) : "");
  for (std::size_t i = 0; i < mesh.attributes().count(); ++i) {
    const VertexAttribute& attribute = mesh.attributes()[i];
    if (attribute.use == AttributeUse::kOutput) append_attribute(xml, attribute);
  }
  append_vtp_array(xml, "UInt32", "id", 1, mesh.ids());
  xml += "</PointData>\n";
}

void append_points(std::string& xml, const TriangleMesh& mesh) {
  std::vector<float> coordinates;
  coordinates.reserve(3 * mesh.vertex_count());
  for (const Vec3f& position : mesh.positions())
    coordinates.insert(coordinates.end(), position.begin(), position.end());
  xml += "<Points>\n";
  append_vtp_array(xml, "Float32", "Points", 3, coordinates);
  xml += "</Points>\n";
}

void append_polygons(std::string& xml, const TriangleMesh& mesh) {
  std::vector<std::int64_t> corners, ends;
  corners.reserve(3 * mesh.triangle_count());
  ends.reserve(mesh.triangle_count());
  for (const Triangle& triangle : mesh.triangles()) {
    corners.insert(corners.end(), triangle.begin(), triangle.end());
    ends.push_back(static_cast<std::int64_t>(corners.size()));
  }
  xml += "<Polys>\n";
  append_vtp_array(xml, "Int64", "connectivity", 1, corners);
  append_vtp_array(xml, "Int64", "offsets", 1, ends);
  xml += "</Polys>\n";
}

}  // namespace

void write_vtp(const std::string& path, const TriangleMesh& mesh) {
  std::string piece =
      fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfPolys=\"{}\">\n", mesh.vertex_count(), mesh.triangle_count());
  append_point_data(piece, mesh);
  append_points(piece, mesh);
  append_polygons(piece, mesh);
  write_file_whole(path, vtp_file(piece + "</Piece>\n"));
}

}  // namespace particle_surface_tracker
