#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bag_parts.h"
#include "particle_surface_tracker/io/checkpoint.h"
#include "particle_surface_tracker/ros/offline_runner.h"
#include "particle_surface_tracker/ros/particle_bag.h"

namespace particle_surface_tracker {

/// How far the files of a run have got; of those that it writes.
struct OutputProgress {
  std::optional<std::uint64_t> report_bytes;
  std::optional<BagProgress> bag;
};

/// How far a run has got.
struct RunProgress {
  std::uint64_t first = 0;               ///< Index of the run's first frame.
  std::uint64_t next = 0;                ///< Index of the frame that it goes on with.
  std::vector<std::string> interpolate;  ///< Fields of the particles that meshes so far have.
  OutputProgress outputs;
};

/// Name of the section of a checkpoint.
constexpr const char* run_section = "track_bag";

std::string to_bytes(const RunProgress& progress);

/// \throw InputError if the bytes are none of to_bytes().
RunProgress run_progress_from(const std::string& bytes);

/// Checks that a run with these options is the one that a checkpoint was kept of.
/// \throw ParameterError if it has other parameters, another first frame or interpolates other fields.
/// \throw InputError if the checkpoint is none of a run, or the bag holds other particles than those of its last frame.
RunProgress require_this_run(const Checkpoint& checkpoint, const OfflineOptions& options, ParticleBag& bag);

}  // namespace particle_surface_tracker
