#include "field_stencil.h"

#include <algorithm>

namespace particle_surface_tracker {

namespace {

/// No leaf begins here: origins are multiples of 8.
const openvdb::Coord kNowhere(1, 1, 1);

/// What a leaf that is not there holds.
const std::array<float, 512>& absent_values() {
  static const std::array<float, 512> values = [] {
    std::array<float, 512> all;
    all.fill(SignedDistanceField::absent);
    return all;
  }();
  return values;
}

}  // namespace

FieldStencil::FieldStencil(const SignedDistanceField& field) : accessor_(field.phi->getConstAccessor()) {
  leaves_.fill({kNowhere, nullptr});
}

const float* FieldStencil::leaf_values(const openvdb::Coord& origin) {
  const auto hash = static_cast<unsigned>((origin.x() >> 3) + 5 * (origin.y() >> 3) + 19 * (origin.z() >> 3));
  Slot& slot = leaves_[hash % leaves_.size()];
  if (slot.origin != origin) {
    const auto* leaf = accessor_.probeConstLeaf(origin);
    slot = {origin, leaf == nullptr ? absent_values().data() : leaf->buffer().data()};
  }
  return slot.values;
}

void FieldStencil::load(const openvdb::Coord& cell, float* nodes, std::size_t stride) {
  const openvdb::Coord first = cell.offsetBy(-1);
  const openvdb::Coord origin = first & ~7;
  const openvdb::Coord at = first - origin;
  const openvdb::Coord last = at.offsetBy(3);
  std::array<const float*, 8> values{};
  for (int n = 0; n < 8; ++n) {
    const int x = n >> 2;
    const int y = (n >> 1) & 1;
    const int z = n & 1;
    if (x > last.x() >> 3 || y > last.y() >> 3 || z > last.z() >> 3) continue;
    values[n] = leaf_values(origin.offsetBy(8 * x, 8 * y, 8 * z));
  }
  const int z = at.z();
  const int in_first = std::min(4, 8 - z);  // nodes of a row before it goes on in the next leaf
  for (int i = 0; i < 16; ++i) {
    const int x = at.x() + (i >> 2);
    const int y = at.y() + (i & 3);
    const float* const* leaves = &values[((x >> 3) << 2) + ((y >> 3) << 1)];
    const int row = ((x & 7) << 6) + ((y & 7) << 3);
    float* to = nodes + 4 * i * stride;
    if (in_first == 4) {
      const float* from = leaves[0] + row + z;
      for (int k = 0; k < 4; ++k) to[k * stride] = from[k];
    } else {
      for (int k = 0; k < in_first; ++k) to[k * stride] = leaves[0][row + z + k];
      for (int k = in_first; k < 4; ++k) to[k * stride] = leaves[1][row + z + k - 8];
    }
  }
}

}  // namespace particle_surface_tracker
