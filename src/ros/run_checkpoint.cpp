#include "run_checkpoint.h"

#include <string_view>

#include <fmt/format.h>

#include "parameter_agreement.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/byte_stream.h"
#include "particle_surface_tracker/ros/particle_conversion.h"

namespace particle_surface_tracker {
namespace {

void require_same_particles(const TrackedFrame& tracked, const std::string& path, ParticleBag& bag) {
  const std::uint64_t index = tracked.particles_frame;
  if (index < bag.size()) {
    const ParticleFrame frame = to_particle_frame(*bag.read(index));
    if (frame.stamp_ns == tracked.particles.stamp_ns && frame.ids == tracked.particles.ids &&
        frame.positions == tracked.particles.positions) {
      return;
    }
  }
  throw InputError(fmt::format(
      "frame {} of bag '{}' is not the one that the checkpoint was made of; it is one of another bag or topic", index,
      path));
}

}  // namespace

std::string to_bytes(const RunProgress& progress) {
  const OutputProgress& outputs = progress.outputs;
  ByteWriter bytes;
  bytes.put(progress.first);
  bytes.put(progress.next);
  bytes.put(static_cast<std::uint64_t>(progress.interpolate.size()));
  for (const std::string& field : progress.interpolate) bytes.put(std::string_view(field));
  bytes.put(static_cast<std::uint8_t>(outputs.report_bytes.has_value()));
  bytes.put(outputs.report_bytes.value_or(0));
  bytes.put(static_cast<std::uint8_t>(outputs.bag.has_value()));
  bytes.put(static_cast<std::uint8_t>(outputs.bag.value_or(BagProgress()).has_whole));
  bytes.put(outputs.bag.value_or(BagProgress()).parts);
  return bytes.bytes();
}

RunProgress run_progress_from(const std::string& bytes) {
  ByteReader reader(bytes);
  RunProgress progress;
  progress.first = reader.number<std::uint64_t>("first frame");
  progress.next = reader.number<std::uint64_t>("next frame");
  constexpr std::size_t shortest_text = sizeof(std::uint64_t);
  progress.interpolate.resize(reader.length(shortest_text, "interpolated fields"));
  for (std::string& field : progress.interpolate) field = reader.text("name of a field");
  const bool has_report = reader.number<std::uint8_t>("report") != 0;
  const auto report_bytes = reader.number<std::uint64_t>("length of the report");
  if (has_report) progress.outputs.report_bytes = report_bytes;
  const bool has_bag = reader.number<std::uint8_t>("bag") != 0;
  BagProgress bag;
  bag.has_whole = reader.number<std::uint8_t>("whole bag") != 0;
  bag.parts = reader.number<std::uint64_t>("number of parts");
  if (has_bag) progress.outputs.bag = bag;
  reader.expect_end();
  return progress;
}

RunProgress require_this_run(const Checkpoint& checkpoint, const OfflineOptions& options, ParticleBag& bag) {
  const auto section = checkpoint.sections.find(run_section);
  if (section == checkpoint.sections.end()) throw InputError("it is no checkpoint of track_bag, but of a node");
  RunProgress progress = run_progress_from(section->second);
  if (progress.first != options.first) {
    throw ParameterError(
        fmt::format("--first {}: the run of the checkpoint began with frame {}", options.first, progress.first));
  }
  if (progress.interpolate != options.interpolate) {
    throw ParameterError(
        fmt::format("--interpolate: '{}', but the run of the checkpoint had '{}'; its meshes would "
                    "not have the same fields",
                    fmt::join(options.interpolate, ","), fmt::join(progress.interpolate, ",")));
  }
  require_agreement(checkpoint.tracker.parameters, options.parameters, Agreement::kAll,
                    /*any_spacing*/ options.estimate_spacing);
  require_same_particles(checkpoint.tracker.frame, options.bag, bag);
  return progress;
}

}  // namespace particle_surface_tracker
