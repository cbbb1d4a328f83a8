#pragma once

#include <functional>
#include <string>

#include <particle_surface_tracker/TrackedMesh.h>
#include <ros/ros.h>
#include <shape_msgs/Mesh.h>
#include <topic_tools/shape_shifter.h>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker {

/// Takes meshes that may be tracked from a topic, of type TrackedMesh or shape_msgs/Mesh.
class InitialMeshTopic {
 public:
  /// Receives a closed mesh that is turned the right way.
  using Handler = std::function<void(TriangleMesh mesh)>;

  /// \param name of the node, for the log; a mesh that cannot be used is said there.
  InitialMeshTopic(ros::NodeHandle handle, const std::string& name, Handler handler);

  void shutdown() { subscriber_.shutdown(); }

 private:
  void receive(const topic_tools::ShapeShifter& message) const;

  std::string name_;
  Handler handler_;
  ros::Subscriber subscriber_;
};

/// The mesh to begin with. Of a TrackedMesh colours and texture coordinates are taken, too; ids and δ are given anew.
/// \throw InputError if the arrays of the message do not fit each other.
/// \throw MeshError as TriangleMesh.
TriangleMesh to_initial_mesh(const TrackedMesh& message);
TriangleMesh to_initial_mesh(const shape_msgs::Mesh& message);

}  // namespace particle_surface_tracker
