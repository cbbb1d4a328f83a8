#include "stages/lattice/lattice_cases.h"

#include <utility>

#include <fmt/format.h>

#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

const char* name_of(Coordinates coordinates) {
  switch (coordinates) {
    case Coordinates::kRandom:
      return "random";
    case Coordinates::kOnLattice:
      return "on the lattice";
    case Coordinates::kNearLattice:
      return "near the lattice";
    case Coordinates::kNudged:
      return "next to the lattice";
    case Coordinates::kFarAway:
      return "far away";
  }
  return "";
}

double cell_size(Coordinates coordinates) {
  return coordinates == Coordinates::kNearLattice ? 0.1 : 0.5;
}

/// Draws positions in a box of 4³ cells.
class Places {
 public:
  Places(std::uint32_t seed, Coordinates coordinates) : random_(seed), coordinates_(coordinates) {}

  Vec3f draw() { return Vec3f(coordinate(), coordinate(), coordinate()); }

  std::uint32_t below(std::uint32_t count) {
    return std::uniform_int_distribution<std::uint32_t>(0, count - 1)(random_);
  }

 private:
  float coordinate() {
    const double h = cell_size(coordinates_);
    if (coordinates_ == Coordinates::kRandom)
      return static_cast<float>(std::uniform_real_distribution<>(-2, 2)(random_) * h);
    const int k = static_cast<int>(below(5)) - 2;
    if (coordinates_ == Coordinates::kNearLattice) return static_cast<float>(k * h);
    const double offset = coordinates_ == Coordinates::kFarAway ? 0x1p20 : 0.0;
    const double fraction = below(2) == 0 ? 0.0 : 0.25 * static_cast<double>(below(4));
    const double nudge = coordinates_ == Coordinates::kNudged ? 0x1p-24 * (static_cast<int>(below(3)) - 1) : 0.0;
    return static_cast<float>((offset + k + fraction) * h + nudge);
  }

  std::mt19937 random_;
  Coordinates coordinates_;
};

LatticeCase named(std::string name, double h, TriangleMesh mesh) {
  return {std::move(name), h, std::move(mesh)};
}

}  // namespace

LatticeCase random_triangles(std::uint32_t seed, Coordinates coordinates) {
  Places places(seed, coordinates);
  std::vector<Vec3f> positions;
  for (int n = 0; n < 8; ++n) positions.push_back(places.draw());
  positions.push_back(positions[places.below(8)]);
  std::vector<Triangle> triangles;
  for (int n = 0; n < 16; ++n) triangles.push_back({places.below(9), places.below(9), places.below(9)});
  return {fmt::format("triangles {}, seed {}", name_of(coordinates), seed), cell_size(coordinates),
          TriangleMesh(std::move(positions), std::move(triangles))};
}

LatticeCase random_closed_mesh(std::uint32_t seed, Coordinates coordinates) {
  Places places(seed, coordinates);
  TriangleMesh mesh = places.below(2) == 0 ? make_sphere(Vec3d::Zero(), 1.0, static_cast<int>(places.below(2)))
                                           : make_torus(Vec3d::Zero(), 1.0, 0.5, 4, 3);
  for (Vec3f& position : mesh.positions()) position = places.draw();
  return {fmt::format("closed mesh {}, seed {}", name_of(coordinates), seed), cell_size(coordinates), std::move(mesh)};
}

std::vector<LatticeCase> aligned_bodies() {
  const TriangleMesh box = make_box({0, 0, 0}, {2, 2, 2});
  const TriangleMesh needle = make_box({-40, 0, 0}, {40, 0x1p-20, 0x1p-20});
  const TriangleMesh octahedron = make_sphere({0, 0, 0}, 2.0, 0);
  std::vector<LatticeCase> cases;
  cases.push_back(named("box on planes", 0.5, box));
  cases.push_back(named("box inside out", 0.5, turned(box)));
  cases.push_back(named("box between planes", 0.5, make_box({0.25, 0.25, 0.25}, {1.75, 1.75, 1.75})));
  cases.push_back(named("box in one cell", 0.5, make_box({0.1, 0.1, 0.1}, {0.2, 0.2, 0.2})));
  cases.push_back(named("two copies", 0.5, joined({box, box})));
  cases.push_back(named("copy inside out", 0.5, joined({box, turned(box)})));
  cases.push_back(named("boxes with a common face", 0.5, joined({box, make_box({2, 0, 0}, {3, 2, 2})})));
  cases.push_back(named("boxes with a common edge", 0.5, joined({box, make_box({2, 2, 0}, {3, 3, 2})})));
  cases.push_back(named("boxes with a common corner", 0.5, joined({box, make_box({2, 2, 2}, {3, 3, 3})})));
  cases.push_back(named("overlapping boxes", 0.5, joined({box, make_box({1, 1, 1}, {3, 3, 3})})));
  cases.push_back(named("cavity", 0.5, joined({box, turned(make_box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5}))})));
  cases.push_back(named("nested", 0.5, joined({box, make_box({0.5, 0.5, 0.5}, {1.5, 1.5, 1.5})})));
  cases.push_back(named("flat box", 0.5, make_box({0, 0, 1}, {2, 2, 1})));
  cases.push_back(named("thread box", 0.5, make_box({0, 1, 1}, {2, 1, 1})));
  cases.push_back(named("point box", 0.5, make_box({1, 1, 1}, {1, 1, 1})));
  cases.push_back(named("octahedron on nodes", 0.5, octahedron));
  cases.push_back(named("octahedron, two copies", 0.5, joined({octahedron, octahedron})));
  cases.push_back(named("octahedron, fine lattice", 0.125, octahedron));
  cases.push_back(named("needle along x", 0.5, needle));
  cases.push_back(named("huge octahedron", 1.0, make_sphere({0, 0, 0}, 20.0, 0)));
  cases.push_back(named("far octahedron", 0.5, make_sphere({0x1p19, -0x1p19, 0x1p19}, 2.0, 0)));
  cases.push_back(named("sphere", 0.25, make_sphere({0, 0, 0}, 1.0, 2)));
  cases.push_back(named("torus", 0.25, make_torus({0, 0, 0}, 1.0, 0.5, 8, 8)));
  return cases;
}

}  // namespace particle_surface_tracker::test
