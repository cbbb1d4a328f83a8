#include "support/torture_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <utility>

#include <Eigen/Geometry>

#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

const double kPi = std::acos(-1.0);

/// The mesh after each position has been moved.
template <typename Move>
TriangleMesh moved(const TriangleMesh& mesh, Move&& move) {
  std::vector<Vec3f> positions;
  for (const Vec3f& p : mesh.positions()) {
    const Vec3d place = move(p.cast<double>());
    positions.push_back(place.cast<float>());
  }
  return TriangleMesh(std::move(positions), mesh.triangles());
}

TriangleMesh snapped(const TriangleMesh& mesh, double spacing) {
  return moved(mesh, [&](const Vec3d& p) { return Vec3d((p / spacing).array().round() * spacing); });
}

TriangleMesh shifted(const TriangleMesh& mesh, const Vec3d& way) {
  return moved(mesh, [&](const Vec3d& p) { return Vec3d(p + way); });
}

TriangleMesh stretched(const TriangleMesh& mesh, const Vec3d& factors) {
  return moved(mesh, [&](const Vec3d& p) { return Vec3d(p.cwiseProduct(factors)); });
}

/// Draws bodies around the origin, about 1 m in size.
class Bodies {
 public:
  Bodies(std::uint32_t seed, double h) : random_(seed), h_(h) {}

  /// A number in [0, 1).
  double uniform() { return static_cast<double>(random_()) / 4294967296.0; }

  std::uint32_t below(std::uint32_t count) { return random_() % count; }

  TriangleMesh draw(std::string& name) {
    static constexpr std::array<const char*, 8> kNames = {"sphere", "torus", "knot", "sliver",
                                                          "needle", "speck", "box",  "shells"};
    const std::uint32_t kind = below(kNames.size());
    name += std::string(name.empty() ? "" : ", ") + kNames[kind];
    if (kind == 6) return lattice_box();
    const TriangleMesh body = posed(shape(kind));
    return kind == 5 ? shifted(body, Vec3d(0.9 * spread(), 0.9 * spread(), 0.9 * spread())) : body;
  }

 private:
  double spread() { return 2.0 * uniform() - 1.0; }

  TriangleMesh shape(std::uint32_t kind) {
    const Vec3d origin = Vec3d::Zero();
    switch (kind) {
      case 0:
        return make_sphere(origin, 0.3 + 0.5 * uniform(), 3);
      case 1:
        return make_torus(origin, 0.4 + 0.4 * uniform(), 0.1 + 0.2 * uniform(), 32, 16);
      case 2:
        return make_knot(origin, 0.6 + 0.3 * uniform(), 0.05 + 0.15 * uniform(), 96, 8);
      case 3:
        return stretched(make_sphere(origin, 0.8, 3), Vec3d(1.0, 1.0, 0.5 * h_ * uniform()));
      case 4:
        return stretched(make_sphere(origin, 1.0, 2), Vec3d(1.0, 0.6 * h_ * uniform(), 0.6 * h_ * uniform()));
      case 5:
        return make_sphere(origin, 0.45 * h_ * uniform(), 1);
      default:
        return joined({make_sphere(origin, 0.8, 3), turned(make_sphere(origin, 0.8 - 0.7 * h_, 3)),
                       make_sphere(origin, 0.8 - 1.6 * h_, 3), turned(make_sphere(origin, 0.2, 2))});
    }
  }

  TriangleMesh posed(const TriangleMesh& body) {
    const Eigen::Quaterniond turn = Eigen::Quaterniond(spread(), spread(), spread(), spread() + 1e-3).normalized();
    const Vec3d way(0.6 * spread(), 0.6 * spread(), 0.6 * spread());
    return moved(body, [&](const Vec3d& p) { return Vec3d(turn * p + way); });
  }

  TriangleMesh lattice_box() {
    Vec3d lower;
    Vec3d upper;
    for (int axis = 0; axis < 3; ++axis) {
      const double first = std::floor(spread() * 0.6 / h_);
      lower[axis] = first * h_;
      upper[axis] = (first + 1 + below(static_cast<std::uint32_t>(0.8 / h_))) * h_;
    }
    return make_box(lower, upper);
  }

  std::mt19937 random_;
  double h_;
};

/// Twice the signed area of a triangle of a plane.
double area_of(const Vec3f& a, const Vec3f& b, double x, double y) {
  return (static_cast<double>(b.x()) - a.x()) * (y - a.y()) - (static_cast<double>(b.y()) - a.y()) * (x - a.x());
}

}  // namespace

TriangleMesh make_knot(const Vec3d& center, double size, double tube_radius, int rings, int sides) {
  const auto curve = [&](double t) -> Vec3d {
    return Vec3d(std::sin(t) + 2.0 * std::sin(2.0 * t), std::cos(t) - 2.0 * std::cos(2.0 * t), -std::sin(3.0 * t)) *
           (size / 3.0);
  };
  TriangleMesh torus = make_torus(Vec3d::Zero(), 1.0, 0.5, rings, sides);
  std::vector<Vec3f>& positions = torus.positions();
  for (int i = 0; i < rings; ++i) {
    const double t = 2.0 * kPi * i / rings;
    const Vec3d ahead = (curve(t + 1e-4) - curve(t - 1e-4)).normalized();
    const Vec3d across = ahead.cross(curve(t) + Vec3d(0.0, 0.0, 5.0 * size)).normalized();
    const Vec3d up = across.cross(ahead);
    for (int j = 0; j < sides; ++j) {
      const double v = 2.0 * kPi * j / sides;
      const Vec3d place = center + curve(t) + tube_radius * (std::cos(v) * across + std::sin(v) * up);
      positions[static_cast<std::size_t>(i * sides + j)] = place.cast<float>();
    }
  }
  return torus;
}

TortureMesh make_torture_mesh(std::uint32_t seed) {
  TortureMesh torture;
  torture.h = seed % 2 == 0 ? 0.125 : 0.1;
  Bodies bodies(seed, torture.h);
  std::vector<TriangleMesh> parts;
  const std::uint32_t count = 2 + bodies.below(5);
  while (parts.size() < count) {
    parts.push_back(bodies.draw(torture.name));
    if (bodies.below(6) == 0) {
      parts.back() = turned(parts.back());
      torture.name += " inside out";
    }
    if (bodies.below(6) == 0) {
      parts.push_back(parts.back());
      torture.name += " twice";
    }
  }
  torture.mesh = joined(parts);
  const std::uint32_t place = bodies.below(8);
  if (place < 2) {
    torture.mesh = snapped(torture.mesh, place == 0 ? torture.h : 0.5 * torture.h);
    torture.name += place == 0 ? "; on nodes" : "; on halves of cells";
  } else if (place == 2) {
    torture.mesh = shifted(torture.mesh, Vec3d(1024.0, -2048.0, 512.0));
    torture.name += "; far away";
  }
  torture.name += "; seed " + std::to_string(seed);
  return torture;
}

std::vector<TortureMesh> chosen_torture_meshes() {
  constexpr double kH = 0.125;
  const Vec3d origin = Vec3d::Zero();
  const TriangleMesh ball = make_sphere(origin, 0.5, 3);
  const TriangleMesh cube = make_box({0, 0, 0}, {0.5, 0.5, 0.5});
  const auto at = [](const TriangleMesh& mesh, double x, double y, double z) { return shifted(mesh, Vec3d(x, y, z)); };
  const TriangleMesh shell = joined({ball, turned(make_sphere(origin, 0.5 - 0.3 * kH, 3))});
  const TriangleMesh ring = make_torus(origin, 0.5, 0.15, 40, 16);
  return {
      {"two spheres", kH, joined({ball, at(ball, 0.61, 0.07, 0.03)})},
      {"spheres that touch in a point", kH, joined({ball, at(ball, 1.0, 0, 0)})},
      {"spheres closer than a cell", kH, joined({ball, at(ball, 1.0 + 0.3 * kH, 0.01, 0.02)})},
      {"sphere twice", kH, joined({ball, ball})},
      {"sphere and its inside out copy", kH, joined({ball, turned(ball)})},
      {"sphere three times, once inside out", kH, joined({ball, turned(ball), ball})},
      {"sphere inside out", kH, turned(ball)},
      {"sphere and an inside out sphere across it", kH, joined({ball, turned(at(ball, 0.5, 0, 0))})},
      {"boxes with a common face", kH, joined({cube, at(cube, 0.5, 0, 0)})},
      {"boxes with part of a face in common", kH, joined({cube, at(cube, 0.5, 0.25, 0.125)})},
      {"boxes with a common edge", kH, joined({cube, at(cube, 0.5, 0.5, 0)})},
      {"boxes with a common corner", kH, joined({cube, at(cube, 0.5, 0.5, 0.5)})},
      {"box twice", kH, joined({cube, cube})},
      {"boxes that overlap on the lattice", kH, joined({cube, at(cube, 0.25, 0.25, 0.25)})},
      {"boxes between planes", kH, at(joined({cube, at(cube, 0.25, 0.25, 0.25)}), 0.06, 0.07, 0.08)},
      {"box in a box", kH, joined({cube, make_box({0.125, 0.125, 0.125}, {0.375, 0.375, 0.375})})},
      {"box with a cavity", kH, joined({cube, turned(make_box({0.125, 0.125, 0.125}, {0.375, 0.375, 0.375}))})},
      {"box with a cavity that touches its face", kH,
       joined({cube, turned(make_box({0, 0.125, 0.125}, {0.25, 0.375, 0.375}))})},
      {"thin shell", kH, shell},
      {"thin shell and a sphere across it", kH, joined({shell, at(ball, 0.5, 0.1, 0)})},
      {"two thin shells", kH, joined({shell, at(shell, 0.6, 0.05, 0.1)})},
      {"linked rings", kH, joined({ring, at(stretched(ring, {1.0, 0.9, 1.1}), 0.5, 0, 0)})},
      {"ring on nodes", kH, snapped(ring, kH)},
      {"ring on halves of cells, twice", kH, joined({snapped(ring, 0.5 * kH), snapped(ring, 0.5 * kH)})},
      {"knot", kH, make_knot(origin, 0.7, 0.1, 120, 8)},
      {"knot that runs through itself", kH, make_knot(origin, 0.7, 0.25, 120, 10)},
      {"thread", kH, stretched(make_torus(origin, 0.5, 0.02, 60, 6), {1.0, 1.0, 1.0})},
      {"thread in a sphere, inside out", kH, joined({ball, turned(make_torus(origin, 0.3, 0.02, 40, 6))})},
      {"sheet through a sphere", kH, joined({ball, stretched(make_sphere(origin, 1.0, 4), {1.0, 1.0, 0.01})})},
      {"flat sheet on a plane", kH, stretched(make_sphere(origin, 0.5, 3), {1.0, 1.0, 0.0})},
      {"specks", kH,
       joined({make_sphere({0.06, 0.06, 0.06}, 0.03, 1), turned(make_sphere({0.31, 0.06, 0.06}, 0.03, 1)),
               make_sphere({0.125, 0.125, 0.375}, 0.03, 0), ball})},
      {"large triangles", kH, joined({make_sphere(origin, 1.0, 0), make_sphere({0.3, 0.2, 0.1}, 1.0, 0)})},
      {"large box and a fine sphere", kH, joined({make_box({-1, -1, -1}, {1, 1, 0}), ball})},
      {"far away", kH, at(joined({ball, at(ball, 0.6, 0, 0)}), 4096.0, -8192.0, 2048.0)},
  };
}

double covered_volume(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, int lines) {
  Eigen::AlignedBox3d box;
  for (const Vec3f& p : positions) box.extend(p.cast<double>());
  if (box.isEmpty()) return 0.0;
  const Vec3d width = box.sizes() / lines;
  // Not in the middle of the columns, where the lines of symmetrical meshes lie.
  const auto line_at = [&](int axis, int n) { return box.min()[axis] + (n + 0.4637 + 0.05 * axis) * width[axis]; };
  const auto first_line = [&](int axis, double x) {
    return std::max(0, static_cast<int>(std::floor((x - box.min()[axis]) / width[axis] - 1.0)));
  };
  const auto last_line = [&](int axis, double x) {
    return std::min(lines - 1, static_cast<int>(std::floor((x - box.min()[axis]) / width[axis] + 1.0)));
  };
  std::vector<std::vector<std::pair<double, int>>> crossings(static_cast<std::size_t>(lines) * lines);
  for (const auto& [a, b, c] : triangles) {
    const std::array<const Vec3f*, 3> t = {&positions[a], &positions[b], &positions[c]};
    Eigen::AlignedBox3d bounds;
    for (const Vec3f* p : t) bounds.extend(p->cast<double>());
    for (int i = first_line(0, bounds.min().x()); i <= last_line(0, bounds.max().x()); ++i) {
      for (int j = first_line(1, bounds.min().y()); j <= last_line(1, bounds.max().y()); ++j) {
        const double x = line_at(0, i);
        const double y = line_at(1, j);
        const std::array<double, 3> areas = {area_of(*t[1], *t[2], x, y), area_of(*t[2], *t[0], x, y),
                                             area_of(*t[0], *t[1], x, y)};
        const bool is_up = areas[0] >= 0.0 && areas[1] >= 0.0 && areas[2] >= 0.0;
        const bool is_down = areas[0] <= 0.0 && areas[1] <= 0.0 && areas[2] <= 0.0;
        if (is_up == is_down) continue;
        const double z =
            (areas[0] * t[0]->z() + areas[1] * t[1]->z() + areas[2] * t[2]->z()) / (areas[0] + areas[1] + areas[2]);
        crossings[static_cast<std::size_t>(i) * lines + j].emplace_back(z, is_up ? -1 : 1);
      }
    }
  }
  double length = 0.0;
  for (auto& line : crossings) {
    std::sort(line.begin(), line.end());
    int winding = 0;
    for (std::size_t n = 0; n + 1 < line.size(); ++n) {
      winding += line[n].second;
      if (winding >= 1) length += line[n + 1].first - line[n].first;
    }
  }
  return length * width.x() * width.y();
}

}  // namespace particle_surface_tracker::test
