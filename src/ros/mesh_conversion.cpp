#include "particle_surface_tracker/ros/mesh_conversion.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "flat_arrays.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_writer.h"

namespace particle_surface_tracker {
namespace {

std::vector<float> attribute_values(const TriangleMesh& mesh, const char* name) {
  const std::size_t index = mesh.attributes().find(name);
  return index == VertexAttributes::none ? std::vector<float>() : mesh.attributes()[index].values;
}

void check_size(const char* name, std::size_t size, std::size_t wanted) {
  if (size != wanted) {
    throw InputError(fmt::format("{} of the mesh has {} numbers, wanted {}", name, size, wanted));
  }
}

template <typename Triple, typename Number>
std::vector<Triple> triples(const char* name, const std::vector<Number>& numbers) {
  check_size(name, numbers.size(), numbers.size() / 3 * 3);
  std::vector<Triple> result(numbers.size() / 3);
  for (std::size_t n = 0; n < numbers.size(); ++n) result[n / 3][n % 3] = numbers[n];
  return result;
}

// Attributes that may be missing.
void add_attribute(TriangleMesh& mesh, const std::string& name, std::size_t components,
                   const std::vector<float>& values) {
  if (values.empty()) return;
  check_size(name.c_str(), values.size(), components * mesh.vertex_count());
  const std::size_t index = mesh.attributes().add(name, components, std::vector<float>(components, 1.0f));
  mesh.attributes()[index].values = values;
}

// A name that the header of any file can hold: fields of clouds may be called anything.
std::string plain(std::string name) {
  const auto is_plain = [](char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '.' || c == '-';
  };
  std::replace_if(
      name.begin(), name.end(), [&](char c) { return !is_plain(c); }, '_');
  return name;
}

bool is_taken(const TriangleMesh& mesh, const std::string& name) {
  // Files have these of every vertex.
  static constexpr const char* of_files[] = {"x", "y", "z", "id"};
  return name.empty() || mesh.attributes().find(name) != VertexAttributes::none ||
         std::find(std::begin(of_files), std::end(of_files), name) != std::end(of_files);
}

}  // namespace

TrackedMesh to_tracked_mesh(const std_msgs::Header& header, const TriangleMesh& mesh, std::uint32_t topology_version) {
  TrackedMesh message;
  message.header = header;
  message.topology_version = topology_version;
  message.vertices = flat<float>(mesh.positions());
  message.triangles = flat<std::uint32_t>(mesh.triangles());
  message.delta = mesh.delta();
  message.ids = mesh.ids();
  message.colors = attribute_values(mesh, TriangleMesh::color_name);
  message.texcoords = attribute_values(mesh, TriangleMesh::texcoord_name);
  return message;
}

TriangleMesh to_triangle_mesh(const TrackedMesh& message) {
  TriangleMesh mesh(triples<Vec3f>("vertices", message.vertices), triples<Triangle>("triangles", message.triangles),
                    message.ids);
  check_size("delta", message.delta.size(), mesh.vertex_count());
  mesh.delta() = message.delta;
  add_attribute(mesh, TriangleMesh::color_name, 4, message.colors);
  add_attribute(mesh, TriangleMesh::texcoord_name, 2, message.texcoords);
  return mesh;
}

TriangleMesh to_mesh_with_fields(const TrackedMesh& message) {
  TriangleMesh mesh = to_triangle_mesh(message);
  add_attribute(mesh, normal_attribute, 3, message.normals);
  add_attribute(mesh, "vertex_velocity", 3, message.velocities);
  for (const InterpolatedField& field : message.interpolated) {
    std::string name = plain(field.name);
    while (is_taken(mesh, name)) name.insert(0, "particle_");
    add_attribute(mesh, name, field.components, field.values);
  }
  return mesh;
}

}  // namespace particle_surface_tracker
