#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/frame_report.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "sequences/topology_judge.h"

namespace particle_surface_tracker::test {

/// What is asked of a tracked sequence in which liquid may split and merge.
struct SequenceLimits {
  double valid_frames = 1.0;         ///< Least share of frames whose mesh is valid.
  double self_intersecting = 0.001;  ///< Largest mean share of self-intersecting triangles.
  double equal_topology = 0.99;      ///< Least share of frames whose mesh has the topology of φ = 0.
  double covered_frames = 0.99;      ///< Least share of frames whose particles are all inside the mesh or near it.
  double volume_drift = 0.05;        ///< Largest change of volume of mesh / volume of φ = 0 since the first frame.
  double original_vertices = 0.0;    ///< Least share of the first mesh's vertices that live at the end.
};

/// The limits of a recorded sequence; the general ones for a name that is not known.
SequenceLimits limits_for(const std::string& name);

/// The figures of one frame.
struct TopologyFigures {
  std::uint64_t frame = 0;
  bool is_manifold = false;         ///< Closed, manifold, oriented, finite.
  bool is_manifold_welded = false;  ///< The same after vertices of the same position have been joined.
  TopologyJudgement topology;
  double self_intersecting = 0.0;            ///< Share of triangles that intersect others.
  double volume_ratio = 0.0;                 ///< Volume of the mesh / volume of φ = 0.
  double originals = 0.0;                    ///< Share of the first mesh's vertices that live.
  std::map<std::string, std::size_t> marks;  ///< Counts of marked and re-meshed cells, as far as reports have them.

  /// Manifold, also when joined, and its components nested as those of a liquid.
  bool is_valid() const {
    return is_manifold && is_manifold_welded && topology.nested_solids + topology.misplaced_cavities == 0;
  }
  std::size_t events() const { return topology.splits + topology.merges; }
};

/// Takes the figures of a tracker frame by frame. Nothing but the marks is taken from its own report; exact
/// self-intersections are the product's (check_mesh()), which its tests compare with CGAL's.
class TopologyFigureTaker {
 public:
  explicit TopologyFigureTaker(const Tracker& tracker);

  /// Call it after every frame from the first on.
  TopologyFigures take(const ParticleFrame& particles, const FrameReport& report);

 private:
  const Tracker& tracker_;
  TopologyJudge judge_;
  std::size_t first_vertices_ = 0;
};

/// One limit, and how a sequence compares with it.
struct SequenceVerdict {
  std::string what;
  std::string value;
  std::string limit;
  bool passed = false;
};

/// \param figures of all frames, at least one.
std::vector<SequenceVerdict> judge_figures(const std::vector<TopologyFigures>& figures, const SequenceLimits& limits);

/// A table of the verdicts, with events and marks for each event below.
std::string summary_of(const std::string& name, const std::vector<TopologyFigures>& figures,
                       const SequenceLimits& limits);

/// Head and rows of a table for people, and of a CSV file.
std::string topology_header();
std::string topology_row(const TopologyFigures& figures, const TopologyFigures& first);
/// What is wrong with a frame's topology, and where: a line for each body and particle; empty where all is right.
std::string topology_notes(const TopologyFigures& figures);
std::string topology_csv_header();
std::string topology_csv_row(const TopologyFigures& figures, const TopologyFigures& first);

}  // namespace particle_surface_tracker::test
