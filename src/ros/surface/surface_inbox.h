#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include <particle_surface_tracker/ParticleSurface.h>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_frame.h"

namespace particle_surface_tracker {

/// Where implicit surfaces wait that others have made, for the frame with their stamp. What does not come in time, or
/// does not fit, is not taken: then whoever tracks makes the surface by itself, and nothing is lost but time.
class SurfaceInbox {
 public:
  /// \param limit surfaces that may wait, at least 1. They come ahead of their frames where the tracker is slower than
  /// who makes them; then the newest give way, because frames are tracked in order.
  /// \param patience longest wait for the surface of a frame.
  /// \param complain is called with what does not fit, on the thread that waits.
  SurfaceInbox(std::size_t limit, std::chrono::duration<double> patience,
               std::function<void(const std::string&)> complain);

  /// Receives a surface, on any thread.
  /// \return whether it is in time: nobody has asked for it yet, or not longer ago than a wait takes. The first frame
  /// of a run never asks, so what is before all that was asked for is in time as well.
  bool receive(const ParticleSurfaceConstPtr& surface);

  /// Waits for the surface of a frame. Surfaces of frames before it are not wanted any more.
  /// \param is_expected false: takes it only if it is there already.
  /// \return null if it does not come in time, or was made of something else.
  std::shared_ptr<const ImplicitSurface> wait_for(const ParticleFrame& particles, const Parameters& parameters,
                                                  bool is_expected = true);

  /// Ends all waiting, now and for ever.
  void close();

  std::uint64_t taken() const;   ///< Surfaces that came in time.
  std::uint64_t missed() const;  ///< Those that did not, or did not fit.

 private:
  ParticleSurfaceConstPtr take(std::int64_t stamp_ns, bool is_expected);
  void forget_until(std::int64_t stamp_ns);
  void note_in_vain(std::int64_t stamp_ns, std::chrono::steady_clock::time_point asked);

  const std::size_t limit_;
  const std::chrono::duration<double> patience_;
  const std::function<void(const std::string&)> complain_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  // By stamp [ns]; null where one gave way, so that nobody waits for it.
  std::map<std::int64_t, ParticleSurfaceConstPtr> waiting_;
  std::optional<std::int64_t> first_asked_;  // [ns]
  std::optional<std::int64_t> last_asked_;   // [ns]
  // When those were asked for that had not come: not longer ago than a wait takes.
  std::map<std::int64_t, std::chrono::steady_clock::time_point> asked_in_vain_;
  std::size_t surfaces_ = 0;  // Of waiting_: those that are not null.
  std::uint64_t taken_ = 0;
  std::uint64_t missed_ = 0;
  bool closed_ = false;
};

}  // namespace particle_surface_tracker
