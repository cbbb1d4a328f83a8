// Peak memory of tracking a large body: 260,000 particles, 400,000 triangles or a little more. `--mesh=FILE` takes the
// body from a file, else it is a procedural one.

#include <cstdio>
#include <exception>
#include <string>

#include "filled_body.h"
#include "particle_surface_tracker/core/mesh_refinement.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "support/detailed_body.h"

namespace particle_surface_tracker {
namespace {

constexpr std::size_t kParticles = 260000;
constexpr std::size_t kTriangles = 400000;
constexpr double kLargest = 1.5;  // [GiB]
constexpr int kFrames = 5;

TriangleMesh fine_mesh(const std::string& file) {
  TriangleMesh mesh = file.empty() ? test::DetailedBody(0.03).mesh() : read_initial_mesh(file).mesh;
  for (double longest = 0.1; mesh.triangle_count() < kTriangles; longest *= 0.95) split_long_edges(mesh, longest);
  return mesh;
}

void measure(const std::string& file) {
  const FilledBody body = fill_body(fine_mesh(file), kParticles);
  Tracker tracker(body.parameters);
  FrameReport report = tracker.start(body.mesh, body.particles);
  ParticleFrame frame = body.particles;
  for (int n = 1; n <= kFrames; ++n) {
    frame = next_frame(frame);
    report = tracker.advance(frame, static_cast<std::uint64_t>(n));
  }
  const double peak = static_cast<double>(report.peak_rss_bytes) / (1 << 30);
  std::printf("%zu particles, %zu triangles, %d frames: peak memory %.2f GiB (at most %.1f): %s\n", report.particles,
              report.triangles, kFrames, peak, kLargest, peak <= kLargest ? "met" : "NOT MET");
}

}  // namespace
}  // namespace particle_surface_tracker

int main(int argc, char** argv) {
  const std::string option = "--mesh=";
  const std::string argument = argc > 1 ? argv[1] : "";
  if (argc > 2 || (argc == 2 && argument.rfind(option, 0) != 0)) {
    std::fprintf(stderr, "memory_benchmark: expected at most --mesh=FILE\n");
    return 1;
  }
  try {
    particle_surface_tracker::measure(argc == 2 ? argument.substr(option.size()) : "");
  } catch (const std::exception& error) {
    std::fprintf(stderr, "memory_benchmark: %s\n", error.what());
    return 2;
  }
  return 0;
}
