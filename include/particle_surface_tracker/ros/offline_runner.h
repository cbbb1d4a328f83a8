#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/io/mesh_sequence.h"

namespace particle_surface_tracker {

/// What an offline run reads, does and writes. Paths that may be left out are empty then.
struct OfflineOptions {
  std::string bag;
  std::string topic = "/particles";
  std::optional<std::string> mesh;  ///< Path of the mesh of the first frame; none: its implicit surface.
  bool refine_initial = false;      ///< Split edges of the mesh that are longer than r.
  Parameters parameters;
  bool estimate_spacing = false;       ///< Take r from the particles of the first frame.
  std::uint64_t first = 0;             ///< Index of the first frame in the bag.
  std::optional<std::uint64_t> last;   ///< Index of the last frame; none: that of the bag.
  std::optional<std::size_t> threads;  ///< At most this many; none: all there are.
  bool pipeline = false;               ///< Make the implicit surface of a frame while the one before is tracked.
  bool check = false;                  ///< Check the mesh of every frame.
  /// What of the particles bags and mesh files are to have at the vertices: see read_particle_attributes().
  std::vector<std::string> interpolate;

  std::string out;                                      ///< Folder of the mesh sequence.
  std::optional<MeshFormat> format = MeshFormat::kPly;  ///< None: no mesh files, and the folder is not touched.
  std::string surface;                                  ///< Folder for the implicit surfaces.
  std::string vdb;                                      ///< Folder for φ.
  /// First and last of frames whose flagged, complex, marked … cells are written into `out`.
  std::vector<std::pair<std::uint64_t, std::uint64_t>> debug_cells;
  std::string out_bag;
  std::string report;

  std::string checkpoint;               ///< Where to keep a checkpoint.
  std::uint64_t checkpoint_every = 10;  ///< Frames from one to the next, at least 1.
  std::string resume;                   ///< Checkpoint to go on from.

  bool quiet = false;     ///< Print errors only.
  bool progress = false;  ///< Keep a line of progress on the terminal.
};

/// How a run went.
struct OfflineSummary {
  std::size_t tracked = 0;  ///< Frames.
  std::size_t skipped = 0;  ///< Frames that could not be read or used.
  bool interrupted = false;
};

/// Tracks a mesh through the frames of a bag. A frame that cannot be read or used is said, skipped, and counted.
/// However the run ends, everything that was written is complete. One that goes on from a checkpoint writes what it
/// would have written if it had never ended.
/// \param stop the run ends after the current frame once this is true.
/// \param out receives what was found and, at the end, a table of times.
/// \param err receives warnings and progress.
/// \throw ParameterError if an option does not fit the bag, or a parameter is invalid.
/// \throw InputError, MeshError, ParticleError if the bag, mesh, first frame or checkpoint cannot be used.
/// \throw TrackingError if a frame cannot be tracked, or fails the check that was asked for.
/// \throw OutputError if something cannot be written.
OfflineSummary run_offline(const OfflineOptions& options, const std::atomic<bool>& stop, std::ostream& out,
                           std::ostream& err);

}  // namespace particle_surface_tracker
