#pragma once

#include <array>
#include <map>
#include <queue>
#include <utility>

#include "candidates.h"

namespace particle_surface_tracker {

/// The order in which candidates are dealt with: ailment by ailment; of one ailment tile by tile, cubes on a lattice
/// that is fixed in the world, one of them with its centre at the origin; in a tile the most urgent first. Only what is
/// close together matters to each other, and operations that follow each other in space find what they look at still in
/// the processor's caches. Long edges all belong to one tile: there are few, and split in another order they make worse
/// triangles across the rims.
class CandidateQueue {
 public:
  /// \param tile side of a tile [m].
  explicit CandidateQueue(double tile) : tile_(tile) {}

  bool empty() const { return tiles_.empty(); }

  /// What take() will return calls for; not of an empty queue.
  Ailment next_ailment() const { return tiles_.begin()->first.first; }

  /// \param place of one end of its edge [m].
  void push(const Candidate& candidate, const Vec3f& place);

  /// Removes the next candidate, as often as it was pushed; not from an empty queue.
  Candidate take();

 private:
  using Tile = std::array<double, 3>;  // whole numbers: its centre [tiles]

  double tile_;
  std::map<std::pair<Ailment, Tile>, std::priority_queue<Candidate>> tiles_;  // none is empty
};

}  // namespace particle_surface_tracker
