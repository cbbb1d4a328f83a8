#include "support/shapes.h"

#include <cmath>
#include <map>

namespace particle_surface_tracker::test {

namespace {

const double kPi = std::acos(-1.0);

}  // namespace

TriangleMesh make_sphere(const Vec3d& center, double radius, int levels) {
  std::vector<Vec3d> directions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<Triangle> triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                     {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> midpoints;
    const auto midpoint = [&](std::uint32_t a, std::uint32_t b) {
      const auto [entry, is_new] = midpoints.try_emplace(std::minmax(a, b), directions.size());
      if (is_new) directions.push_back((directions[a] + directions[b]).normalized());
      return entry->second;
    };
    std::vector<Triangle> finer;
    for (const auto& [a, b, c] : triangles) {
      const std::uint32_t ab = midpoint(a, b);
      const std::uint32_t bc = midpoint(b, c);
      const std::uint32_t ca = midpoint(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    triangles = std::move(finer);
  }
  std::vector<Vec3f> positions;
  for (const Vec3d& d : directions) positions.push_back((center + radius * d).cast<float>());
  return TriangleMesh(std::move(positions), std::move(triangles));
}

TriangleMesh make_torus(const Vec3d& center, double ring_radius, double tube_radius, int rings, int sides) {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sides; ++j) {
      const double u = 2 * kPi * i / rings;
      const double v = 2 * kPi * j / sides;
      const double w = ring_radius + tube_radius * std::cos(v);
      positions.push_back((center + Vec3d(w * std::cos(u), w * std::sin(u), tube_radius * std::sin(v))).cast<float>());
      const std::uint32_t a = i * sides + j;
      const std::uint32_t b = ((i + 1) % rings) * sides + j;
      const std::uint32_t c = ((i + 1) % rings) * sides + (j + 1) % sides;
      const std::uint32_t d = i * sides + (j + 1) % sides;
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
    }
  }
  return TriangleMesh(std::move(positions), std::move(triangles));
}

TriangleMesh make_box(const Vec3d& lower, const Vec3d& upper) {
  std::vector<Vec3f> positions;
  for (int corner = 0; corner < 8; ++corner) {
    positions.emplace_back(static_cast<float>(corner & 1 ? upper.x() : lower.x()),
                           static_cast<float>(corner & 2 ? upper.y() : lower.y()),
                           static_cast<float>(corner & 4 ? upper.z() : lower.z()));
  }
  return TriangleMesh(std::move(positions), {{0, 2, 3},
                                             {0, 3, 1},
                                             {4, 5, 7},
                                             {4, 7, 6},
                                             {0, 1, 5},
                                             {0, 5, 4},
                                             {2, 6, 7},
                                             {2, 7, 3},
                                             {0, 4, 6},
                                             {0, 6, 2},
                                             {1, 3, 7},
                                             {1, 7, 5}});
}

TriangleMesh joined(const std::vector<TriangleMesh>& parts) {
  std::vector<Vec3f> positions;
  std::vector<Triangle> triangles;
  for (const TriangleMesh& part : parts) {
    const auto offset = static_cast<std::uint32_t>(positions.size());
    positions.insert(positions.end(), part.positions().begin(), part.positions().end());
    for (const auto& [a, b, c] : part.triangles()) triangles.push_back({a + offset, b + offset, c + offset});
  }
  return TriangleMesh(std::move(positions), std::move(triangles));
}

TriangleMesh turned(const TriangleMesh& mesh) {
  std::vector<Triangle> triangles = mesh.triangles();
  for (Triangle& t : triangles) std::swap(t[1], t[2]);
  return TriangleMesh(mesh.positions(), std::move(triangles));
}

double hash_noise(std::uint32_t seed, std::int32_t i, std::int32_t j, std::int32_t k, std::uint32_t axis) {
  std::uint64_t h = seed;
  for (const std::uint32_t v :
       {static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(j), static_cast<std::uint32_t>(k), axis}) {
    h = (h ^ v) * 0x9E3779B97F4A7C15ull;
    h ^= h >> 32;
  }
  return static_cast<double>(h >> 11) / static_cast<double>(1ull << 52) - 1.0;
}

}  // namespace particle_surface_tracker::test
