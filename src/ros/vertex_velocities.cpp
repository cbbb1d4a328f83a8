#include "vertex_velocities.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>

namespace particle_surface_tracker {
namespace {

/// Finds the place of an id. Meshes keep their vertices in the order of the ids as a rule, so sorting costs little.
class PlaceIndex {
 public:
  explicit PlaceIndex(const VertexPlaces& places) : places_(places), order_(places.ids.size()) {
    std::iota(order_.begin(), order_.end(), std::uint32_t{0});
    std::sort(order_.begin(), order_.end(),
              [this](std::uint32_t a, std::uint32_t b) { return places_.ids[a] < places_.ids[b]; });
  }

  const Vec3f* find(std::uint32_t id) const {
    const auto found = std::lower_bound(order_.begin(), order_.end(), id, [this](std::uint32_t n, std::uint32_t value) {
      return places_.ids[n] < value;
    });
    return found != order_.end() && places_.ids[*found] == id ? &places_.positions[*found] : nullptr;
  }

 private:
  const VertexPlaces& places_;
  std::vector<std::uint32_t> order_;
};

struct Velocities {
  std::vector<Vec3f> values;
  std::vector<char> known;
};

// Of the neighbours of a vertex.
struct Mean {
  Vec3d sum = Vec3d::Zero();
  int count = 0;
};

// Gives the vertices next to known ones the mean over the triangles between. False when there are none.
bool spread_one_ring(const std::vector<Triangle>& triangles, Velocities& velocities) {
  std::map<std::uint32_t, Mean> means;
  for (const Triangle& triangle : triangles) {
    for (const std::uint32_t to : triangle) {
      if (velocities.known[to]) continue;
      for (const std::uint32_t from : triangle) {
        if (!velocities.known[from]) continue;
        Mean& mean = means[to];
        mean.sum += velocities.values[from].cast<double>();
        ++mean.count;
      }
    }
  }
  for (const auto& [vertex, mean] : means) {
    velocities.values[vertex] = (mean.sum / mean.count).cast<float>();
    velocities.known[vertex] = 1;
  }
  return !means.empty();
}

// Triangles with a vertex whose velocity is not known.
std::vector<Triangle> open_triangles(const std::vector<Triangle>& triangles, const Velocities& velocities) {
  std::vector<Triangle> open;
  std::copy_if(triangles.begin(), triangles.end(), std::back_inserter(open), [&](const Triangle& triangle) {
    return std::any_of(triangle.begin(), triangle.end(), [&](std::uint32_t v) { return !velocities.known[v]; });
  });
  return open;
}

}  // namespace

std::vector<Vec3f> vertex_velocities(const VertexPlaces& before, const TriangleMesh& mesh, double seconds) {
  const PlaceIndex places(before);
  const std::size_t count = mesh.vertex_count();
  Velocities velocities{std::vector<Vec3f>(count, Vec3f::Zero()), std::vector<char>(count, 0)};
  for (std::size_t v = 0; v < count; ++v) {
    const Vec3f* place = places.find(mesh.ids()[v]);
    if (place == nullptr) continue;
    velocities.values[v] = ((mesh.positions()[v] - *place).cast<double>() / seconds).cast<float>();
    velocities.known[v] = 1;
  }
  std::vector<Triangle> open = open_triangles(mesh.triangles(), velocities);
  while (!open.empty() && spread_one_ring(open, velocities)) open = open_triangles(open, velocities);
  return velocities.values;
}

}  // namespace particle_surface_tracker
