#include "ros/surface/surface_inbox.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/time_conversion.h"
#include "ros/surface/surface_conversion.h"

namespace particle_surface_tracker {

SurfaceInbox::SurfaceInbox(std::size_t limit, std::chrono::duration<double> patience,
                           std::function<void(const std::string&)> complain)
    : limit_(limit), patience_(patience), complain_(std::move(complain)) {}

void SurfaceInbox::receive(const ParticleSurfaceConstPtr& surface) {
  const std::lock_guard<std::mutex> lock(mutex_);
  ParticleSurfaceConstPtr& place = waiting_[to_nanoseconds(surface->header.stamp)];
  if (place == nullptr) ++surfaces_;
  place = surface;
  if (surfaces_ > limit_) {
    const auto newest =
        std::find_if(waiting_.rbegin(), waiting_.rend(), [](const auto& w) { return w.second != nullptr; });
    newest->second = nullptr;
    --surfaces_;
  }
  changed_.notify_all();
}

void SurfaceInbox::forget_until(std::int64_t stamp_ns) {
  const auto end = waiting_.lower_bound(stamp_ns);
  for (auto entry = waiting_.begin(); entry != end; ++entry) surfaces_ -= entry->second != nullptr ? 1 : 0;
  waiting_.erase(waiting_.begin(), end);
}

ParticleSurfaceConstPtr SurfaceInbox::take(std::int64_t stamp_ns) {
  std::unique_lock<std::mutex> lock(mutex_);
  forget_until(stamp_ns);
  changed_.wait_for(lock, patience_, [&] { return closed_ || waiting_.count(stamp_ns) != 0; });
  const auto found = waiting_.find(stamp_ns);
  const ParticleSurfaceConstPtr surface = found != waiting_.end() ? found->second : nullptr;
  forget_until(stamp_ns + 1);
  return surface;
}

std::shared_ptr<const ImplicitSurface> SurfaceInbox::wait_for(const ParticleFrame& particles,
                                                              const Parameters& parameters) {
  std::shared_ptr<const ImplicitSurface> surface;
  if (const ParticleSurfaceConstPtr message = take(particles.stamp_ns)) {
    try {
      require_made_of(*message, particles, parameters);
      surface = to_surface(*message);
    } catch (const InputError& error) {
      complain_(error.what());
    }
  } else {
    complain_(fmt::format("no implicit surface came within {:.3g} s, or too many were waiting; it is made here",
                          patience_.count()));
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  ++(surface != nullptr ? taken_ : missed_);
  return surface;
}

void SurfaceInbox::close() {
  const std::lock_guard<std::mutex> lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

std::uint64_t SurfaceInbox::taken() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return taken_;
}

std::uint64_t SurfaceInbox::missed() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return missed_;
}

}  // namespace particle_surface_tracker
