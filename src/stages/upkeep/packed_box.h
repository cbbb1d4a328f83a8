#pragma once

#include <limits>

#include <Eigen/Geometry>

namespace particle_surface_tracker {

/// An axis-aligned box as it is stored in large numbers.
struct PackedBox {
  PackedBox() = default;
  explicit PackedBox(const Eigen::AlignedBox3f& box)
      : numbers{box.max().x(), box.max().y(), box.max().z(), box.min().x(), box.min().y(), box.min().z()} {}

  float numbers[6];  ///< Highest x, y, z, lowest x, y, z.
};

/// A box that many others are compared with: all three axes in one go, where asking one after the other would make the
/// processor guess six times.
class BoxQuery {
 public:
  explicit BoxQuery(const Eigen::AlignedBox3f& box)
      : low_(box.min().x(), box.min().y(), box.min().z(), -kAlways),
        high_(kAlways, box.max().x(), box.max().y(), box.max().z()) {}

  /// Whether the boxes have a point in common; touching counts. The sign of a difference of floats is exact.
  bool meets(const PackedBox& box) const {
    using Four = Eigen::Map<const Eigen::Array4f>;
    const Four highest_and_one_more(box.numbers), one_more_and_lowest(box.numbers + 2);
    return (low_ - highest_and_one_more).max(one_more_and_lowest - high_).maxCoeff() <= 0.0F;
  }

 private:
  static constexpr float kAlways = std::numeric_limits<float>::max();

  Eigen::Array4f low_, high_;
};

}  // namespace particle_surface_tracker
