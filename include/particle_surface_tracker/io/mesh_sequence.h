#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>

#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/io/time_series.h"

namespace particle_surface_tracker {

enum class MeshFormat { kPly, kObj, kVtp, kGlb };

/// Writes the meshes of a sequence into one folder, one file per frame: `frame_000042.ply`; beside those of VTK also
/// their TimeSeries.
class MeshSequence {
 public:
  /// Makes the folder, and its parents, where they are missing, and tries whether files can be written there.
  /// \param next the first frame to be written, if the sequence of an earlier run goes on; none: it begins.
  /// \throw OutputError if that fails.
  /// \throw InputError as TimeSeries, if it goes on.
  MeshSequence(std::string folder, MeshFormat format, std::optional<std::uint64_t> next = std::nullopt);

  /// \param stamp_ns of the frame, not negative.
  /// \throw OutputError as write_ply(), write_obj(), write_vtp() and write_glb().
  void write(const TriangleMesh& mesh, std::uint64_t frame, std::int64_t stamp_ns);

  const std::string& folder() const { return folder_; }

  /// How many files of frames there are in the folder, of this format, that this sequence has not written: what reads
  /// the folder takes them for its own.
  std::size_t count_of_others() const;

 private:
  std::string folder_;
  MeshFormat format_;
  std::optional<TimeSeries> series_;
  std::set<std::string> written_;
};

}  // namespace particle_surface_tracker
