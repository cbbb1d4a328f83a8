#include "tube_patches.h"

#include <algorithm>
#include <cmath>

namespace particle_surface_tracker {

namespace {

using Floats = float __attribute__((vector_size(16)));
using Ints = std::int32_t __attribute__((vector_size(16)));

constexpr int kFirst = -DistanceBlock::margin;
constexpr int kLast = DistanceBlock::width - DistanceBlock::margin - 1;
constexpr int kLastStart = kLast - Patch::width + 1;

/// Slices that are worked on together.
constexpr int kSlices = 4;

/// A tube that widens nearly as fast as a slice of it moves away has slices without bounds.
constexpr float kLeastNarrowing = 0.1f;
constexpr float kUnbounded = 1e3f;

/// For the rounding of all that leads to an interval [cells].
constexpr float kSlack = 2e-3f;

/// Nodes of a block along one axis in each of some slices.
struct Runs {
  Ints first;
  Ints last;
};

Floats larger(const Floats& a, const Floats& b) {
  return a > b ? a : b;
}

Floats smaller(const Floats& a, const Floats& b) {
  return a < b ? a : b;
}

/// Whole numbers are cut off numbers that are positive: std::floor() is a function call on plain x86-64.
constexpr int kUp = 64;

Ints round_up(const Floats& x) {
  return kUp - __builtin_convertvector(static_cast<float>(kUp) - x, Ints);
}

Ints round_down(const Floats& x) {
  return __builtin_convertvector(static_cast<float>(kUp) + x, Ints) - kUp;
}

/// How a cell's tube crosses the slices.
class TubeSlices {
 public:
  TubeSlices(const CellBounds& cell, const PatchAxes& axes, float height)
      : cell_(cell), middle_{cell.center[axes.row], cell.center[axes.column]}, farthest_(height + cell.radius) {
    const float row = cell.shear[0] * cell.shear[0];
    const float column = cell.shear[1] * cell.shear[1];
    stretch_[0] = std::sqrt(1.0f + row);
    stretch_[1] = std::sqrt(1.0f + column);
    const float tilt = std::sqrt(row + column);
    const float rise = 1.0f / std::sqrt(1.0f + row + column);
    // From a place on the cell, s slices away, the normal is at the height s / rise. A point beside it is higher by at
    // most the tube's radius there times the tilt, and where it is higher the tube is wider.
    const float narrowing = 1.0f - cell.slope * tilt;
    const bool is_bounded = cell.slope != CellBounds::unbounded && narrowing > kLeastNarrowing;
    widening_ = is_bounded ? cell.slope / (rise * narrowing) : kUnbounded;
    // No node is higher than the height, nor farther beside the normal than the tube is wide there.
    const float highest = is_bounded ? height * rise * (1.0f + cell.slope * tilt) + kSlack : farthest_;
    first_ = std::max(kFirst, ceiling(std::max(cell.bottom - highest, cell.center[cell.axis] - farthest_)));
    last_ = std::min(kLast, -ceiling(-std::min(cell.top + highest, cell.center[cell.axis] + farthest_)));
  }

  int first() const { return first_; }
  int last() const { return last_; }

  /// The nodes along the rows' axis (side 0) or the columns' (side 1) in kSlices slices.
  Runs nodes(int side, const Floats& slices) const {
    const Floats away = larger(cell_.top - slices, slices - cell_.bottom);
    const Floats wider = away * (widening_ * stretch_[side]) + kSlack;
    const Floats shift = cell_.shear[side] * slices;
    const Floats least = Floats{} + std::max(static_cast<float>(kFirst), middle_[side] - farthest_);
    const Floats most = Floats{} + std::min(static_cast<float>(kLast), middle_[side] + farthest_);
    return {round_up(larger(least, cell_.low[side] + shift - wider)),
            round_down(smaller(most, cell_.high[side] + shift + wider))};
  }

 private:
  static int ceiling(float x) { return kUp - static_cast<int>(static_cast<float>(kUp) - x); }

  const CellBounds& cell_;
  float middle_[2];
  float farthest_;  // any node from the center
  float stretch_[2];
  float widening_;  // of the tube per slice
  int first_;
  int last_;
};

}  // namespace

PatchAxes list_patches(const CellBounds& cell, const openvdb::Coord& corner, float height,
                       std::vector<Patch>& patches) {
  patches.clear();
  const PatchAxes axes = patch_axes(cell.axis);
  const TubeSlices tube(cell, axes, height);
  for (int group = tube.first(); group <= tube.last(); group += kSlices) {
    const Floats slices = Floats{0.0f, 1.0f, 2.0f, 3.0f} + static_cast<float>(group);
    const Runs rows = tube.nodes(0, slices);
    const Runs columns = tube.nodes(1, slices);
    const int count = std::min(kSlices, tube.last() - group + 1);
    for (int i = 0; i < count; ++i) {
      const int slice = group + i;
      for (int r = rows.first[i]; r <= rows.last[i]; r += Patch::width) {
        const int row = std::min(r, kLastStart);
        for (int c = columns.first[i]; c <= columns.last[i]; c += Patch::width) {
          const int column = std::min(c, kLastStart);
          const int node =
              axes.begin + (slice - kFirst) * axes.slice_stride + (row - kFirst) * axes.row_stride + column - kFirst;
          patches.push_back({static_cast<float>(slice - corner[axes.slice]), static_cast<float>(row - corner[axes.row]),
                             static_cast<float>(column - corner[axes.column]), node,
                             std::min(rows.last[i] - row + 1, Patch::width)});
        }
      }
    }
  }
  return axes;
}

}  // namespace particle_surface_tracker
