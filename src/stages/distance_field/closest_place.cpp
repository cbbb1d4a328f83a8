#include "closest_place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <openvdb/math/Proximity.h>

#include "stages/nodes/lattice_cell.h"

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;

/// Corners of the triangles of a cell.
constexpr int kMostCorners = 3 * kMostCellTriangles;

/// For rounding, of a distance [cells].
constexpr float kSlack = 1e-3f;

/// Cells are not looked at for the sake of less than this: far away, many are about equally near [cells].
constexpr float kSmallestGain = 0.01f;

/// Half the diagonal of a cell, and a little for rounding [cells].
constexpr float kCellRadius = 0.8661f + kSlack;

openvdb::Vec3d to_openvdb(const Vec3d& v) {
  return {v.x(), v.y(), v.z()};
}

}  // namespace

ClosestPlace ClosestPlaceSearch::find(const Vec3d& position, float squared_limit) {
  const openvdb::Coord leaf_origin = cell_of(position) & ~(kWidth - 1);
  if (leaf_origin != around_) find_leaves(leaf_origin);
  ClosestPlace closest = {std::min(static_cast<float>(reach_ * reach_) * 1.001f, squared_limit), Vec3d::Zero()};
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
    search_leaf(near, position, closest);
  }
  return closest;
}

void ClosestPlaceSearch::search_leaf(const NearLeaf& near, const Vec3d& position, ClosestPlace& closest) {
  LeafCells& cells = cells_of(*near.leaf);
  const std::size_t count = cells.discs.size();
  squared_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    const float x = near.position.x() - cells.x[n];
    const float y = near.position.y() - cells.y[n];
    const float z = near.position.z() - cells.z[n];
    squared_[n] = x * x + y * y + z * z;
  }
  // Cells whose triangles are all farther than this are passed over.
  float within = 0.0f;
  float squared_within_of_cell = 0.0f;
  const auto squared_within = [&](float radius) { return (within + radius) * (within + radius); };
  const auto look_within = [&](float squared_distance) {
    within = std::sqrt(squared_distance) - kSmallestGain;
    squared_within_of_cell = squared_within(kCellRadius);
  };
  const auto look_at = [&](std::size_t n) {
    const std::uint32_t cell = near.leaf->begin + static_cast<std::uint32_t>(n);
    Disc& disc = cells.discs[n];
    if (disc.height < 0.0f) disc = make_disc(cell, near.leaf->origin);
    const Vec3f offset = near.position - disc.center;
    if (offset.squaredNorm() > squared_within(disc.radius) || distance_to_disc(disc, offset) > within) return;
    measure(cell, position, closest);
    look_within(closest.squared_distance);
  };
  look_within(closest.squared_distance);
  // What has been found lets others be passed over, so the most promising is the first.
  const auto nearest = static_cast<std::size_t>(std::min_element(squared_.begin(), squared_.end()) - squared_.begin());
  if (squared_[nearest] > squared_within_of_cell) return;
  look_at(nearest);
  squared_[nearest] = std::numeric_limits<float>::max();
  for (std::size_t n = 0; n < count; ++n) {
    if (squared_[n] <= squared_within_of_cell) look_at(n);
  }
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

ClosestPlaceSearch::LeafCells& ClosestPlaceSearch::cells_of(const SurfaceCells::Leaf& leaf) {
  LeafCells& cells = leaf_cells_[&leaf - cells_.leaves().data()];
  if (!cells.discs.empty()) return cells;
  for (std::uint32_t c = leaf.begin; c != leaf.end; ++c) {
    const openvdb::Coord corner = cells_.surface().triangulation.cells[c].origin - leaf.origin;
    cells.x.push_back(static_cast<float>(corner.x()) + 0.5f);
    cells.y.push_back(static_cast<float>(corner.y()) + 0.5f);
    cells.z.push_back(static_cast<float>(corner.z()) + 0.5f);
  }
  cells.discs.resize(cells.x.size(), {Vec3f::Zero(), 0.0f, Vec3f::Zero(), -1.0f});
  return cells;
}

ClosestPlaceSearch::Disc ClosestPlaceSearch::make_disc(std::uint32_t cell, const openvdb::Coord& leaf_origin) const {
  const SurfaceTriangulation& mesh = cells_.surface().triangulation;
  std::array<Quad, kMostCorners> corners;
  int count = 0;
  Quad low = Quad{} + std::numeric_limits<float>::max();
  Quad high = -low;
  NormalBox normals;
  for (std::uint32_t t = mesh.cells[cell].first_triangle; t != mesh.cells[cell + 1].first_triangle; ++t) {
    for (const std::uint32_t vertex : mesh.triangles[t]) {
      const Quad corner = cells_.relative(vertex, leaf_origin);
      low = smaller(low, corner);
      high = larger(high, corner);
      corners[count++] = corner;
      normals.extend(cells_.normals().around(vertex));
    }
  }
  const Quad center = 0.5f * (low + high);
  const Vec3f mean = to_vector(normals.lower + normals.upper);
  const float length = mean.norm();
  Disc disc = {to_vector(center), 0.0f, length > 0.0f ? Vec3f(mean / length) : Vec3f::UnitX(), kSlack};
  for (int i = 0; i < count; ++i) {
    const Vec3f offset = to_vector(corners[i] - center);
    disc.radius = std::max(disc.radius, offset.norm() + kSlack);
    disc.height = std::max(disc.height, std::abs(offset.dot(disc.normal)) + kSlack);
  }
  return disc;
}

/// The least distance that a position can have to the triangles.
float ClosestPlaceSearch::distance_to_disc(const Disc& disc, const Vec3f& offset) {
  const float along = offset.dot(disc.normal);
  const float height = std::max(0.0f, std::abs(along) - disc.height);
  const float across = std::sqrt(std::max(0.0f, offset.squaredNorm() - along * along));
  const float beyond = std::max(0.0f, across - disc.radius);
  return std::sqrt(height * height + beyond * beyond);
}

void ClosestPlaceSearch::measure(std::uint32_t cell, const Vec3d& position, ClosestPlace& closest) const {
  const SurfaceTriangulation& mesh = cells_.surface().triangulation;
  const openvdb::Coord corner = mesh.cells[cell].origin;
  const Vec3d origin(corner.x(), corner.y(), corner.z());
  const openvdb::Vec3d place = to_openvdb(position - origin);
  for (std::uint32_t t = mesh.cells[cell].first_triangle; t != mesh.cells[cell + 1].first_triangle; ++t) {
    const auto vertex = [&](int i) {
      return to_openvdb(to_vector(cells_.relative(mesh.triangles[t][i], corner)).cast<double>());
    };
    openvdb::Vec3d unused;
    const openvdb::Vec3d point =
        openvdb::math::closestPointOnTriangleToPoint(vertex(0), vertex(1), vertex(2), place, unused);
    const auto squared = static_cast<float>((point - place).lengthSqr());
    if (squared < closest.squared_distance) closest = {squared, origin + Vec3d(point.x(), point.y(), point.z())};
  }
}

}  // namespace particle_surface_tracker
