#include "butterfly.h"

#include <cmath>

namespace particle_surface_tracker {

namespace {

constexpr std::uint32_t kRegularValence = 6;
constexpr double kTwoPi = 2.0 * 3.14159265358979323846;

/// Weight of neighbour i of a vertex of valence K; neighbour 0 is the other end of the edge.
double irregular_weight(std::uint32_t i, std::uint32_t valence) {
  if (valence == 3) return i == 0 ? 5.0 / 12.0 : -1.0 / 12.0;
  if (valence == 4) return i == 0 ? 3.0 / 8.0 : (i == 2 ? -1.0 / 8.0 : 0.0);
  const double angle = kTwoPi * i / valence;
  return (0.25 + std::cos(angle) + 0.5 * std::cos(2.0 * angle)) / valence;
}

/// Stencil around the start of a half-edge: ¾ of the vertex itself, the rest from its neighbours.
Vec3d irregular_position(const EditableSurface& surface, std::uint32_t half_edge, std::uint32_t valence) {
  Vec3d sum = 0.75 * surface.position(surface.start(half_edge));
  std::uint32_t h = half_edge;
  for (std::uint32_t i = 0; i < valence; ++i) {
    sum += irregular_weight(i, valence) * surface.position(surface.end(h));
    h = surface.turn(h);
  }
  return sum;
}

/// One half of the regular stencil: an end, and the apex and wing on one side.
Vec3d regular_half(const EditableSurface& surface, std::uint32_t half_edge) {
  const std::uint32_t to_apex = next_half_edge(half_edge);
  const Vec3d wings = surface.position(surface.apex(surface.twin(to_apex))) +
                      surface.position(surface.apex(surface.twin(previous_half_edge(half_edge))));
  return surface.position(surface.start(half_edge)) / 2.0 + surface.position(surface.apex(half_edge)) / 8.0 -
         wings / 16.0;
}

}  // namespace

Vec3d edge_midpoint(const EditableSurface& surface, std::uint32_t half_edge) {
  return 0.5 * (surface.position(surface.start(half_edge)) + surface.position(surface.end(half_edge)));
}

Vec3d butterfly_position(const EditableSurface& surface, std::uint32_t half_edge) {
  const std::uint32_t twin = surface.twin(half_edge);
  const std::uint32_t start_valence = surface.valence(surface.start(half_edge));
  const std::uint32_t end_valence = surface.valence(surface.start(twin));
  if (start_valence == kRegularValence && end_valence == kRegularValence) {
    return regular_half(surface, half_edge) + regular_half(surface, twin);
  }
  if (end_valence == kRegularValence) return irregular_position(surface, half_edge, start_valence);
  if (start_valence == kRegularValence) return irregular_position(surface, twin, end_valence);
  return 0.5 * (irregular_position(surface, half_edge, start_valence) + irregular_position(surface, twin, end_valence));
}

}  // namespace particle_surface_tracker
