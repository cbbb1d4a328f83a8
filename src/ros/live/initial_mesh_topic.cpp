#include "ros/live/initial_mesh_topic.h"

#include <numeric>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_validation.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"

namespace particle_surface_tracker {
namespace {

template <typename Message>
constexpr const char* type_of() {
  return ros::message_traits::DataType<Message>::value();
}

/// The bytes come from outside: a message that ends too early throws.
template <typename Message>
TriangleMesh read(const topic_tools::ShapeShifter& message) {
  try {
    return to_initial_mesh(*message.instantiate<Message>());
  } catch (const ros::Exception& error) {
    throw InputError(fmt::format("the message is damaged: {}", error.what()));
  }
}

TriangleMesh read_any(const topic_tools::ShapeShifter& message) {
  const std::string& type = message.getDataType();
  if (type == type_of<TrackedMesh>()) return read<TrackedMesh>(message);
  if (type == type_of<shape_msgs::Mesh>()) return read<shape_msgs::Mesh>(message);
  throw InputError(
      fmt::format("it has the type '{}', wanted {} or {}", type, type_of<TrackedMesh>(), type_of<shape_msgs::Mesh>()));
}

}  // namespace

InitialMeshTopic::InitialMeshTopic(ros::NodeHandle handle, const std::string& name, Handler handler)
    : name_(name), handler_(std::move(handler)) {
  subscriber_ = handle.subscribe<topic_tools::ShapeShifter>(
      "initial_mesh", 1, [this](const topic_tools::ShapeShifter::ConstPtr& message) { receive(*message); });
}

void InitialMeshTopic::receive(const topic_tools::ShapeShifter& message) const {
  try {
    TriangleMesh mesh = read_any(message);
    check_closed_manifold(mesh);
    for (const std::string& line : orient_outward(mesh)) ROS_WARN_STREAM(name_ << ": initial_mesh: " << line);
    handler_(std::move(mesh));
  } catch (const std::exception& error) {
    ROS_ERROR_STREAM(name_ << ": cannot use the mesh of topic initial_mesh: " << error.what());
  }
}

TriangleMesh to_initial_mesh(const TrackedMesh& message) {
  TrackedMesh plain = message;
  plain.ids.resize(message.vertices.size() / 3);
  std::iota(plain.ids.begin(), plain.ids.end(), 0u);
  plain.delta.assign(plain.ids.size(), 0.0f);
  plain.interpolated.clear();
  return to_triangle_mesh(plain);
}

TriangleMesh to_initial_mesh(const shape_msgs::Mesh& message) {
  std::vector<Vec3f> positions;
  positions.reserve(message.vertices.size());
  for (const geometry_msgs::Point& vertex : message.vertices) {
    positions.push_back(Vec3d(vertex.x, vertex.y, vertex.z).cast<float>());
  }
  std::vector<Triangle> triangles;
  triangles.reserve(message.triangles.size());
  for (const shape_msgs::MeshTriangle& triangle : message.triangles) {
    triangles.push_back({triangle.vertex_indices[0], triangle.vertex_indices[1], triangle.vertex_indices[2]});
  }
  return TriangleMesh(std::move(positions), std::move(triangles));
}

}  // namespace particle_surface_tracker
