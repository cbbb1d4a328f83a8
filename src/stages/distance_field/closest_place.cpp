#include "closest_place.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <openvdb/math/Proximity.h>

#include "stages/nodes/lattice_cell.h"

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;

/// For rounding, of a distance [cells].
constexpr float kSlack = 1e-3f;

openvdb::Vec3d to_openvdb(const Vec3d& v) {
  return {v.x(), v.y(), v.z()};
}

/// The least distance that a position can have to the disc around the triangles of a cell.
float distance_to_disc(const CellBounds& cell, const Vec3f& offset) {
  const float along = offset.dot(cell.normal);
  const float height = std::max(0.0f, std::abs(along) - cell.height);
  const float across = std::sqrt(std::max(0.0f, offset.squaredNorm() - along * along));
  const float beyond = std::max(0.0f, across - cell.radius);
  return std::sqrt(height * height + beyond * beyond);
}

}  // namespace

ClosestPlace ClosestPlaceSearch::find(const Vec3d& position) {
  const openvdb::Coord leaf_origin = cell_of(position) & ~(kWidth - 1);
  if (leaf_origin != around_) find_leaves(leaf_origin);
  ClosestPlace closest = {static_cast<float>(reach_ * reach_) * 1.001f, Vec3d::Zero()};
  near_.clear();
  for (const SurfaceCells::Leaf* leaf : found_) {
    const Vec3f place = (position - Vec3d(leaf->origin.x(), leaf->origin.y(), leaf->origin.z())).cast<float>();
    const Vec3f in_leaf = place.cwiseMax(0.0f).cwiseMin(static_cast<float>(kWidth));
    const float squared_distance = (place - in_leaf).squaredNorm();
    if (squared_distance < closest.squared_distance) near_.push_back({leaf, place, squared_distance});
  }
  std::sort(near_.begin(), near_.end(), [](const NearLeaf& a, const NearLeaf& b) {
    return std::make_pair(a.squared_distance, a.leaf->begin) < std::make_pair(b.squared_distance, b.leaf->begin);
  });
  for (const NearLeaf& near : near_) {
    if (near.squared_distance >= closest.squared_distance) break;
    std::uint32_t nearest = near.leaf->begin;
    float nearest_squared = 1e30f;
    for (std::uint32_t c = near.leaf->begin; c != near.leaf->end; ++c) {
      const float squared = (near.position - cells_.bounds(c).center).squaredNorm();
      if (squared < nearest_squared) {
        nearest_squared = squared;
        nearest = c;
      }
    }
    measure(nearest, position, closest);
    for (std::uint32_t c = near.leaf->begin; c != near.leaf->end; ++c) {
      const CellBounds& cell = cells_.bounds(c);
      const Vec3f offset = near.position - cell.center;
      const float within = std::sqrt(closest.squared_distance) + kSlack;
      if (offset.squaredNorm() > (within + cell.radius) * (within + cell.radius)) continue;
      if (c != nearest && distance_to_disc(cell, offset) <= within) measure(c, position, closest);
    }
  }
  return closest;
}

void ClosestPlaceSearch::find_leaves(const openvdb::Coord& leaf_origin) {
  around_ = leaf_origin;
  found_.clear();
  const int radius = static_cast<int>(reach_) / kWidth + 1;
  for (int x = -radius; x <= radius; ++x) {
    for (int y = -radius; y <= radius; ++y) {
      for (int z = -radius; z <= radius; ++z) {
        const std::uint32_t number = cells_.find(leaf_origin.offsetBy(kWidth * x, kWidth * y, kWidth * z));
        if (number != LeafIndex::none) found_.push_back(&cells_.leaves()[number]);
      }
    }
  }
}

void ClosestPlaceSearch::measure(std::uint32_t cell, const Vec3d& position, ClosestPlace& closest) const {
  const SurfaceTriangulation& mesh = cells_.surface().triangulation;
  const openvdb::Coord corner = mesh.cells[cell].origin;
  const Vec3d origin(corner.x(), corner.y(), corner.z());
  const openvdb::Vec3d place = to_openvdb(position - origin);
  for (std::uint32_t t = mesh.cells[cell].first_triangle; t != mesh.cells[cell + 1].first_triangle; ++t) {
    const auto vertex = [&](int i) { return to_openvdb(cells_.relative(mesh.triangles[t][i], corner).cast<double>()); };
    openvdb::Vec3d unused;
    const openvdb::Vec3d point =
        openvdb::math::closestPointOnTriangleToPoint(vertex(0), vertex(1), vertex(2), place, unused);
    const auto squared = static_cast<float>((point - place).lengthSqr());
    if (squared < closest.squared_distance) closest = {squared, origin + Vec3d(point.x(), point.y(), point.z())};
  }
}

}  // namespace particle_surface_tracker
