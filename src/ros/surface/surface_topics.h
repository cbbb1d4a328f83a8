#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include <ros/callback_queue.h>
#include <ros/ros.h>

#include "ros/live/throttled_log.h"
#include "ros/surface/surface_inbox.h"
#include "ros/surface/surface_shares.h"

namespace particle_surface_tracker {

/// Where the live node takes implicit surfaces from that other nodes make.
struct SurfaceOptions {
  std::vector<std::string> topics;  ///< Empty: it makes all by itself.
  double wait = 0.5;                ///< For the surface of a frame [s], once the frame is due.
};

/// Joins the surfaces of other nodes with the frames that are tracked, by their stamps. What does not come in time, or
/// does not fit, is not taken, and whoever tracks makes it.
class SurfaceTopics {
 public:
  /// \param limit surfaces that may wait for their frames.
  /// \param name of the node, for the log.
  SurfaceTopics(const ros::NodeHandle& handle, const SurfaceOptions& options, std::size_t limit,
                const std::string& name);
  ~SurfaceTopics();
  SurfaceTopics(const SurfaceTopics&) = delete;
  SurfaceTopics& operator=(const SurfaceTopics&) = delete;

  /// To be called by one thread, frame after frame.
  /// \param number of the frame, its header.seq.
  /// \return null: it has to be made here.
  std::shared_ptr<const ImplicitSurface> surface_of(std::uint32_t number, const ParticleFrame& particles,
                                                    const Parameters& parameters);

  /// Ends all waiting, now and for ever.
  void close() { inbox_.close(); }

 private:
  void receive(const ParticleSurfaceConstPtr& surface);
  bool is_expected(std::uint32_t number);

  ThrottledLog log_;
  SurfaceInbox inbox_;
  std::mutex mutex_;
  SurfaceShares shares_;
  // Surfaces are unpacked on a thread of their own, beside all other messages.
  ros::CallbackQueue queue_;
  ros::AsyncSpinner spinner_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace particle_surface_tracker
