#include "mesh_soup.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/equal_positions.h"
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
