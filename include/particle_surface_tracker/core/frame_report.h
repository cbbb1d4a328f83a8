#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace particle_surface_tracker {

/// What happened in one frame, for logs, messages and files.
struct FrameReport {
  std::uint64_t frame = 0;    ///< Index of the frame in its sequence.
  std::int64_t stamp_ns = 0;  ///< [ns].
  /// Frames that are missing between the frame before and this one; from who reads the frames.
  std::uint64_t missing_frames = 0;

  std::size_t particles = 0;
  std::size_t particles_born = 0;  ///< Ids that the frame before did not have, teleported particles included.
  std::size_t particles_gone = 0;  ///< Ids that this frame does not have, teleported particles included.

  std::size_t vertices = 0;
  std::size_t triangles = 0;
  std::size_t components = 0;    ///< Connected components of the mesh.
  std::int64_t genus = 0;        ///< Sum over the components: components − χ/2.
  double volume = 0.0;           ///< Enclosed by the mesh [m³].
  double implicit_volume = 0.0;  ///< Enclosed by φ = 0 [m³].
  double area = 0.0;             ///< Of the mesh [m²].
  double max_abs_delta = 0.0;    ///< Largest |δ| [m].
  /// Of the triangles of the mesh [deg]; not a number where it has none.
  double smallest_angle = std::numeric_limits<double>::quiet_NaN();

  std::size_t flagged_vertices = 0;         ///< Moved by more than τ and put back (Sec. 5.3).
  std::size_t flagged_cells = 0;            ///< Cells of Γ flagged for topology matching.
  std::size_t unreached_vertices = 0;       ///< Of the flagged: those with no φ = 0 within reach.
  std::size_t original_vertices_alive = 0;  ///< Vertices of the first mesh that still live.

  /// Topology matching and re-meshing (Secs. 6, 7). All 0 in a frame without a change of topology.
  struct Topology {
    std::size_t disagreeing_nodes = 0;    ///< Nodes of Γ where mesh and φ disagree about inside and outside.
    std::size_t uncovered_particles = 0;  ///< Particles that the mesh did not hold.
    std::size_t conflicting_nodes = 0;    ///< Nodes of Γ where detail gave way to the side of φ.
    std::size_t passes = 0;               ///< How often mesh and φ were matched.
    std::size_t unknowns = 0;             ///< Nodes of Γ that were solved for.
    std::size_t iterations = 0;           ///< Of the solver.
    std::size_t enlargements = 0;         ///< How often the region that was solved for turned out too small.
    std::size_t changed_nodes = 0;        ///< Nodes of Γ that changed sides.
    std::size_t complex_cells = 0;        ///< Cells that the mesh passes through in more than one simple sheet.
    std::size_t tangled_cells = 0;        ///< Of these, those re-meshed because sheets overlap.
    std::size_t deep_cells = 0;           ///< Cells re-meshed because Γ sees no surface where the mesh has one.
    std::size_t marked_by_growth = 0;     ///< Cells re-meshed so that the cut around the others is simple.
    std::size_t remeshed_cells = 0;       ///< All cells that were re-meshed.
    std::size_t removed_components = 0;   ///< Pieces too small for Γ that φ does not confirm.
    std::size_t new_vertices = 0;         ///< Made by re-meshing.
    std::size_t retries = 0;    ///< How often the re-meshed region had to grow because it could not be filled.
    std::size_t fallbacks = 0;  ///< Of these, how often a whole component, or everything, was made anew.
    // As find_topology_events() tells them; from FrameHandler, which has the mesh of the frame before.
    std::size_t splits = 0;  ///< Pieces that came off others.
    std::size_t merges = 0;  ///< Pieces that joined others.
    std::size_t gone = 0;    ///< Pieces that vanished.
  };
  Topology topology;

  /// Mesh upkeep (Sec. 8).
  struct Upkeep {
    std::size_t splits = 0;
    std::size_t collapses = 0;  ///< Of short and of folded edges, and of slivers.
    std::size_t flips = 0;
    std::size_t tangles = 0;    ///< Places where triangles crossed each other beside a new fold.
    std::size_t untangled = 0;  ///< Those of them where none does any more.
    std::size_t refused = 0;    ///< Beyond a limit, but nothing could be done without harm.
  };
  Upkeep upkeep;
  /// Share of the triangles that intersect others, in [0, 1]; none where the mesh was not checked.
  std::optional<double> self_intersecting_triangles;

  /// What one stage took.
  struct StageTime {
    std::string stage;
    double seconds = 0.0;      ///< Wall time [s].
    double cpu_seconds = 0.0;  ///< Processor time, all threads [s].
  };

  std::vector<StageTime> times;      ///< In the order in which the stages ran.
  double total_time = 0.0;           ///< Wall time of the frame [s].
  double cpu_seconds = 0.0;          ///< Processor time of the frame, all threads [s].
  std::uint64_t peak_rss_bytes = 0;  ///< Largest resident memory of the process so far.

  /// Things a user should know about, in words; empty when all is well.
  std::vector<std::string> warnings;
};

}  // namespace particle_surface_tracker
