#include "ros/surface/surface_identity.h"

#include <fmt/format.h>
#include <zlib.h>

#include "particle_surface_tracker/io/byte_stream.h"

namespace particle_surface_tracker {

const std::vector<std::string>& surface_parameters() {
  static const std::vector<std::string> names = {"particle_spacing", "dx_phi",         "influence_radius",
                                                 "surface_radius",   "eigenvalue_low", "eigenvalue_high"};
  return names;
}

std::string describe_surface_parameters(const Parameters& parameters) {
  std::string text;
  for (const std::string& name : surface_parameters()) {
    text += fmt::format("{}{}={}", text.empty() ? "" : " ", name, get_parameter(parameters, name));
  }
  return text;
}

std::uint32_t checksum_of(const ParticleFrame& particles) {
  ByteWriter bytes;
  bytes.put(particles.ids);
  bytes.put(particles.positions);
  const std::string& all = bytes.bytes();
  return static_cast<std::uint32_t>(
      ::crc32_z(::crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(all.data()), all.size()));
}

}  // namespace particle_surface_tracker
