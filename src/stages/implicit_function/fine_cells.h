#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "cell_prediction.h"
#include "node_requester.h"

namespace particle_surface_tracker::implicit {

/// The fine nodes of one coarse cell, as rows along z: bit k of row (i, j) stands for node (i, j, k).
class FineCells {
 public:
  /// \param ratio at most kLargestRatio.
  /// \param margin how far the interpolation may be off [m].
  FineCells(int ratio, float margin) : ratio_(ratio), margin_(margin) {}

  /// On which sides of the surface the nodes may be, by trilinear interpolation of the values at the corners.
  void interpolate(const std::array<float, 8>& v) {
    const auto mix = [](float a, float b, float t) { return a + (b - a) * t; };
    const float step = 1.0f / static_cast<float>(ratio_);
    int row = 0;
    for (int i = 0; i < width(); ++i) {
      const float t = static_cast<float>(i) * step;
      const float v00 = mix(v[0], v[4], t);
      const float v01 = mix(v[1], v[5], t);
      const float v10 = mix(v[2], v[6], t);
      const float v11 = mix(v[3], v[7], t);
      for (int j = 0; j < width(); ++j, ++row) {
        const float v0 = mix(v00, v10, static_cast<float>(j) * step);
        const float v1 = mix(v01, v11, static_cast<float>(j) * step);
        inside_[row] = 0;
        outside_[row] = 0;
        for (int k = 0; k < width(); ++k) {
          const float value = mix(v0, v1, static_cast<float>(k) * step);
          inside_[row] |= static_cast<std::uint32_t>(value < margin_) << k;
          outside_[row] |= static_cast<std::uint32_t>(value >= -margin_) << k;
        }
      }
    }
  }

  /// Requests the corners of the fine cells that may have corners on both sides.
  void request_mixed(const LatticeCoord& coarse_cell, NodeRequester& requester) {
    const LatticeCoord first = {coarse_cell[0] * ratio_, coarse_cell[1] * ratio_, coarse_cell[2] * ratio_};
    spread_to_cells(inside_);
    spread_to_cells(outside_);
    for (int i = 0; i < width(); ++i) {
      for (int j = 0; j < width(); ++j) {
        std::uint32_t cells = 0;
        for (int x = std::max(i - 1, 0); x <= std::min(i, ratio_ - 1); ++x) {
          for (int y = std::max(j - 1, 0); y <= std::min(j, ratio_ - 1); ++y) {
            cells |= inside_[x * width() + y] & outside_[x * width() + y];
          }
        }
        requester.request_row({first[0] + i, first[1] + j, first[2]}, cells | (cells << 1));
      }
    }
  }

 private:
  using Rows = std::array<std::uint32_t, (kLargestRatio + 1) * (kLargestRatio + 1)>;

  /// From marks of nodes to marks of the cells with any marked corner; the last row of each layer stays unused.
  void spread_to_cells(Rows& rows) const {
    const std::uint32_t all_cells = (std::uint32_t{1} << ratio_) - 1;
    for (int n = 0; n < width() * width(); ++n) rows[n] = (rows[n] | (rows[n] >> 1)) & all_cells;
    for (int n = 0; n + 1 < width() * width(); ++n) rows[n] |= rows[n + 1];
    for (int n = 0; n < ratio_ * width(); ++n) rows[n] |= rows[n + width()];
  }

  int width() const { return ratio_ + 1; }

  int ratio_;
  float margin_;
  Rows inside_;
  Rows outside_;
};

}  // namespace particle_surface_tracker::implicit
