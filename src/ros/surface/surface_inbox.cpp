#include "ros/surface/surface_inbox.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/time_conversion.h"
#include "ros/surface/surface_conversion.h"

namespace particle_surface_tracker {

SurfaceInbox::SurfaceInbox(std::size_t limit, std::chrono::duration<double> patience,
                           std::function<void(const std::string&)> complain)
    : limit_(limit), patience_(patience), complain_(std::move(complain)) {}

bool SurfaceInbox::receive(const ParticleSurfaceConstPtr& surface) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::int64_t stamp_ns = to_nanoseconds(surface->header.stamp);
  ParticleSurfaceConstPtr& place = waiting_[stamp_ns];
  if (place == nullptr) ++surfaces_;
  place = surface;
  if (surfaces_ > limit_) {
    const auto newest =
        std::find_if(waiting_.rbegin(), waiting_.rend(), [](const auto& w) { return w.second != nullptr; });
    newest->second = nullptr;
    --surfaces_;
  }
  changed_.notify_all();
  if (!last_asked_ || stamp_ns > *last_asked_ || stamp_ns < *first_asked_) return true;
  const auto asked = asked_in_vain_.find(stamp_ns);
  return asked != asked_in_vain_.end() && std::chrono::steady_clock::now() - asked->second <= patience_;
}

void SurfaceInbox::note_in_vain(std::int64_t stamp_ns, std::chrono::steady_clock::time_point asked) {
  for (auto entry = asked_in_vain_.begin(); entry != asked_in_vain_.end();) {
    entry = asked - entry->second > patience_ ? asked_in_vain_.erase(entry) : std::next(entry);
  }
  asked_in_vain_[stamp_ns] = asked;
}

void SurfaceInbox::forget_until(std::int64_t stamp_ns) {
  const auto end = waiting_.lower_bound(stamp_ns);
  for (auto entry = waiting_.begin(); entry != end; ++entry) surfaces_ -= entry->second != nullptr ? 1 : 0;
  waiting_.erase(waiting_.begin(), end);
}

ParticleSurfaceConstPtr SurfaceInbox::take(std::int64_t stamp_ns, bool is_expected) {
  std::unique_lock<std::mutex> lock(mutex_);
  const auto asked = std::chrono::steady_clock::now();
  forget_until(stamp_ns);
  if (is_expected) {
    changed_.wait_for(lock, patience_, [&] { return closed_ || waiting_.count(stamp_ns) != 0; });
  }
  if (!last_asked_ || stamp_ns < *last_asked_) first_asked_ = stamp_ns;  // Time goes back where a run begins.
  last_asked_ = stamp_ns;
  const auto found = waiting_.find(stamp_ns);
  ParticleSurfaceConstPtr surface = found != waiting_.end() ? found->second : nullptr;
  if (surface == nullptr) note_in_vain(stamp_ns, asked);
  forget_until(stamp_ns + 1);
  return surface;
}

std::shared_ptr<const ImplicitSurface> SurfaceInbox::wait_for(const ParticleFrame& particles,
                                                              const Parameters& parameters, bool is_expected) {
  std::shared_ptr<const ImplicitSurface> surface;
  if (const ParticleSurfaceConstPtr message = take(particles.stamp_ns, is_expected)) {
    try {
      require_made_of(*message, particles, parameters);
      surface = to_surface(*message);
    } catch (const InputError& error) {
      complain_(error.what());
    }
  } else if (is_expected) {
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
