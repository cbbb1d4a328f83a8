#include "cell_tube.h"

#include <algorithm>
#include <cmath>

namespace particle_surface_tracker {

namespace {

/// For the rounding of all that leads to a place [cells], and of the ratios.
constexpr float kSlack = 2e-3f;

/// Axes that a normal leans farther away from bound nothing.
constexpr float kSmallestCosine = 0.1f;

constexpr float kUnbounded = 1e6f;

int dominant_axis(const Quad& direction) {
  const Quad size = larger(direction, -direction);
  return size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
}

/// Where lines through the corners reach slice 0, along the other two axes, at either ratio: the ends of what they
/// cover.
template <int Slice, int Row, int Column>
void find_ends(const CellShape& shape, const Quad& ratio, Quad& low, Quad& high) {
  low = Quad{} + kUnbounded;
  high = -low;
  for (int t = 0; t < shape.triangles; ++t) {
    for (int i = 0; i < 3; ++i) {
      const Quad& corner = shape.triangle[t].corner(i);
      const Quad at_slice_0 = __builtin_shufflevector(corner, corner, Row, Row, Column, Column) -
                              ratio * __builtin_shufflevector(corner, corner, Slice, Slice, Slice, Slice);
      low = smaller(low, at_slice_0);
      high = larger(high, at_slice_0);
    }
  }
}

}  // namespace

CellTube make_cell_tube(const CellShape& shape, float height) {
  Quad lowest = shape.triangle[0].corner(0);
  Quad highest = lowest;
  for (int t = 0; t < shape.triangles; ++t) {
    for (int i = 0; i < 3; ++i) {
      lowest = smaller(lowest, shape.triangle[t].corner(i));
      highest = larger(highest, shape.triangle[t].corner(i));
    }
  }
  const NormalBox& normals = shape.normals;
  CellTube tube;
  tube.slice = dominant_axis(normals.lower + normals.upper);
  tube.side[0] = tube.slice == 0 ? 1 : 0;
  tube.side[1] = tube.slice == 2 ? 1 : 2;
  const float lower = normals.lower[tube.slice];
  const float upper = normals.upper[tube.slice];
  const bool is_bounded = std::max(lower, -upper) > kSmallestCosine;
  const float inverse[2] = {1.0f / lower, 1.0f / upper};
  float squared_lean = 0.0f;
  for (int i = 0; i < 2; ++i) {
    const int axis = tube.side[i];
    tube.least[i] = lowest[axis] - height - kSlack;
    tube.most[i] = highest[axis] + height + kSlack;
    const float ratios[4] = {normals.lower[axis] * inverse[0], normals.lower[axis] * inverse[1],
                             normals.upper[axis] * inverse[0], normals.upper[axis] * inverse[1]};
    const float smallest = std::min(std::min(ratios[0], ratios[1]), std::min(ratios[2], ratios[3]));
    const float largest = std::max(std::max(ratios[0], ratios[1]), std::max(ratios[2], ratios[3]));
    tube.ratio[i][0] = is_bounded ? smallest - kSlack : 0.0f;
    tube.ratio[i][1] = is_bounded ? largest + kSlack : 0.0f;
    const float least_lean = std::max({0.0f, tube.ratio[i][0], -tube.ratio[i][1]});
    squared_lean += least_lean * least_lean;
  }
  // No unit vector that leans by these ratios has more of itself along the axis.
  const float rise = height / std::sqrt(1.0f + squared_lean) + kSlack;
  tube.first = lowest[tube.slice] - rise;
  tube.last = highest[tube.slice] + rise;
  const Quad ratio = {tube.ratio[0][0], tube.ratio[0][1], tube.ratio[1][0], tube.ratio[1][1]};
  Quad low;
  Quad high;
  (tube.slice == 0   ? find_ends<0, 1, 2>
   : tube.slice == 1 ? find_ends<1, 0, 2>
                     : find_ends<2, 0, 1>)(shape, ratio, low, high);
  const float slack = is_bounded ? kSlack : kUnbounded;
  for (int i = 0; i < 4; ++i) {
    tube.low[i >> 1][i & 1] = low[i] - slack;
    tube.high[i >> 1][i & 1] = high[i] + slack;
  }
  return tube;
}

}  // namespace particle_surface_tracker
