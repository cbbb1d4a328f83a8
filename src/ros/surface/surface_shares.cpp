#include "ros/surface/surface_shares.h"

namespace particle_surface_tracker {
namespace {

bool has(const std::pair<std::uint32_t, std::uint32_t>& share, std::uint32_t number) {
  return number == 0 || number % share.first == share.second;
}

}  // namespace

void SurfaceShares::note(const SurfaceShare& share, bool in_time) {
  // A message from anywhere: what makes no sense stands for all frames.
  const bool makes_sense = share.every > 0 && share.offset < share.every;
  bool& trusted = is_trusted_[makes_sense ? std::make_pair(share.every, share.offset) : std::make_pair(1U, 0U)];
  trusted = trusted || in_time;
}

void SurfaceShares::note_missed(std::uint32_t number) {
  bool is_known = false;
  for (auto& [share, trusted] : is_trusted_) {
    if (!has(share, number)) continue;
    is_known = true;
    trusted = false;
  }
  if (!is_known) trusts_strangers_ = false;
}

bool SurfaceShares::worth_waiting(std::uint32_t number) const {
  bool is_known = false;
  for (const auto& [share, trusted] : is_trusted_) {
    if (!has(share, number)) continue;
    if (trusted) return true;
    is_known = true;
  }
  return !is_known && trusts_strangers_;
}

}  // namespace particle_surface_tracker
