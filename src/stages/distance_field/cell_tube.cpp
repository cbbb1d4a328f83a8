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

template <int A, int B, int C, int D>
Quad pick(const Quad& v) {
  return __builtin_shufflevector(v, v, A, B, C, D);
}

/// The smaller, or the larger, of the lanes 0 and 1, in both of them, and of the lanes 2 and 3.
Quad smaller_of_pairs(const Quad& v) {
  return smaller(v, pick<1, 0, 3, 2>(v));
}
Quad larger_of_pairs(const Quad& v) {
  return larger(v, pick<1, 0, 3, 2>(v));
}

/// The tube with slices across one axis.
template <int Slice, int Row, int Column>
CellTube make_tube_across(const CellShape& shape, float height) {
  const NormalBox& normals = shape.normals;
  CellTube tube;
  tube.slice = Slice;
  tube.side[0] = Row;
  tube.side[1] = Column;
  const bool is_bounded = std::max(normals.lower[Slice], -normals.upper[Slice]) > kSmallestCosine;

  // The least and the largest ratio, of each of the other axes.
  Quad ratio = {};
  float squared_lean = 0.0f;
  if (is_bounded) {
    const Quad steepest = {normals.lower[Slice], normals.upper[Slice], normals.lower[Slice], normals.upper[Slice]};
    const Quad from_lower = pick<Row, Row, Column, Column>(normals.lower) / steepest;
    const Quad from_upper = pick<Row, Row, Column, Column>(normals.upper) / steepest;
    const Quad least = smaller_of_pairs(smaller(from_lower, from_upper)) - kSlack;
    const Quad most = larger_of_pairs(larger(from_lower, from_upper)) + kSlack;
    ratio = Quad{least[0], most[0], least[2], most[2]};
    const Quad lean = larger(larger(least, -most), Quad{});
    squared_lean = lean[0] * lean[0] + lean[2] * lean[2];
  }

  Quad lowest = shape.triangle[0].corner(0);
  Quad highest = lowest;
  Quad low = Quad{} + kUnbounded;
  Quad high = -low;
  for (int t = 0; t < shape.triangles; ++t) {
    for (int i = 0; i < 3; ++i) {
      const Quad& corner = shape.triangle[t].corner(i);
      lowest = smaller(lowest, corner);
      highest = larger(highest, corner);
      const Quad at_slice_0 = pick<Row, Row, Column, Column>(corner) - ratio * pick<Slice, Slice, Slice, Slice>(corner);
      low = smaller(low, at_slice_0);
      high = larger(high, at_slice_0);
    }
  }
  const float slack = is_bounded ? kSlack : kUnbounded;
  tube.ratio = ratio;
  tube.low = low - slack;
  tube.high = high + slack;
  // No unit vector that leans by these ratios has more of itself along the axis.
  const float rise = height / std::sqrt(1.0f + squared_lean) + kSlack;
  tube.first = lowest[Slice] - rise;
  tube.last = highest[Slice] + rise;
  const Quad least = lowest - (height + kSlack);
  const Quad most = highest + (height + kSlack);
  tube.least[0] = least[Row];
  tube.least[1] = least[Column];
  tube.most[0] = most[Row];
  tube.most[1] = most[Column];
  return tube;
}

}  // namespace

CellTube make_cell_tube(const CellShape& shape, float height) {
  switch (dominant_axis(shape.normals.lower + shape.normals.upper)) {
    case 0:
      return make_tube_across<0, 1, 2>(shape, height);
    case 1:
      return make_tube_across<1, 0, 2>(shape, height);
    default:
      return make_tube_across<2, 0, 1>(shape, height);
  }
}

}  // namespace particle_surface_tracker
