#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/particle_frame.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker::test {

/// A recorded sequence: the particles of every frame, and the mesh that bounds the liquid of the first.
struct Sequence {
  double spacing = 0.0;  ///< r [m].
  TriangleMesh mesh;
  std::vector<ParticleFrame> frames;
};

/// All frames of a bag, or its first `count`.
/// \throw InputError, ParticleError
std::vector<ParticleFrame> read_particle_bag(const std::string& path, const std::string& topic,
                                             std::optional<std::size_t> count = std::nullopt);

/// The folder of the recorded sequences: environment variable PST_DATA_DIR, else shared/data beside the project.
std::string sequence_folder();

/// Why a sequence cannot be read, in words; empty where its files are there.
std::string why_absent(const std::string& name);

/// Reads NAME.bag, NAME.ply and the spacing in NAME.json.
/// \throw InputError, MeshError, ParticleError
Sequence load_sequence(const std::string& name, std::optional<std::size_t> count = std::nullopt);

}  // namespace particle_surface_tracker::test

/// Skips the running test, and says why, where a sequence is not on this machine.
#define PST_SKIP_WITHOUT(name)                                                         \
  do {                                                                                 \
    const std::string pst_reason = ::particle_surface_tracker::test::why_absent(name); \
    if (!pst_reason.empty()) GTEST_SKIP() << pst_reason;                               \
  } while (false)
