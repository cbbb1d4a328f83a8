#include "ros/live/tracker_node.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/checkpoint.h"
#include "particle_surface_tracker/ros/time_conversion.h"
#include "ros/live/mesh_saver.h"
#include "ros/live/save_path.h"

namespace particle_surface_tracker {
namespace {

// roscpp's own queue drops silently. It is emptied at once, and long enough for that never to happen before the queue
// of the node is full, which says what it drops.
constexpr std::size_t kSmallestSubscriberQueue = 100;

std::string frame_of(const Checkpoint& checkpoint) {
  const ros::Time stamp = to_ros_time(checkpoint.tracker.frame.particles.stamp_ns);
  return fmt::format("the particles of stamp {}.{:09}", stamp.sec, stamp.nsec);
}

}  // namespace

TrackerNode::TrackerNode(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle)
    : TrackerNode(handle, private_handle, read_node_options(private_handle)) {}

TrackerNode::TrackerNode(ros::NodeHandle handle, ros::NodeHandle private_handle, const NodeOptions& options)
    : name_(private_handle.getNamespace()),
      save_folder_(options.save_folder),
      checkpoint_(options.checkpoint.path),
      outputs_(private_handle, options.marker),
      diagnostics_(handle, private_handle, options.diagnostics),
      surfaces_(options.surfaces.topics.empty()
                    ? nullptr
                    : std::make_unique<SurfaceTopics>(handle, options.surfaces, options.queue_size, name_)),
      worker_(options, outputs_, diagnostics_, surfaces_.get(), name_),
      parameter_server_(private_handle, options.handler.parameters, options.parameter_record,
                        [this](const Parameters& parameters) { worker_.set_parameters(parameters); }) {
  for (const std::string& note : options.notes) ROS_INFO_STREAM(name_ << ": " << note);
  for (const std::string& warning : options.warnings) ROS_WARN_STREAM(name_ << ": " << warning);
  reset_service_ = private_handle.advertiseService("reset", &TrackerNode::reset, this);
  pause_service_ = private_handle.advertiseService("pause", &TrackerNode::pause, this);
  save_mesh_service_ = private_handle.advertiseService("save_mesh", &TrackerNode::save_mesh, this);
  save_checkpoint_service_ = private_handle.advertiseService("save_checkpoint", &TrackerNode::save_checkpoint, this);
  load_checkpoint_service_ = private_handle.advertiseService("load_checkpoint", &TrackerNode::load_checkpoint, this);
  if (options.mesh_from_topic) {
    initial_mesh_ = std::make_unique<InitialMeshTopic>(
        handle, name_, [this](TriangleMesh mesh) { worker_.set_initial_mesh(std::move(mesh)); });
  }
  particles_ = handle.subscribe<sensor_msgs::PointCloud2>(
      "particles", static_cast<std::uint32_t>(std::max(options.queue_size, kSmallestSubscriberQueue)),
      [this](const sensor_msgs::PointCloud2ConstPtr& cloud) { worker_.receive(cloud); }, ros::VoidConstPtr(),
      ros::TransportHints().tcpNoDelay());
}

TrackerNode::~TrackerNode() {
  // In this order, so that nothing is called any more that is gone.
  particles_.shutdown();
  if (initial_mesh_) initial_mesh_->shutdown();
  for (ros::ServiceServer* service :
       {&reset_service_, &pause_service_, &save_mesh_service_, &save_checkpoint_service_, &load_checkpoint_service_}) {
    service->shutdown();
  }
  if (surfaces_) surfaces_->close();
  worker_.stop();
}

bool TrackerNode::reset(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  worker_.reset();
  response.success = 1;
  response.message = "the next frame starts the tracker with the initial mesh";
  return true;
}

bool TrackerNode::pause(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  const bool paused = request.data != 0;
  worker_.pause(paused);
  response.success = 1;
  response.message = paused ? "frames wait after the one in work" : "frames are tracked";
  return true;
}

bool TrackerNode::save_mesh(SaveMesh::Request& request, SaveMesh::Response& response) {
  // What was published last, so that nobody waits for the frame in work.
  const TrackedMeshConstPtr mesh = outputs_.last_mesh();
  try {
    if (mesh == nullptr) throw TrackingError("nothing is tracked yet; there is no mesh to save");
    response.path = particle_surface_tracker::save_mesh(save_folder_, request.path, *mesh);
    response.success = 1;
    response.message = fmt::format("{} vertices, {} triangles of stamp {}.{:09}", mesh->vertices.size() / 3,
                                   mesh->triangles.size() / 3, mesh->header.stamp.sec, mesh->header.stamp.nsec);
    ROS_INFO_STREAM(name_ << ": saved the mesh as " << response.path);
  } catch (const std::exception& error) {
    response.success = 0;
    response.message = error.what();
    ROS_ERROR_STREAM(name_ << ": cannot save the mesh: " << error.what());
  }
  return true;
}

std::string TrackerNode::checkpoint_path(const std::string& name) const {
  if (!name.empty()) return path_below(save_folder_, name, {".checkpoint"});
  if (checkpoint_.empty()) throw ParameterError("the path is empty, and ~checkpoint is not set");
  return checkpoint_;
}

bool TrackerNode::save_checkpoint(CheckpointFile::Request& request, CheckpointFile::Response& response) {
  try {
    const std::string path = checkpoint_path(request.path);
    const Checkpoint checkpoint = worker_.checkpoint();
    make_folders_of(path);
    write_checkpoint(path, checkpoint);
    response.success = 1;
    response.path = path;
    response.message = fmt::format("the run up to {}", frame_of(checkpoint));
    ROS_INFO_STREAM(name_ << ": saved the checkpoint " << path);
  } catch (const std::exception& error) {
    response.success = 0;
    response.message = error.what();
    ROS_ERROR_STREAM(name_ << ": cannot save a checkpoint: " << error.what());
  }
  return true;
}

bool TrackerNode::load_checkpoint(CheckpointFile::Request& request, CheckpointFile::Response& response) {
  try {
    const std::string path = checkpoint_path(request.path);
    const Checkpoint checkpoint = read_checkpoint(path);
    worker_.go_on(checkpoint);
    response.success = 1;
    response.path = path;
    response.message = fmt::format("goes on after {}", frame_of(checkpoint));
  } catch (const std::exception& error) {
    response.success = 0;
    response.message = error.what();
    ROS_ERROR_STREAM(name_ << ": cannot go on from a checkpoint: " << error.what());
  }
  return true;
}

}  // namespace particle_surface_tracker
