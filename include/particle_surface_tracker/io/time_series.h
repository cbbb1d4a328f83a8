#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace particle_surface_tracker {

/// The list by which ParaView knows when each mesh of a sequence is: `frames.pvd`, beside the meshes. It is whole after
/// every frame.
class TimeSeries {
 public:
  /// The series begins; the file of an older one stays until the first frame.
  explicit TimeSeries(const std::string& folder);

  /// The series of an earlier run goes on.
  /// \param next only its frames before this one are kept.
  /// \throw InputError if there is no series, it cannot be read, or it has no frame before `next`.
  TimeSeries(const std::string& folder, std::uint64_t next);

  /// \param file name of the frame's mesh in the folder.
  /// \param stamp_ns of the frame, not negative.
  /// \throw OutputError as write_ply().
  void add(const std::string& file, std::int64_t stamp_ns);

 private:
  std::string path_;
  std::vector<std::string> lines_;  ///< One per frame.
};

}  // namespace particle_surface_tracker
