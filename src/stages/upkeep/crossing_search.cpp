#include "crossing_search.h"

#include <algorithm>

#include <tbb/parallel_for.h>

#include "triangle_crossing.h"

namespace particle_surface_tracker {

namespace {

/// Triangles that one task looks at.
constexpr std::size_t kTrianglesPerTask = 256;

struct Box {
  Vec3f low, high;

  bool meets(const Vec3f& a, const Vec3f& b, const Vec3f& c) const {
    return (a.cwiseMin(b).cwiseMin(c).array() <= high.array()).all() &&
           (a.cwiseMax(b).cwiseMax(c).array() >= low.array()).all();
  }
};

PlacedTriangle placed(const ConnectedTriangles& mesh, std::uint32_t triangle) {
  const Triangle& t = mesh.triangles[triangle];
  return place_triangle(t, {mesh.positions[t[0]].cast<double>(), mesh.positions[t[1]].cast<double>(),
                            mesh.positions[t[2]].cast<double>()});
}

bool cross(const ConnectedTriangles& mesh, std::uint32_t one, std::uint32_t other) {
  return triangles_cross(placed(mesh, one), placed(mesh, other));
}

/// The triangles within two rings of one whose boxes meet its own, one after the other.
class Neighborhood {
 public:
  explicit Neighborhood(const ConnectedTriangles& mesh) : mesh_(mesh) {}

  const std::vector<std::uint32_t>& find(std::uint32_t triangle) {
    const Triangle& t = mesh_.triangles[triangle];
    const Vec3f &a = mesh_.positions[t[0]], &b = mesh_.positions[t[1]], &c = mesh_.positions[t[2]];
    box_ = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
    // The vertices of the first ring, each with a half-edge from it; most are met more than once.
    ring_.clear();
    for (std::uint32_t k = 0; k < 3; ++k) {
      mesh_.for_each_around(3 * triangle + k, [&](std::uint32_t h) {
        const std::uint32_t beyond = next_half_edge(h);
        ring_.emplace_back(start_of(mesh_.triangles, beyond), beyond);
      });
    }
    std::sort(ring_.begin(), ring_.end());
    found_.clear();
    for (std::size_t n = 0; n < ring_.size(); ++n) {
      if (n > 0 && ring_[n].first == ring_[n - 1].first) continue;
      mesh_.for_each_around(ring_[n].second, [&](std::uint32_t h) { add(h / 3); });
    }
    std::sort(found_.begin(), found_.end());
    found_.erase(std::unique(found_.begin(), found_.end()), found_.end());
    return found_;
  }

 private:
  void add(std::uint32_t triangle) {
    const Triangle& t = mesh_.triangles[triangle];
    if (box_.meets(mesh_.positions[t[0]], mesh_.positions[t[1]], mesh_.positions[t[2]])) found_.push_back(triangle);
  }

  const ConnectedTriangles& mesh_;
  Box box_{};
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ring_;
  std::vector<std::uint32_t> found_;
};

}  // namespace

std::vector<CrossingPair> find_crossings(const ConnectedTriangles& mesh, const std::vector<std::uint32_t>& around) {
  const std::size_t tasks = (around.size() + kTrianglesPerTask - 1) / kTrianglesPerTask;
  std::vector<std::vector<CrossingPair>> found(tasks);
  tbb::parallel_for(std::size_t{0}, tasks, [&](std::size_t task) {
    Neighborhood neighborhood(mesh);
    const std::size_t end = std::min(around.size(), (task + 1) * kTrianglesPerTask);
    for (std::size_t n = task * kTrianglesPerTask; n < end; ++n) {
      for (const std::uint32_t other : neighborhood.find(around[n])) {
        if (other != around[n] && cross(mesh, around[n], other)) found[task].emplace_back(around[n], other);
      }
    }
  });
  std::vector<CrossingPair> pairs;
  for (const auto& part : found) pairs.insert(pairs.end(), part.begin(), part.end());
  return pairs;
}

bool find_crossing(const ConnectedTriangles& mesh, const std::vector<std::uint32_t>& around, CrossingPair& pair) {
  if (pair.first != pair.second && cross(mesh, pair.first, pair.second)) return true;
  Neighborhood neighborhood(mesh);
  for (const std::uint32_t triangle : around) {
    for (const std::uint32_t other : neighborhood.find(triangle)) {
      if (other == triangle || !cross(mesh, triangle, other)) continue;
      pair = {triangle, other};
      return true;
    }
  }
  return false;
}

}  // namespace particle_surface_tracker
