#include "sequences/judged_tracking.h"

#include <fmt/format.h>

#include "particle_surface_tracker/tracker/tracker.h"
#include "support/parameters.h"

namespace particle_surface_tracker::test {

std::vector<TopologyFigures> track_and_judge(const Sequence& sequence, const Parameters& parameters, std::size_t step,
                                             const FigureVisitor& visit) {
  Tracker tracker(parameters);
  TopologyFigureTaker taker(tracker);
  std::vector<TopologyFigures> figures;
  for (std::size_t n = 0; n < sequence.frames.size(); n += step) {
    const ParticleFrame& frame = sequence.frames[n];
    const FrameReport report = n == 0 ? tracker.start(sequence.mesh, frame) : tracker.advance(frame, n);
    figures.push_back(taker.take(frame, report));
    visit(figures.back(), figures.front());
  }
  return figures;
}

std::vector<TopologyFigures> track_and_judge(const Sequence& sequence, std::size_t step) {
  fmt::print("{}\n", topology_header());
  return track_and_judge(sequence, parameters_with_spacing(sequence.spacing), step,
                         [](const TopologyFigures& figures, const TopologyFigures& first) {
                           fmt::print("{}\n{}", topology_row(figures, first), topology_notes(figures));
                         });
}

}  // namespace particle_surface_tracker::test
