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
      place_on_mesh_edge(
          {on_faces.begin() + static_cast<std::ptrdiff_t>(begin), on_faces.begin() + static_cast<std::ptrdiff_t>(end)});
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

    Vec3d place(lattice_.plane(point.node.x()), lattice_.plane(point.node.y()), lattice_.plane(point.node.z()));
    place[point.axis] += point.place * h;
    std::array<double, 3> weights{1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
    if (doubled_area > 0.0) {
      const Vec3d unit = normal / doubled_area;
      weights = spread_weights(corners, unit, doubled_area, place);
      place = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
      // Three lattice edges that end in one node can be crossed next to it: in the triangle's plane, the points move
      // away from it.
      const double past_node = std::max(kFrontGap - point.place, 0.0) - std::max(kFrontGap - (1.0 - point.place), 0.0);
      const Vec3d along = Vec3d::Unit(point.axis) - unit[point.axis] * unit;
      weights = clamped_weights(corners, unit, doubled_area, place + past_node * h * along);
    }
    vertex.position = weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2];
    vertex.blend = {{t[0], weights[0]}, {t[1], weights[1]}, {t[2], weights[2]}};
  }

  /// Barycentric coordinates of a place in the plane of a triangle.
  static std::array<double, 3> weights_at(const std::array<Vec3d, 3>& corners, const Vec3d& unit, double doubled_area,
                                          const Vec3d& place) {
    std::array<double, 3> weights;
    for (int k = 0; k < 3; ++k) {
      const Vec3d& p = corners[(k + 1) % 3];
      weights[k] = (corners[(k + 2) % 3] - p).cross(place - p).dot(unit) / doubled_area;
    }
    return weights;
  }

  /// Weights that belong to a distance of two gaps from each side, or to a small part of the height.
  std::array<double, 3> gap_weights(const std::array<Vec3d, 3>& corners, double doubled_area) const {
    std::array<double, 3> gaps;
    for (int k = 0; k < 3; ++k) {
      const double side = (corners[(k + 2) % 3] - corners[(k + 1) % 3]).norm();
      gaps[k] = std::min(2.0 * kFrontGap * lattice_.h() * side / doubled_area, kGreatestGap);
    }
    return gaps;
  }

  /// Weights of a place that is moved away from the sides where it is closer than two gaps, to between one and two:
  /// what is apart stays apart.
  std::array<double, 3> spread_weights(const std::array<Vec3d, 3>& corners, const Vec3d& unit, double doubled_area,
                                       const Vec3d& place) const {
    std::array<double, 3> weights = weights_at(corners, unit, doubled_area, place);
    const std::array<double, 3> gaps = gap_weights(corners, doubled_area);
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
      weights[k] = std::max(weights[k], 0.0);
      if (weights[k] < gaps[k]) weights[k] = 0.5 * (gaps[k] + weights[k]);
      sum += weights[k];
    }
    for (double& weight : weights) weight /= sum;
    return weights;
  }

  /// Weights of a place that must not come closer to the sides than half a gap.
  std::array<double, 3> clamped_weights(const std::array<Vec3d, 3>& corners, const Vec3d& unit, double doubled_area,
                                        const Vec3d& place) const {
    std::array<double, 3> weights = weights_at(corners, unit, doubled_area, place);
    const std::array<double, 3> gaps = gap_weights(corners, doubled_area);
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) sum += weights[k] = std::max(weights[k], 0.25 * gaps[k]);
    for (double& weight : weights) weight /= sum;
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
