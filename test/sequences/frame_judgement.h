#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/tracker/tracker.h"

namespace particle_surface_tracker::test {

/// What is measured on the tracked mesh of one frame. Nothing but the flags and δ is taken from the tracker's own
/// report.
struct FrameJudgement {
  std::uint64_t frame = 0;
  double covered_share = 0.0;  ///< Of the particles: inside the mesh or within r/2 of it.
  double volume = 0.0;         ///< Of the mesh [m³].
  double volume_ratio = 0.0;   ///< Volume of the mesh / volume of φ = 0.
  std::size_t vertices = 0;
  std::size_t flagged = 0;       ///< Flagged vertices.
  std::size_t clusters = 0;      ///< Pieces that the flagged vertices form along edges.
  std::size_t unreached = 0;     ///< Flagged vertices without φ = 0 within reach.
  std::size_t inverted = 0;      ///< Triangles that face away from the surface around them.
  std::size_t intersecting = 0;  ///< Triangles that intersect others; `not_counted` where that was left out.
  bool is_manifold = true;       ///< Closed and consistently oriented.
  double max_abs_delta = 0.0;    ///< Largest |δ| [r].

  static constexpr std::size_t not_counted = static_cast<std::size_t>(-1);

  double flagged_share() const { return static_cast<double>(flagged) / static_cast<double>(vertices); }
};

/// \param count_intersections counting intersecting triangles takes longer than everything else together.
FrameJudgement judge_frame(const Tracker& tracker, const ParticleFrame& particles, const FrameReport& report,
                           bool count_intersections);

/// Heads and rows of a table for people, and of a CSV file.
std::string judgement_header();
std::string judgement_row(const FrameJudgement& judgement, const FrameJudgement& first);
std::string judgement_csv_header();
std::string judgement_csv_row(const FrameJudgement& judgement, const FrameJudgement& first);

}  // namespace particle_surface_tracker::test
