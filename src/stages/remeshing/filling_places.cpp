#include <algorithm>
#include <array>

#include "front_places.h"
#include "lattice_parts.h"
#include "patch_places.h"

namespace particle_surface_tracker::remeshing {

namespace {

using openvdb::Coord;

/// Γ in a cell, trilinear between its corners; places are in [0, 1]³.
class CellGamma {
 public:
  CellGamma(const GammaNodes& gamma, const Coord& cell) {
    for (int corner = 0; corner < kCellCorners; ++corner) values_[corner] = gamma.value(corner_of(cell, corner));
  }

  double value_and_gradient(const Vec3d& p, Vec3d& gradient) const {
    double value = 0.0;
    gradient.setZero();
    for (int corner = 0; corner < kCellCorners; ++corner) {
      Vec3d weight, slope;
      for (int axis = 0; axis < 3; ++axis) {
        const bool upper = (corner >> axis & 1) != 0;
        weight[axis] = upper ? p[axis] : 1.0 - p[axis];
        slope[axis] = upper ? 1.0 : -1.0;
      }
      value += values_[corner] * weight.prod();
      gradient += values_[corner] * Vec3d(slope[0] * weight[1] * weight[2], weight[0] * slope[1] * weight[2],
                                          weight[0] * weight[1] * slope[2]);
    }
    return value;
  }

 private:
  std::array<double, kCellCorners> values_;
};

Vec3d node_position(const MeshLattice& lattice, const Coord& node) {
  return {lattice.plane(node.x()), lattice.plane(node.y()), lattice.plane(node.z())};
}

bool depends_on_matching(const GammaNodes& gamma, const LatticeEdge& edge) {
  return gamma.is_matched(edge.node) || gamma.is_matched(moved(edge.node, edge.axis, 1));
}

/// Where the mesh changes between inside and outside on an edge, as near to its outer end as possible: the others are
/// covered by it.
double outermost_crossing(GammaNodes& gamma, const LatticeEdge& edge) {
  const bool lower_is_inside = gamma.is_inside(edge.node);
  int winding = gamma.lattice().winding_number(edge.node);
  double place = 0.5;
  for (const EdgeCrossing& crossing : gamma.lattice().crossings_on(edge)) {
    const bool was_inside = winding >= 1;
    winding += crossing.step;
    if (was_inside == (winding >= 1)) continue;
    place = crossing.place;
    if (!lower_is_inside) break;
  }
  return place;
}

void place_on_edge(GammaNodes& gamma, PatchVertex& vertex) {
  const LatticeEdge edge{vertex.point.node, vertex.point.axis};
  double place;
  if (depends_on_matching(gamma, edge)) {
    const double a = gamma.value(edge.node);
    const double b = gamma.value(moved(edge.node, edge.axis, 1));
    place = a == b ? 0.5 : a / (a - b);
  } else {
    place = outermost_crossing(gamma, edge);
  }
  vertex.position = node_position(gamma.lattice(), edge.node);
  vertex.position[edge.axis] += std::clamp(place, kInnerGap, 1.0 - kInnerGap) * gamma.lattice().h();
}

/// Moves a place along the gradient to a zero of Γ in the cell.
Vec3d find_zero(const CellGamma& gamma, const Vec3d& start) {
  constexpr int kSteps = 6;
  constexpr double kLongestStep = 0.25;
  Vec3d place = start;
  for (int step = 0; step < kSteps; ++step) {
    Vec3d gradient;
    const double value = gamma.value_and_gradient(place, gradient);
    const double squared_slope = gradient.squaredNorm();
    if (!(squared_slope > 0.0)) break;
    Vec3d move = -value / squared_slope * gradient;
    if (move.norm() > kLongestStep) move *= kLongestStep / move.norm();
    place = (place + move).cwiseMax(kInnerGap).cwiseMin(1.0 - kInnerGap);
  }
  return place;
}

}  // namespace

void place_filling(GammaNodes& gamma, Patch& patch) {
  std::vector<Coord> nodes;
  for (const PatchVertex& vertex : patch.vertices) {
    if (vertex.kind == PatchVertex::Kind::kCenter) {
      for (int corner = 0; corner < kCellCorners; ++corner) nodes.push_back(corner_of(vertex.point.node, corner));
    } else if (vertex.kind == PatchVertex::Kind::kEdge) {
      const LatticeEdge edge{vertex.point.node, vertex.point.axis};
      if (!depends_on_matching(gamma, edge)) continue;
      nodes.push_back(edge.node);
      nodes.push_back(moved(edge.node, edge.axis, 1));
    }
  }
  gamma.measure(std::move(nodes));

  for (PatchVertex& vertex : patch.vertices) {
    if (vertex.kind == PatchVertex::Kind::kEdge) place_on_edge(gamma, vertex);
  }
  // The triangles around a centre begin with it and go once round its loop.
  for (std::size_t t = patch.first_filling; t < patch.triangles.size();) {
    const std::uint32_t center = patch.triangles[t][0];
    if (patch.vertex(center).kind != PatchVertex::Kind::kCenter) {
      ++t;
      continue;
    }
    Vec3d sum = Vec3d::Zero();
    const std::size_t begin = t;
    for (; t < patch.triangles.size() && patch.triangles[t][0] == center; ++t) {
      sum += patch.vertex(patch.triangles[t][1]).position;
    }
    const Coord& cell = patch.vertex(center).point.node;
    const double h = gamma.lattice().h();
    const Vec3d corner = node_position(gamma.lattice(), cell);
    const Vec3d middle = (sum / static_cast<double>(t - begin) - corner) / h;
    patch.vertex(center).position = corner + h * find_zero(CellGamma(gamma, cell), middle);
  }
}

}  // namespace particle_surface_tracker::remeshing
