#include "tracker_state_bytes.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

// By name and as text, which reads back exactly: a checkpoint tells what each value was for.
void put_parameters(ByteWriter& bytes, const Parameters& parameters) {
  bytes.put(static_cast<std::uint64_t>(parameter_table().size()));
  for (const ParameterInfo& info : parameter_table()) {
    bytes.put(std::string_view(info.name));
    bytes.put(std::string_view(get_parameter(parameters, info.name)));
  }
}

Parameters read_parameters(ByteReader& bytes) {
  Parameters parameters;
  std::set<std::string> names;
  const std::size_t count = bytes.length(2 * sizeof(std::uint64_t), "parameter");
  for (std::size_t n = 0; n < count; ++n) {
    const std::string name = bytes.text("name of a parameter");
    set_parameter(parameters, name, bytes.text("value of a parameter"));
    names.insert(name);
  }
  for (const ParameterInfo& info : parameter_table()) {
    if (names.count(info.name) == 0) {
      throw InputError(
          fmt::format("it has no parameter {}, so another version of this program has written it; go on "
                      "with that one",
                      info.name));
    }
  }
  return parameters;
}

void put_attributes(ByteWriter& bytes, const VertexAttributes& attributes) {
  bytes.put(static_cast<std::uint64_t>(attributes.count()));
  for (std::size_t n = 0; n < attributes.count(); ++n) {
    const VertexAttribute& attribute = attributes[n];
    bytes.put(std::string_view(attribute.name));
    bytes.put(static_cast<std::uint8_t>(attribute.use));
    bytes.put(attribute.initial_value);
    bytes.put(attribute.values);
  }
}

AttributeUse read_use(ByteReader& bytes) {
  switch (bytes.number<std::uint8_t>("use of an attribute")) {
    case static_cast<std::uint8_t>(AttributeUse::kOutput):
      return AttributeUse::kOutput;
    case static_cast<std::uint8_t>(AttributeUse::kInternal):
      return AttributeUse::kInternal;
    default:
      throw InputError("an attribute is for nobody");
  }
}

void read_attributes(ByteReader& bytes, VertexAttributes& attributes) {
  // The least that one takes: length of its name, use, lengths of both arrays.
  const std::size_t count = bytes.length(3 * sizeof(std::uint64_t) + 1, "attribute");
  for (std::size_t n = 0; n < count; ++n) {
    const std::string name = bytes.text("name of an attribute");
    const AttributeUse use = read_use(bytes);
    const auto initial = bytes.numbers<float>("initial value of an attribute");
    auto values = bytes.numbers<float>("value of an attribute");
    const bool fits = initial.empty() ? values.empty()
                                      : values.size() / initial.size() == attributes.vertex_count() &&
                                            values.size() % initial.size() == 0;
    if (!fits) {
      throw InputError(fmt::format("attribute '{}' has {} values of {} components for {} vertices", name, values.size(),
                                   initial.size(), attributes.vertex_count()));
    }
    if (attributes.add(name, initial.size(), initial, use) != n) {
      throw InputError(fmt::format("attribute '{}' is not where it should be", name));
    }
    attributes[n].values = std::move(values);
  }
}

void put_mesh(ByteWriter& bytes, const TriangleMesh& mesh) {
  bytes.put(mesh.positions());
  bytes.put(mesh.triangles());
  bytes.put(mesh.ids());
  bytes.put(mesh.next_id());
  put_attributes(bytes, mesh.attributes());
}

TriangleMesh read_mesh(ByteReader& bytes) {
  auto positions = bytes.triples<Vec3f, float>("vertex");
  auto triangles = bytes.triples<Triangle, std::uint32_t>("triangle");
  auto ids = bytes.numbers<std::uint32_t>("id");
  const auto next_id = bytes.number<std::uint32_t>("next id");
  TriangleMesh mesh(std::move(positions), std::move(triangles), std::move(ids));
  mesh.reserve_ids(next_id);
  read_attributes(bytes, mesh.attributes());
  return mesh;
}

void put_particles(ByteWriter& bytes, const ParticleFrame& particles) {
  bytes.put(particles.stamp_ns);
  bytes.put(particles.positions);
  bytes.put(particles.ids);
  bytes.put(particles.velocities);
}

ParticleFrame read_particles(ByteReader& bytes) {
  ParticleFrame particles;
  particles.stamp_ns = bytes.number<std::int64_t>("stamp");
  particles.positions = bytes.triples<Vec3f, float>("particle");
  particles.ids = bytes.numbers<std::uint32_t>("id of a particle");
  particles.velocities = bytes.triples<Vec3f, float>("velocity");
  return particles;
}

void put_detection(ByteWriter& bytes, const Detection& detection) {
  bytes.put(detection.flagged_vertices);
  bytes.put(detection.flagged_cells);
  bytes.put(static_cast<std::uint64_t>(detection.unreached_vertices));
}

Detection read_detection(ByteReader& bytes) {
  Detection detection;
  detection.flagged_vertices = bytes.numbers<std::uint32_t>("flagged vertex");
  detection.flagged_cells = bytes.triples<openvdb::Coord, std::int32_t>("flagged cell");
  detection.unreached_vertices = bytes.number<std::uint64_t>("number of unreached vertices");
  return detection;
}

}  // namespace

void put_tracker_state(ByteWriter& bytes, const TrackerState& state) {
  put_parameters(bytes, state.parameters);
  put_mesh(bytes, state.frame.mesh);
  put_particles(bytes, state.frame.particles);
  bytes.put(state.frame.particles_frame);
  put_detection(bytes, state.frame.detection);
  bytes.put(state.frame.band);
  bytes.put(static_cast<std::uint64_t>(state.frame.original_vertices));
}

TrackerState read_tracker_state(ByteReader& bytes) {
  TrackerState state;
  state.parameters = read_parameters(bytes);
  state.frame.mesh = read_mesh(bytes);
  state.frame.particles = read_particles(bytes);
  state.frame.particles_frame = bytes.number<std::uint64_t>("index of the frame");
  state.frame.detection = read_detection(bytes);
  state.frame.band = bytes.number<double>("band");
  state.frame.original_vertices = bytes.number<std::uint64_t>("number of original vertices");
  return state;
}

}  // namespace particle_surface_tracker
