#include "run_facts.h"

#include <cmath>

#include <fmt/format.h>

namespace particle_surface_tracker {

void RunFacts::note(const FrameReport& report) {
  if (!first_stamp_) first_stamp_ = report.stamp_ns;
  last_stamp_ = report.stamp_ns;
  topology_.splits += report.topology.splits;
  topology_.merges += report.topology.merges;
  topology_.gone += report.topology.gone;
  topology_.remeshed_cells += report.topology.remeshed_cells;
  const double angle = report.smallest_angle;
  if (!std::isnan(angle) && (!smallest_angle_ || angle < smallest_angle_->value)) {
    smallest_angle_ = Extreme{angle, report.frame};
  }
  if (report.total_time > longest_.value) longest_ = {report.total_time, report.frame};
  if (report.missing_frames != 0) ++gaps_;
  missing_frames_ += report.missing_frames;
}

std::optional<double> RunFacts::real_time_factor(double elapsed) const {
  if (!first_stamp_ || last_stamp_ <= *first_stamp_) return std::nullopt;
  // In doubles, as stamps of a damaged bag may be farther apart than an integer holds.
  return 1e-9 * (static_cast<double>(last_stamp_) - static_cast<double>(*first_stamp_)) / elapsed;
}

void RunFacts::print(std::ostream& out) const {
  if (!first_stamp_) return;
  print_surface(out);
  out << fmt::format("longest frame: {}, {:.3f} s\n", longest_.frame, longest_.value);
  if (gaps_ != 0) {
    out << fmt::format("{} frame{} missing in the bag, in {} gap{}\n", missing_frames_,
                       missing_frames_ == 1 ? " is" : "s are", gaps_, gaps_ == 1 ? "" : "s");
  }
}

void RunFacts::print_surface(std::ostream& out) const {
  out << fmt::format("pieces: {} split off, {} merged, {} gone; {} re-meshed cells\n", topology_.splits,
                     topology_.merges, topology_.gone, topology_.remeshed_cells);
  if (!smallest_angle_) return;
  out << fmt::format("smallest angle of a triangle: {:.2f} deg, in frame {}\n", smallest_angle_->value,
                     smallest_angle_->frame);
}

}  // namespace particle_surface_tracker
