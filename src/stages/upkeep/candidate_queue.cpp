#include "candidate_queue.h"

#include <cmath>

namespace particle_surface_tracker {

void CandidateQueue::push(const Candidate& candidate, const Vec3f& place) {
  Tile tile{};
  if (candidate.ailment != Ailment::kLongEdge) {
    for (int axis = 0; axis < 3; ++axis) tile[axis] = std::round(static_cast<double>(place[axis]) / tile_);
  }
  tiles_[{candidate.ailment, tile}].push(candidate);
}

Candidate CandidateQueue::take() {
  const auto first = tiles_.begin();
  std::priority_queue<Candidate>& candidates = first->second;
  Candidate next = candidates.top();
  // What was pushed twice comes twice in a row.
  do {
    candidates.pop();
  } while (!candidates.empty() && !(candidates.top() < next));
  if (candidates.empty()) tiles_.erase(first);
  return next;
}

}  // namespace particle_surface_tracker
