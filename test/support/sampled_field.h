#pragma once

#include <vector>

#include <openvdb/openvdb.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker::test {

/// Values of function(position) at all corners of the cells that its zero level passes through, searched within
/// ±half_width nodes around a centre node.
template <typename Function>
openvdb::FloatGrid::Ptr sample_cut_cells(Function&& function, double dx, int half_width,
                                         const openvdb::Coord& center = openvdb::Coord(0)) {
  const int width = 2 * half_width + 1;
  std::vector<float> values(static_cast<std::size_t>(width) * width * width);
  const auto at = [&](int i, int j, int k) -> float& { return values[(i * width + j) * width + k]; };
  const openvdb::Coord first = center.offsetBy(-half_width);
  for (int i = 0; i < width; ++i) {
    for (int j = 0; j < width; ++j) {
      for (int k = 0; k < width; ++k) {
        at(i, j, k) = static_cast<float>(function(Vec3d(first.x() + i, first.y() + j, first.z() + k) * dx));
      }
    }
  }
  auto field = openvdb::FloatGrid::create(1e30f);
  auto accessor = field->getAccessor();
  for (int i = 0; i + 1 < width; ++i) {
    for (int j = 0; j + 1 < width; ++j) {
      for (int k = 0; k + 1 < width; ++k) {
        int inside = 0;
        for (int c = 0; c < 8; ++c) inside += at(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)) < 0.0f;
        if (inside == 0 || inside == 8) continue;
        for (int c = 0; c < 8; ++c) {
          const openvdb::Coord corner(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2));
          accessor.setValue(first + corner, at(corner.x(), corner.y(), corner.z()));
        }
      }
    }
  }
  return field;
}

}  // namespace particle_surface_tracker::test
