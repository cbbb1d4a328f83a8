#pragma once

#include <cstdint>
#include <map>
#include <utility>

namespace particle_surface_tracker {

/// The frames that one of several nodes makes the surfaces of: one in `every`, those whose number leaves the remainder
/// `offset`.
struct SurfaceShare {
  std::uint32_t every = 1;
  std::uint32_t offset = 0;
};

/// Knows who makes the surfaces of which frames, from what has come, and whom it is worth waiting for. Whoever has let
/// a frame wait in vain, being slow or gone, is not waited for until one of its surfaces is in time again.
class SurfaceShares {
 public:
  /// A surface came from the node with a share.
  /// \param in_time as SurfaceInbox::receive() says.
  void note(const SurfaceShare& share, bool in_time);

  /// The surface of a frame did not come in time.
  /// \param number of the frame, its header.seq; 0 where nobody counts, as within a process.
  void note_missed(std::uint32_t number);

  bool worth_waiting(std::uint32_t number) const;

 private:
  std::map<std::pair<std::uint32_t, std::uint32_t>, bool> is_trusted_;  // By every and offset.
  bool trusts_strangers_ = true;                                        // Whose first surface is still to come.
};

}  // namespace particle_surface_tracker
