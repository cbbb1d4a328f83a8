#include "random_bodies.h"

#include <algorithm>
#include <cmath>
#include <random>

#include "support/shapes.h"

namespace particle_surface_tracker::test {

namespace {

using openvdb::Coord;

class CaseMaker {
 public:
  explicit CaseMaker(std::uint32_t seed) : random_(seed) {}

  RemeshingCase make() {
    result_.h = one_in(2) ? 0.125 : 0.1;
    const int bodies = 1 + number(4);
    std::vector<TriangleMesh> parts;
    for (int body = 0; body < bodies; ++body) {
      parts.push_back(body > 0 && one_in(8) ? parts.back() : make_body());
      if (one_in(8)) parts.back() = turned(parts.back());
    }
    TriangleMesh all = joined(parts);
    round_coordinates(all);
    result_.mesh = TriangleMesh(all.positions(), all.triangles());
    make_request();
    return std::move(result_);
  }

 private:
  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  int number(int end) { return std::uniform_int_distribution<int>(0, end - 1)(random_); }
  bool one_in(int count) { return number(count) == 0; }

  TriangleMesh make_body() {
    const double h = result_.h;
    const Vec3d center = Vec3d(uniform(-5, 5), uniform(-5, 5), uniform(-5, 5)) * h;
    switch (number(6)) {
      case 0:
        result_.description += "tiny sphere; ";
        return make_sphere(center, h * std::pow(10.0, uniform(-2.0, 0.0)), 1 + number(2));
      case 1:
        result_.description += "torus; ";
        return make_torus(center, h * uniform(2.0, 8.0), h * uniform(0.1, 2.0), 5 + number(40), 3 + number(12));
      case 2:
        result_.description += "box; ";
        return make_box(center, center + h * Vec3d(uniform(0.1, 9), uniform(0.1, 9), uniform(0.1, 9)));
      case 3: {
        result_.description += "flat sphere; ";
        TriangleMesh mesh = make_sphere({0.0, 0.0, 0.0}, h * uniform(3.0, 9.0), 2 + number(3));
        const int axis = number(3);
        const double share = std::pow(10.0, uniform(-3.0, -0.3));
        for (Vec3f& p : mesh.positions()) {
          p[axis] *= static_cast<float>(share);
          p += center.cast<float>();
        }
        return mesh;
      }
      default:
        result_.description += "sphere; ";
        return make_sphere(center, h * uniform(0.7, 9.0), 1 + number(4));
    }
  }

  void round_coordinates(TriangleMesh& mesh) {
    if (!one_in(3)) return;
    const double step = result_.h / (1 << number(4));
    result_.description += "on multiples of " + std::to_string(step / result_.h) + " h; ";
    for (Vec3f& p : mesh.positions()) {
      for (int axis = 0; axis < 3; ++axis) {
        p[axis] = static_cast<float>(std::round(static_cast<double>(p[axis]) / step) * step);
      }
    }
  }

  void make_request() {
    const MeshLattice lattice(result_.mesh.positions(), result_.mesh.triangles(), result_.h);
    const std::vector<Coord> cells = lattice.cells();
    const double flagged = one_in(3) ? 0.0 : std::pow(10.0, uniform(-2.5, 0.0));
    const double matched = one_in(2) ? 0.0 : std::pow(10.0, uniform(-3.0, -0.5));
    for (const Coord& cell : cells) {
      if (uniform(0.0, 1.0) < flagged) result_.request.flagged_cells.push_back(cell);
      if (uniform(0.0, 1.0) < matched) result_.request.nodes.push_back(cell.offsetBy(number(3) - 1, number(3) - 1, 0));
    }
    std::vector<Coord>& nodes = result_.request.nodes;
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      result_.request.gamma.push_back(static_cast<float>(uniform(-1.0, 1.0) * result_.h));
    }
    if (one_in(2)) result_.request.is_liquid = [](const Coord& node) { return (node.x() & 1) != 0; };
  }

  std::mt19937 random_;
  RemeshingCase result_;
};

}  // namespace

RemeshingCase make_remeshing_case(std::uint32_t seed) {
  return CaseMaker(seed).make();
}

}  // namespace particle_surface_tracker::test
