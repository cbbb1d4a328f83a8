#include "ros/surface/surface_topics.h"

#include <algorithm>

namespace particle_surface_tracker {

SurfaceTopics::SurfaceTopics(const ros::NodeHandle& handle, const SurfaceOptions& options, std::size_t limit,
                             const std::string& name)
    : log_(name),
      inbox_(limit, std::chrono::duration<double>(options.wait),
             [this](const std::string& text) { log_.warn_sometimes("surfaces", text); }),
      spinner_(1, &queue_) {
  ros::NodeHandle own(handle);
  own.setCallbackQueue(&queue_);
  for (const std::string& topic : options.topics) {
    subscribers_.push_back(own.subscribe<ParticleSurface>(
        topic, static_cast<std::uint32_t>(limit), [this](const ParticleSurfaceConstPtr& surface) { receive(surface); },
        ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay()));
  }
  spinner_.start();
}

SurfaceTopics::~SurfaceTopics() {
  for (ros::Subscriber& subscriber : subscribers_) subscriber.shutdown();
  spinner_.stop();
}

void SurfaceTopics::receive(const ParticleSurfaceConstPtr& surface) {
  const bool in_time = inbox_.receive(surface);
  const std::lock_guard<std::mutex> lock(mutex_);
  shares_.note({surface->every, surface->offset}, in_time);
}

bool SurfaceTopics::is_expected(std::uint32_t number) {
  const bool has_publisher = std::any_of(subscribers_.begin(), subscribers_.end(),
                                         [](const ros::Subscriber& s) { return s.getNumPublishers() > 0; });
  const std::lock_guard<std::mutex> lock(mutex_);
  return has_publisher && shares_.worth_waiting(number);
}

std::shared_ptr<const ImplicitSurface> SurfaceTopics::surface_of(std::uint32_t number, const ParticleFrame& particles,
                                                                 const Parameters& parameters) {
  auto surface = inbox_.wait_for(particles, parameters, is_expected(number));
  if (surface == nullptr) {
    const std::lock_guard<std::mutex> lock(mutex_);
    shares_.note_missed(number);
  }
  return surface;
}

}  // namespace particle_surface_tracker
