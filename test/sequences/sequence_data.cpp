#include "sequences/sequence_data.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/ros/particle_bag.h"
#include "particle_surface_tracker/ros/particle_conversion.h"

namespace particle_surface_tracker::test {

namespace {

std::string path_of(const std::string& name, const std::string& extension) {
  return (std::filesystem::path(sequence_folder()) / (name + extension)).string();
}

double read_spacing(const std::string& path) {
  std::ifstream file(path);
  const nlohmann::json facts = nlohmann::json::parse(file, nullptr, /*allow_exceptions=*/false);
  if (!facts.is_object() || !facts.contains("r_m")) throw InputError(path + ": no particle spacing r_m in it");
  return facts["r_m"].get<double>();
}

}  // namespace

std::vector<ParticleFrame> read_particle_bag(const std::string& path, const std::string& topic,
                                             std::optional<std::size_t> count) {
  ParticleBag bag(path, topic);
  std::vector<ParticleFrame> frames;
  const std::size_t size = std::min(bag.size(), count.value_or(bag.size()));
  for (std::size_t n = 0; n < size; ++n) frames.push_back(to_particle_frame(*bag.read(n)));
  return frames;
}

std::string sequence_folder() {
  const char* folder = std::getenv("PST_DATA_DIR");
  return folder != nullptr ? folder : PST_DEFAULT_DATA_DIR;
}

std::string why_absent(const std::string& name) {
  std::string absent;
  for (const char* extension : {".bag", ".ply", ".json"}) {
    const std::string path = path_of(name, extension);
    if (absent.empty() && !std::filesystem::exists(path)) absent = path;
  }
  if (absent.empty()) return "";
  return "the recorded sequence '" + name + "' is not here: no " + absent +
         "; PST_DATA_DIR names the folder of the sequences";
}

Sequence load_sequence(const std::string& name, std::optional<std::size_t> count) {
  Sequence sequence;
  sequence.spacing = read_spacing(path_of(name, ".json"));
  sequence.mesh = read_initial_mesh(path_of(name, ".ply")).mesh;
  sequence.frames = read_particle_bag(path_of(name, ".bag"), "/particles", count);
  return sequence;
}

}  // namespace particle_surface_tracker::test
