#include "ros/surface/surface_conversion.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "ros/flat_arrays.h"
#include "ros/surface/surface_identity.h"

namespace particle_surface_tracker {
namespace {

using Leaf = openvdb::FloatTree::LeafNodeType;

constexpr std::size_t kWords = 8;  // Of the mask of a block.

[[noreturn]] void fail(const std::string& what) {
  throw InputError("the message of an implicit surface is damaged: " + what);
}

void put_field(const openvdb::FloatGrid& field, ParticleSurface& message) {
  message.background = field.background();
  for (auto leaf = field.tree().cbeginLeaf(); leaf; ++leaf) {
    const openvdb::Coord& origin = leaf->origin();
    message.block_origins.insert(message.block_origins.end(), {origin.x(), origin.y(), origin.z()});
    for (std::size_t x = 0; x < kWords; ++x) {
      message.block_masks.push_back(leaf->getValueMask().getWord<openvdb::Index64>(static_cast<openvdb::Index>(x)));
    }
    for (auto node = leaf->cbeginValueOn(); node; ++node) message.values.push_back(*node);
  }
}

void check_field(const ParticleSurface& message) {
  const std::size_t blocks = message.block_origins.size() / 3;
  if (!std::isfinite(message.dx) || message.dx <= 0.0) fail(fmt::format("dx is {}", message.dx));
  if (!std::isfinite(message.background)) fail("background is not finite");
  if (message.block_origins.size() % 3 != 0) fail("block_origins holds no triples");
  if (message.block_masks.size() != kWords * blocks) {
    fail(fmt::format("block_masks has {} words for {} blocks", message.block_masks.size(), blocks));
  }
  std::size_t nodes = 0;
  for (const std::uint64_t word : message.block_masks) nodes += std::bitset<64>(word).count();
  if (message.values.size() != nodes) {
    fail(fmt::format("it has {} values for {} nodes", message.values.size(), nodes));
  }
  if (!std::all_of(message.values.begin(), message.values.end(), [](float value) { return std::isfinite(value); })) {
    fail("a value is not finite");
  }
}

openvdb::FloatGrid::Ptr read_field(const ParticleSurface& message) {
  check_field(message);
  auto field = openvdb::FloatGrid::create(message.background);
  field->setName("phi_tilde");
  field->setTransform(openvdb::math::Transform::createLinearTransform(message.dx));
  auto value = message.values.begin();
  for (std::size_t block = 0; 3 * block < message.block_origins.size(); ++block) {
    const openvdb::Coord origin(&message.block_origins[3 * block]);
    if (((origin.x() | origin.y() | origin.z()) & 7) != 0) fail("a block does not begin at a multiple of 8");
    if (field->tree().probeConstLeaf(origin) != nullptr) fail("a block comes twice");
    auto* leaf = new Leaf(origin, message.background, /*active*/ false);
    field->tree().addLeaf(leaf);
    Leaf::NodeMaskType mask;
    for (std::size_t x = 0; x < kWords; ++x) {
      mask.getWord<openvdb::Index64>(static_cast<openvdb::Index>(x)) = message.block_masks[kWords * block + x];
    }
    leaf->setValueMask(mask);
    float* values = leaf->buffer().data();
    for (auto node = mask.beginOn(); node; ++node) values[node.pos()] = *value++;
  }
  return field;
}

void put_triangulation(const SurfaceTriangulation& triangulation, ParticleSurface& message) {
  message.vertices = flat<float>(triangulation.vertices);
  message.triangles = flat<std::uint32_t>(triangulation.triangles);
  for (const CutCell& cell : triangulation.cells) {
    message.cell_origins.insert(message.cell_origins.end(), {cell.origin.x(), cell.origin.y(), cell.origin.z()});
    message.cell_triangles.push_back(cell.first_triangle);
  }
}

void check_triangulation(const ParticleSurface& message) {
  if (message.vertices.size() % 3 != 0 || message.triangles.size() % 3 != 0) {
    fail("vertices or triangles holds no triples");
  }
  if (!std::all_of(message.vertices.begin(), message.vertices.end(), [](float x) { return std::isfinite(x); })) {
    fail("a vertex is not finite");
  }
  const std::size_t vertex_count = message.vertices.size() / 3;
  for (const std::uint32_t vertex : message.triangles) {
    if (vertex >= vertex_count) fail(fmt::format("a triangle names vertex {} of {}", vertex, vertex_count));
  }
  const auto& begins = message.cell_triangles;
  if (message.cell_origins.size() != 3 * begins.size()) {
    fail(fmt::format("it has {} cell_triangles for {} cell_origins", begins.size(), message.cell_origins.size()));
  }
  if (begins.empty() ? !message.triangles.empty()
                     : begins.back() != message.triangles.size() / 3 || !std::is_sorted(begins.begin(), begins.end())) {
    fail("cell_triangles does not cover the triangles");
  }
}

SurfaceTriangulation read_triangulation(const ParticleSurface& message) {
  check_triangulation(message);
  SurfaceTriangulation triangulation;
  triangulation.vertices.reserve(message.vertices.size() / 3);
  for (std::size_t n = 0; n < message.vertices.size(); n += 3)
    triangulation.vertices.emplace_back(&message.vertices[n]);
  triangulation.triangles.reserve(message.triangles.size() / 3);
  for (std::size_t n = 0; n < message.triangles.size(); n += 3) {
    triangulation.triangles.push_back({message.triangles[n], message.triangles[n + 1], message.triangles[n + 2]});
  }
  triangulation.cells.reserve(message.cell_triangles.size());
  for (std::size_t n = 0; n < message.cell_triangles.size(); ++n) {
    triangulation.cells.push_back({openvdb::Coord(&message.cell_origins[3 * n]), message.cell_triangles[n]});
  }
  return triangulation;
}

}  // namespace

ParticleSurface to_surface_message(const std_msgs::Header& header, const ImplicitSurface& surface,
                                   const ParticleFrame& particles, const Parameters& parameters) {
  ParticleSurface message;
  message.header = header;
  message.particles = static_cast<std::uint32_t>(particles.size());
  message.particles_checksum = checksum_of(particles);
  message.parameters = describe_surface_parameters(parameters);
  message.dx = surface.dx;
  put_field(*surface.field, message);
  put_triangulation(surface.triangulation, message);
  return message;
}

std::shared_ptr<const ImplicitSurface> to_surface(const ParticleSurface& message) {
  auto surface = std::make_shared<ImplicitSurface>();
  surface->dx = message.dx;
  surface->field = read_field(message);
  surface->triangulation = read_triangulation(message);
  return surface;
}

void require_made_of(const ParticleSurface& message, const ParticleFrame& particles, const Parameters& parameters) {
  const std::string wanted = describe_surface_parameters(parameters);
  if (message.parameters != wanted) {
    throw InputError(fmt::format("the implicit surface was made with other parameters: {} there, {} here",
                                 message.parameters, wanted));
  }
  if (message.particles != particles.size() || message.particles_checksum != checksum_of(particles)) {
    throw InputError(
        fmt::format("the implicit surface was made of other particles: {} there, {} here, with the same "
                    "stamp",
                    message.particles, particles.size()));
  }
}

}  // namespace particle_surface_tracker
