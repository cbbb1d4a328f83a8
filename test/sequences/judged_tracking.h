#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "sequences/sequence_data.h"
#include "sequences/topology_figures.h"

namespace particle_surface_tracker::test {

/// Called with the figures of each frame and those of the first.
using FigureVisitor = std::function<void(const TopologyFigures& figures, const TopologyFigures& first)>;

/// Tracks a sequence and judges the topology of every frame that is tracked.
/// \param step every step-th frame is.
/// \param visit called after each.
/// \throw what the tracker throws.
std::vector<TopologyFigures> track_and_judge(const Sequence& sequence, const Parameters& parameters, std::size_t step,
                                             const FigureVisitor& visit);

/// The same with default parameters; prints a row for every frame.
std::vector<TopologyFigures> track_and_judge(const Sequence& sequence, std::size_t step = 1);

}  // namespace particle_surface_tracker::test
