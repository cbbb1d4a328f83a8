#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <particle_surface_tracker/TrackerStatus.h>
#include <sensor_msgs/PointCloud2.h>

#include "particle_surface_tracker/ros/frame_handler.h"
#include "ros/live/checkpoint_keeper.h"
#include "ros/live/frame_admission.h"
#include "ros/live/frame_queue.h"
#include "ros/live/node_diagnostics.h"
#include "ros/live/node_options.h"
#include "ros/live/node_outputs.h"
#include "ros/live/throttled_log.h"
#include "ros/live/tracked_view.h"
#include "ros/surface/surface_topics.h"

namespace particle_surface_tracker {

/// Tracks on a thread of its own, the only one that touches the tracker. Other threads hand it frames and commands.
class TrackingWorker {
 public:
  /// \param name of the node, for the log.
  /// \param outputs, diagnostics, surfaces outlive this object.
  /// \param surfaces may be null: then all are made here.
  /// \throw ParameterError as FrameHandler.
  TrackingWorker(NodeOptions options, NodeOutputs& outputs, NodeDiagnostics& diagnostics, SurfaceTopics* surfaces,
                 const std::string& name);
  ~TrackingWorker();

  /// Checks the layout of a cloud and puts it in the row. Answers within microseconds.
  void receive(const sensor_msgs::PointCloud2ConstPtr& cloud);

  /// After the frame in work: the next one starts the tracker anew.
  void reset();

  /// After the frame in work: frames wait, or are tracked again.
  void pause(bool paused);

  /// After the frame in work: sets the mesh to begin with. A run that waits for it starts.
  void set_initial_mesh(TriangleMesh mesh);

  /// After the frame in work: takes over new parameters. Those that cannot change while a mesh is being tracked wait
  /// for the next reset.
  void set_parameters(const Parameters& parameters);

  /// After the frame in work: the state of the run.
  /// \throw TrackingError if there is none.
  Checkpoint checkpoint();

  /// After the frame in work: goes on from a checkpoint, in place of the run so far.
  /// \throw ParameterError, InputError if it does not fit; the run goes on then as if nothing had been asked.
  void go_on(const Checkpoint& checkpoint);

  /// Ends after the frame in work.
  void stop();

 private:
  // Runs something on the worker's thread, and waits for it. What it throws is thrown here.
  void run_in_turn(const std::function<void()>& task);
  Checkpoint state() const;
  void take_over(const Checkpoint& checkpoint);
  void load(const Checkpoint& checkpoint);
  // Parameters that wait for a reset, in words; empty if there are none.
  std::string waiting_parameters() const;
  void update_waiting_parameters();
  void show_mesh();

  void run();
  void process(const ReceivedFrame& frame);
  // Tracks it, or says in the status why it cannot.
  void try_to_track(const ReceivedFrame& frame, TrackerStatus& status);
  void track(const ReceivedFrame& frame, TrackerStatus& status);
  std::shared_ptr<const TrackedView> make_view(const ReceivedFrame& frame, const FrameReport& report,
                                               std::uint32_t first_new_id, TrackerStatus& status);
  void add_interpolated(const sensor_msgs::PointCloud2& cloud, TrackedMesh& mesh, TrackerStatus& status);
  void say(const ReceivedFrame& frame, const FrameReport& report, const TrackerStatus& status);
  void forget_run();
  void join_surfaces(SurfaceTopics& surfaces);
  // The counts so far.
  void describe_counts(TrackerStatus& status) const;
  // What nothing is tracked for now; empty if it is.
  std::string waiting_for() const;
  // Lets frames wait, or not any more, and tells everyone.
  void update_waiting();
  void publish_waiting();
  void publish(const ReceivedFrame& frame, TrackerStatus status);

  MessageContent content_;
  std::vector<std::string> interpolate_;
  NodeOutputs& outputs_;
  NodeDiagnostics& diagnostics_;
  ThrottledLog log_;
  FrameQueue queue_;
  FrameAdmission admission_;
  Parameters configured_;  // What the node was configured with, and what dynamic_reconfigure has made of it,
  Parameters wanted_;      // whether it is in force or waits for a reset.
  bool estimates_spacing_;
  FrameHandler handler_;
  CheckpointKeeper keeper_;
  TrackedMeshConstPtr last_mesh_;  // Of this run.
  std_msgs::Header last_header_;   // Of the last status.
  std::uint32_t number_ = 0;       // The header.seq of the frame in work,
  bool is_joined_ = false;         // and whether another node has made its surface.
  std::uint64_t surfaces_joined_ = 0;
  std::uint64_t surfaces_own_ = 0;
  bool paused_ = false;
  bool awaits_mesh_;
  std::atomic<bool> waits_{false};
  std::thread thread_;  // Last: it uses all others.
};

}  // namespace particle_surface_tracker
