#include "front_places.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace particle_surface_tracker::remeshing {

namespace {

/// Greatest part of a triangle's height, and of a mesh edge shared by the points on it, that the gap may take.
constexpr double kGreatestGap = 0.05;

class FrontPlacer {
 public:
  FrontPlacer(const MeshLattice& lattice, Patch& patch) : lattice_(lattice), patch_(patch) {}

  void run() {
    std::vector<PatchVertex*> on_faces;
    for (PatchVertex& vertex : patch_.vertices) {
      if (vertex.point.kind == LatticePoint::Kind::kOnLatticeEdge) {
        place_in_triangle(vertex);
      } else {
        on_faces.push_back(&vertex);
      }
    }
    std::sort(on_faces.begin(), on_faces.end(), [&](const PatchVertex* p, const PatchVertex* q) {
      if (p->point.a != q->point.a) return p->point.a < q->point.a;
      if (p->point.b != q->point.b) return p->point.b < q->point.b;
      return lattice_.comes_before(p->point, q->point);
    });
    for (std::size_t begin = 0, end = 0; begin < on_faces.size(); begin = end) {
      const LatticePoint& first = on_faces[begin]->point;
      while (end < on_faces.size() && on_faces[end]->point.a == first.a && on_faces[end]->point.b == first.b) ++end;
      place_on_mesh_edge({on_faces.begin() + static_cast<std::ptrdiff_t>(begin),
                          on_faces.begin() + static_cast<std::ptrdiff_t>(end)});
    }
  }

 private:
  Vec3d position(std::uint32_t vertex) const { return lattice_.positions()[vertex].cast<double>(); }

  /// Spreads the points of one mesh edge, in their order, so that they and the ends of the edge keep the gap.
  void place_on_mesh_edge(const std::vector<PatchVertex*>& points) const {
    const std::uint32_t a = points.front()->point.a;
    const std::uint32_t b = points.front()->point.b;
    const Vec3d from = position(a);
    const Vec3d to = position(b);
    const double parts = static_cast<double>(points.size()) + 1.0;
    const double length = (to - from).norm();
    const double gap = length > 0.0 ? std::min(kFrontGap * lattice_.h() / length, 0.5 / parts) : 0.5 / parts;
    std::vector<double> places;
    double lowest = gap;
    for (const PatchVertex* point : points) {
      places.push_back(std::max(point->point.place, lowest));
      lowest = places.back() + gap;
    }
    double highest = 1.0 - gap;
    for (std::size_t n = points.size(); n-- > 0;) {
      places[n] = std::min(places[n], highest);
      highest = places[n] - gap;
      points[n]->position = from + places[n] * (to - from);
      points[n]->blend = {{a, 1.0 - places[n]}, {b, places[n]}};
    }
  }

  void place_in_triangle(PatchVertex& vertex) const {
    const LatticePoint& point = vertex.point;
    const Triangle& t = lattice_.triangles()[point.a];
    const std::array<Vec3d, 3> corners{position(t[0]), position(t[1]), position(t[2])};
    const Vec3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
    const double doubled_area = normal.norm();
    const double h = lattice_.h();

    // Three lattice edges that end in one node can be crossed next to it: in the triangle's plane, the points move
    // away from it.
    Vec3d place(lattice_.plane(point.node.x()), lattice_.plane(point.node.y()), lattice_.plane(point.node.z()));
    place[point.axis] += point.place * h;
    Vec3d along = Vec3d::Unit(point.axis);
    if (doubled_area > 0.0) along -= along.dot(normal) / (doubled_area * doubled_area) * normal;
    place += h * (std::max(kFrontGap - point.place, 0.0) - std::max(kFrontGap - (1.0 - point.place), 0.0)) * along;

    std::array<double, 3> weights{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
    if (doubled_area > 0.0) weights = weights_within(corners, normal, doubled_area, place);
    vertex.position = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    vertex.blend = {{t[0], weights[0]}, {t[1], weights[1]}, {t[2], weights[2]}};
  }

  /// Barycentric coordinates of a place, pulled into the triangle.
  std::array<double, 3> weights_within(const std::array<Vec3d, 3>& corners, const Vec3d& normal, double doubled_area,
                                       const Vec3d& place) const {
    std::array<double, 3> weights;
    std::array<double, 3> least;
    double sum = 0.0;
    double least_sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      const Vec3d& p = corners[(k + 1) % 3];
      const Vec3d side = corners[(k + 2) % 3] - p;
      least[k] = std::min(kFrontGap * lattice_.h() * side.norm() / doubled_area, kGreatestGap);
      least_sum += least[k];
      weights[k] = std::max(side.cross(place - p).dot(normal) / (doubled_area * doubled_area) - least[k], 0.0);
      sum += weights[k];
    }
    if (!(sum > 0.0)) return {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
    for (int k = 0; k < 3; ++k) weights[k] = least[k] + weights[k] * (1.0 - least_sum) / sum;
    return weights;
  }

  const MeshLattice& lattice_;
  Patch& patch_;
};

}  // namespace

void place_front_vertices(const MeshLattice& lattice, Patch& patch) {
  FrontPlacer(lattice, patch).run();
}

}  // namespace particle_surface_tracker::remeshing
