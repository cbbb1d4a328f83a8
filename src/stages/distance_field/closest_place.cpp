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
  std::vector<Disc>& discs = discs_of(*near.leaf);
  const auto measure_within = [&](std::size_t n) {
    Disc& disc = discs[n];
    const float within = std::sqrt(closest.squared_distance) - kSmallestGain;
    const auto is_within = [&](const Vec3f& center, float radius) {
      return (near.position - center).squaredNorm() <= (within + radius) * (within + radius);
    };
    if (!is_within(disc.cell_center, kCellRadius)) return;
    const std::uint32_t cell = near.leaf->begin + static_cast<std::uint32_t>(n);
    if (disc.height < 0.0f) make_disc(cell, near.leaf->origin, disc);
    if (!is_within(disc.center, disc.radius)) return;
    if (distance_to_disc(disc, near.position - disc.center) <= within) measure(cell, position, closest);
  };
  // What has been found lets others be passed over, so the most promising is the first.
  std::size_t nearest = 0;
  float nearest_squared = std::numeric_limits<float>::max();
  for (std::size_t n = 0; n < discs.size(); ++n) {
    const float squared = (near.position - discs[n].cell_center).squaredNorm();
    if (squared < nearest_squared) {
      nearest_squared = squared;
      nearest = n;
    }
  }
  measure_within(nearest);
  for (std::size_t n = 0; n < discs.size(); ++n) {
    if (n != nearest) measure_within(n);
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

std::vector<ClosestPlaceSearch::Disc>& ClosestPlaceSearch::discs_of(const SurfaceCells::Leaf& leaf) {
  std::vector<Disc>& discs = discs_[&leaf - cells_.leaves().data()];
  if (!discs.empty()) return discs;
  const std::vector<CutCell>& cut = cells_.surface().triangulation.cells;
  discs.resize(leaf.end - leaf.begin);
  for (std::size_t n = 0; n < discs.size(); ++n) {
    const openvdb::Coord corner = cut[leaf.begin + n].origin - leaf.origin;
    discs[n].cell_center = Eigen::Vector3i(corner.x(), corner.y(), corner.z()).cast<float>() + Vec3f::Constant(0.5f);
  }
  return discs;
}

void ClosestPlaceSearch::make_disc(std::uint32_t cell, const openvdb::Coord& leaf_origin, Disc& disc) const {
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
  disc.center = to_vector(center);
  disc.normal = length > 0.0f ? Vec3f(mean / length) : Vec3f::UnitX();
  disc.radius = 0.0f;
  disc.height = kSlack;
  for (int i = 0; i < count; ++i) {
    const Vec3f offset = to_vector(corners[i] - center);
    disc.radius = std::max(disc.radius, offset.norm() + kSlack);
    disc.height = std::max(disc.height, std::abs(offset.dot(disc.normal)) + kSlack);
  }
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
