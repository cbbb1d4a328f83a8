#include "surface_cells.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace particle_surface_tracker {

namespace {

constexpr int kLeafMask = 7;

/// For the rounding of all that leads to a tube [cells], and of the angles.
constexpr float kSlack = 2e-3f;

/// Axes that lean farther away from the normals bound nothing.
constexpr float kSmallestCosine = 0.35f;

/// Cosine of the sum of two angles between 0 and π, given their cosines; −1 beyond π.
float cosine_of_sum(float a, float b) {
  if (a <= -b) return -1.0f;
  const float sines = std::sqrt(std::max(0.0f, (1.0f - a * a) * (1.0f - b * b)));
  return a * b - sines;
}

int dominant_axis(const Vec3f& direction) {
  const Vec3f size = direction.cwiseAbs();
  return size.x() >= size.y() && size.x() >= size.z() ? 0 : size.y() >= size.z() ? 1 : 2;
}

}  // namespace

SurfaceCells::SurfaceCells(const ImplicitSurface& surface)
    : surface_(surface), per_meter_(1.0 / surface.dx), normals_(surface.triangulation), index_(64) {
  const std::vector<CutCell>& cells = surface.triangulation.cells;
  const std::size_t count = cells.empty() ? 0 : cells.size() - 1;
  for (std::uint32_t c = 0; c < count; ++c) {
    const openvdb::Coord origin = cells[c].origin & ~kLeafMask;
    if (leaves_.empty() || leaves_.back().origin != origin) {
      index_.insert(origin, static_cast<std::uint32_t>(leaves_.size()));
      leaves_.push_back({origin, c, c});
    }
    leaves_.back().end = c + 1;
  }
  bounds_.resize(count);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(count), 512),
                    [&](const auto& range) {
                      for (std::uint32_t c = range.begin(); c != range.end(); ++c) bounds_[c] = make_bounds(c);
                    });
}

CellBounds SurfaceCells::make_bounds(std::uint32_t cell) const {
  const SurfaceTriangulation& mesh = surface_.triangulation;
  const std::uint32_t* corner = mesh.triangles[mesh.cells[cell].first_triangle].data();
  const std::uint32_t* end = corner + 3 * (mesh.cells[cell + 1].first_triangle - mesh.cells[cell].first_triangle);
  const openvdb::Coord leaf = mesh.cells[cell].origin & ~kLeafMask;
  // Triangles of a cell share vertices.
  constexpr int kMost = 12;
  std::array<std::uint32_t, kMost> vertices;
  std::array<Vec3f, kMost> places;
  int count = 0;
  Vec3f low = Vec3f::Constant(1e9f);
  Vec3f high = -low;
  Vec3f sum = Vec3f::Zero();
  for (; corner != end; ++corner) {
    if (std::find(vertices.begin(), vertices.begin() + count, *corner) != vertices.begin() + count) continue;
    vertices[count] = *corner;
    places[count] = relative(*corner, leaf);
    low = low.cwiseMin(places[count]);
    high = high.cwiseMax(places[count]);
    sum += normals_.mean(*corner);
    ++count;
  }

  CellBounds bounds;
  bounds.center = 0.5f * (low + high);
  const float length = sum.norm();
  bounds.normal = length > 0.0f ? Vec3f(sum / length) : Vec3f::UnitX();
  bounds.axis = dominant_axis(bounds.normal);
  const int rows = bounds.axis == 0 ? 1 : 0;
  const int columns = bounds.axis == 2 ? 1 : 2;
  const float inverse = 1.0f / bounds.normal[bounds.axis];
  bounds.shear[0] = bounds.normal[rows] * inverse;
  bounds.shear[1] = bounds.normal[columns] * inverse;
  bounds.low[0] = bounds.low[1] = 1e9f;
  bounds.high[0] = bounds.high[1] = -1e9f;
  bounds.bottom = low[bounds.axis];
  bounds.top = high[bounds.axis];
  bounds.height = 0.0f;
  float squared_radius = 0.0f;
  float cosine = length > 0.0f ? 1.0f : -1.0f;
  for (int i = 0; i < count; ++i) {
    const Vec3f offset = places[i] - bounds.center;
    squared_radius = std::max(squared_radius, offset.squaredNorm());
    bounds.height = std::max(bounds.height, std::abs(offset.dot(bounds.normal)));
    const float row = places[i][rows] - bounds.shear[0] * places[i][bounds.axis];
    const float column = places[i][columns] - bounds.shear[1] * places[i][bounds.axis];
    bounds.low[0] = std::min(bounds.low[0], row);
    bounds.high[0] = std::max(bounds.high[0], row);
    bounds.low[1] = std::min(bounds.low[1], column);
    bounds.high[1] = std::max(bounds.high[1], column);
    const float lean = std::min(1.0f, normals_.mean(vertices[i]).dot(bounds.normal));
    cosine = std::min(cosine, cosine_of_sum(lean, std::min(1.0f, normals_.cosine(vertices[i]))));
  }
  bounds.radius = std::sqrt(squared_radius) + kSlack;
  bounds.height += kSlack;
  const bool is_bounded = cosine > kSmallestCosine;
  bounds.slope =
      is_bounded ? std::sqrt(std::max(0.0f, 1.0f - cosine * cosine)) / cosine + kSlack : CellBounds::unbounded;
  return bounds;
}

}  // namespace particle_surface_tracker
