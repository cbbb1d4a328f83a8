#include "particle_surface_tracker/ros/mesh_conversion.h"

#include <vector>

#include "flat_arrays.h"

namespace particle_surface_tracker {
namespace {

std::vector<float> attribute_values(const TriangleMesh& mesh, const char* name) {
  const std::size_t index = mesh.attributes().find(name);
  return index == VertexAttributes::none ? std::vector<float>() : mesh.attributes()[index].values;
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

}  // namespace particle_surface_tracker
