#include "crossing_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <tbb/parallel_for.h>

#include "triangle_overlap.h"

namespace particle_surface_tracker {

namespace {

/// Triangles that one task looks at.
constexpr std::size_t kTrianglesPerTask = 256;

/// A bound on the relative error of a height above a plane.
constexpr double kRounding = 1e-13;

struct Box {
  Vec3f low, high;

  bool meets(const Vec3f& a, const Vec3f& b, const Vec3f& c) const {
    return (a.cwiseMin(b).cwiseMin(c).array() <= high.array()).all() &&
           (a.cwiseMax(b).cwiseMax(c).array() >= low.array()).all();
  }
};

Corners corners_of(const ConnectedTriangles& mesh, std::uint32_t triangle, std::size_t first) {
  const Triangle& t = mesh.triangles[triangle];
  return {mesh.positions[t[first]].cast<double>(), mesh.positions[t[(first + 1) % 3]].cast<double>(),
          mesh.positions[t[(first + 2) % 3]].cast<double>()};
}

/// Whether some corners of a triangle, from `begin` on, are all on one side of the plane of another one, by more than
/// rounding can be wrong.
bool lies_beside(const Corners& triangle, std::size_t begin, const Corners& plane) {
  const Vec3d normal = area_normal(plane);
  double low = std::numeric_limits<double>::max(), high = std::numeric_limits<double>::lowest(), farthest = 0.0;
  for (std::size_t k = begin; k < 3; ++k) {
    const Vec3d offset = triangle[k] - plane[0];
    const double height = normal.dot(offset);
    low = std::min(low, height);
    high = std::max(high, height);
    farthest = std::max(farthest, offset.squaredNorm());
  }
  const double rounding = kRounding * std::sqrt(normal.squaredNorm() * farthest);
  return low > rounding || high < -rounding;
}

bool cross(const ConnectedTriangles& mesh, std::uint32_t one, std::uint32_t other) {
  std::size_t shared = 0, in_one = 0, in_other = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (mesh.triangles[one][i] != mesh.triangles[other][j]) continue;
      ++shared;
      in_one = i;
      in_other = j;
    }
  }
  if (shared > 1) return false;
  const Corners first = corners_of(mesh, one, in_one), second = corners_of(mesh, other, in_other);
  if (lies_beside(second, shared, first) || lies_beside(first, shared, second)) return false;
  return shared == 0 ? triangles_touch(first, second) : triangles_cross_at_shared_corner(first, second);
}

/// The triangles within two rings of one whose boxes meet its own, one after the other.
class Neighborhood {
 public:
  explicit Neighborhood(const ConnectedTriangles& mesh) : mesh_(mesh) {}

  const std::vector<std::uint32_t>& find(std::uint32_t triangle) {
    const Triangle& t = mesh_.triangles[triangle];
    const Vec3f &a = mesh_.positions[t[0]], &b = mesh_.positions[t[1]], &c = mesh_.positions[t[2]];
    box_ = {a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c)};
    found_.clear();
    ring_.clear();
    for (std::uint32_t k = 0; k < 3; ++k) {
      mesh_.for_each_around(3 * triangle + k, [&](std::uint32_t h) {
        ring_.emplace_back(end_of(mesh_.triangles, h), next_half_edge(h));
      });
    }
    // Most vertices of the ring are met several times.
    std::sort(ring_.begin(), ring_.end());
    for (std::size_t n = 0; n < ring_.size(); ++n) {
      if (n > 0 && ring_[n].first == ring_[n - 1].first) continue;
      mesh_.for_each_around(ring_[n].second, [&](std::uint32_t beyond) { add(beyond / 3); });
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
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ring_;  // a vertex, a half-edge from it
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
