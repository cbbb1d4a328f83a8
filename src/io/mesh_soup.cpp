#include "mesh_soup.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include <fmt/format.h>
#include <tbb/parallel_sort.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

/// The corner whose fan has the least bad triangle: the highest among the smallest areas, taken along the polygon's
/// normal so that triangles outside a concave polygon count as negative.
std::size_t best_fan_apex(const std::vector<Vec3f>& positions, const std::uint32_t* corners, std::size_t count) {
  const auto point = [&](std::size_t k) -> Vec3d { return positions[corners[k % count]].cast<double>(); };
  const auto area_vector = [&](std::size_t a, std::size_t b, std::size_t c) -> Vec3d {
    return (point(b) - point(a)).cross(point(c) - point(a));
  };
  Vec3d normal = Vec3d::Zero();
  for (std::size_t k = 1; k + 1 < count; ++k) normal += area_vector(0, k, k + 1);

  std::size_t best = 0;
  double best_area = -std::numeric_limits<double>::infinity();
  for (std::size_t apex = 0; apex < count; ++apex) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k + 1 < count; ++k) {
      smallest = std::min(smallest, area_vector(apex, apex + k, apex + k + 1).dot(normal));
    }
    if (smallest > best_area) {
      best_area = smallest;
      best = apex;
    }
  }
  return best;
}

void append_fan(const MeshSoup& soup, const std::uint32_t* corners, std::size_t count,
                std::vector<Triangle>& triangles) {
  // Beyond this size the search would take too long, and no fan is good anyway.
  constexpr std::size_t kLargestSearched = 1000;
  const bool is_searched = count > 3 && count <= kLargestSearched;
  const std::size_t apex = is_searched ? best_fan_apex(soup.positions, corners, count) : 0;
  for (std::size_t k = 1; k + 1 < count; ++k) {
    triangles.push_back({corners[apex], corners[(apex + k) % count], corners[(apex + k + 1) % count]});
  }
}

/// Bits of a position as a key for sorting; −0 has those of 0.
using PositionKey = std::array<std::uint32_t, 3>;

PositionKey key_of(const Vec3f& position) {
  PositionKey key;
  for (int axis = 0; axis < 3; ++axis) {
    const float value = position[axis] == 0.0F ? 0.0F : position[axis];
    std::memcpy(&key[static_cast<std::size_t>(axis)], &value, sizeof(value));
  }
  return key;
}

/// For each vertex the first one of the same position.
std::vector<std::uint32_t> first_of_same_position(const std::vector<Vec3f>& positions) {
  std::vector<std::pair<PositionKey, std::uint32_t>> order(positions.size());
  for (std::uint32_t v = 0; v < order.size(); ++v) order[v] = {key_of(positions[v]), v};
  tbb::parallel_sort(order.begin(), order.end());
  std::vector<std::uint32_t> first(positions.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool is_same = i > 0 && order[i].first == order[i - 1].first;
    first[order[i].second] = is_same ? first[order[i - 1].second] : order[i].second;
  }
  return first;
}

}  // namespace

std::vector<Triangle> triangulate(const MeshSoup& soup) {
  std::vector<Triangle> triangles;
  triangles.reserve(soup.polygon_ends.size());
  std::size_t begin = 0;
  for (std::size_t polygon = 0; polygon < soup.polygon_ends.size(); ++polygon) {
    const std::size_t end = soup.polygon_ends[polygon];
    for (std::size_t k = begin; k < end; ++k) {
      if (soup.corners[k] < soup.positions.size()) continue;
      throw InputError(
          fmt::format("face {} names a vertex that is not there (there are {})", polygon, soup.positions.size()));
    }
    append_fan(soup, soup.corners.data() + begin, end - begin, triangles);
    begin = end;
  }
  return triangles;
}

std::size_t move_texcoords_to_vertices(MeshSoup& soup) {
  if (soup.corner_texcoords.empty()) return 0;
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  soup.texcoords.assign(soup.positions.size(), {kNaN, kNaN});
  std::vector<char> disagrees(soup.positions.size(), 0);
  for (std::size_t k = 0; k < soup.corners.size(); ++k) {
    const auto& corner = soup.corner_texcoords[k];
    if (soup.corners[k] >= soup.positions.size() || std::isnan(corner[0])) continue;
    auto& texcoord = soup.texcoords[soup.corners[k]];
    if (std::isnan(texcoord[0])) {
      texcoord = corner;
    } else if (texcoord != corner) {
      disagrees[soup.corners[k]] = 1;
    }
  }
  for (auto& texcoord : soup.texcoords) {
    if (std::isnan(texcoord[0])) texcoord = {0.0F, 0.0F};
  }
  soup.corner_texcoords.clear();
  return static_cast<std::size_t>(std::count(disagrees.begin(), disagrees.end(), 1));
}

std::size_t merge_equal_positions(MeshSoup& soup, std::size_t& seams) {
  const std::vector<std::uint32_t> first = first_of_same_position(soup.positions);
  seams = 0;
  std::vector<std::uint32_t> new_index(first.size());
  std::uint32_t kept = 0;
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (first[v] != v) {
      new_index[v] = new_index[first[v]];
      seams += !soup.texcoords.empty() && soup.texcoords[v] != soup.texcoords[new_index[v]];
      continue;
    }
    new_index[v] = kept;
    soup.positions[kept] = soup.positions[v];
    if (!soup.colors.empty()) soup.colors[kept] = soup.colors[v];
    if (!soup.texcoords.empty()) soup.texcoords[kept] = soup.texcoords[v];
    ++kept;
  }
  soup.positions.resize(kept);
  if (!soup.colors.empty()) soup.colors.resize(kept);
  if (!soup.texcoords.empty()) soup.texcoords.resize(kept);
  for (std::uint32_t& corner : soup.corners) corner = new_index[corner];
  return first.size() - kept;
}

}  // namespace particle_surface_tracker
