#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "patch_places.h"

namespace particle_surface_tracker::remeshing {

namespace {

/// How far a vertex is moved off another one; farther if there are many [cells].
constexpr double kNudge = 1.0e-3;
constexpr int kMostRounds = 16;

struct RoundedPlace {
  Vec3f position;
  std::uint32_t vertex;
};

bool comes_before(const RoundedPlace& p, const RoundedPlace& q) {
  return std::make_tuple(p.position.x(), p.position.y(), p.position.z(), p.vertex) <
         std::make_tuple(q.position.x(), q.position.y(), q.position.z(), q.vertex);
}

/// A small step, another one for every number, that changes the position also where floats are too coarse for it.
void nudge(Vec3d& position, int number, double h) {
  const int axis = number % 3;
  const double resolution = std::abs(position[axis]) * std::numeric_limits<float>::epsilon();
  const int steps = (number % 2 == 0 ? 1 : -1) * (1 + number / 3);
  position[axis] += steps * std::max(kNudge * h, 2.0 * resolution);
}

/// The vertices of the patch's triangles, each once.
std::vector<std::uint32_t> vertices_of(const Patch& patch) {
  std::vector<std::uint32_t> vertices;
  vertices.reserve(3 * patch.triangles.size());
  for (const Triangle& triangle : patch.triangles) vertices.insert(vertices.end(), triangle.begin(), triangle.end());
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

}  // namespace

void keep_places_apart(const std::vector<Vec3f>& positions, double h, Patch& patch) {
  const std::vector<std::uint32_t> vertices = vertices_of(patch);
  std::vector<RoundedPlace> places(vertices.size());
  for (int round = 0; round < kMostRounds; ++round) {
    for (std::size_t n = 0; n < vertices.size(); ++n) {
      const std::uint32_t v = vertices[n];
      places[n] = {patch.is_new(v) ? patch.vertex(v).position.cast<float>().eval() : positions[v], v};
    }
    std::sort(places.begin(), places.end(), comes_before);
    bool found = false;
    int equals = 0;
    for (std::size_t n = 1; n < places.size(); ++n) {
      equals = places[n].position == places[n - 1].position ? equals + 1 : 0;
      // Vertices of the mesh come first among equals, and stay.
      if (equals == 0 || !patch.is_new(places[n].vertex)) continue;
      nudge(patch.vertex(places[n].vertex).position, round + equals, h);
      found = true;
    }
    if (!found) return;
  }
}

}  // namespace particle_surface_tracker::remeshing
