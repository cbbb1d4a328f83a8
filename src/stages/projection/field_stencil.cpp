#include "field_stencil.h"

namespace particle_surface_tracker {

namespace {

/// No leaf begins here: origins are multiples of 8.
const openvdb::Coord kNowhere(1, 1, 1);

}  // namespace

FieldStencil::FieldStencil(const SignedDistanceField& field) : accessor_(field.phi->getConstAccessor()) {
  leaves_.fill({kNowhere, nullptr});
}

const float* FieldStencil::leaf_values(const openvdb::Coord& origin) {
  const auto hash = static_cast<unsigned>((origin.x() >> 3) + 5 * (origin.y() >> 3) + 19 * (origin.z() >> 3));
  Slot& slot = leaves_[hash % leaves_.size()];
  if (slot.origin != origin) {
    const auto* leaf = accessor_.probeConstLeaf(origin);
    slot = {origin, leaf == nullptr ? nullptr : leaf->buffer().data()};
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
  for (int x = at.x(); x <= last.x(); ++x) {
    for (int y = at.y(); y <= last.y(); ++y) {
      const int column = ((x >> 3) << 2) + ((y >> 3) << 1);
      const int offset = ((x & 7) << 6) + ((y & 7) << 3);
      for (int z = at.z(); z <= last.z(); ++z) {
        const float* leaf = values[column + (z >> 3)];
        *nodes = leaf == nullptr ? SignedDistanceField::absent : leaf[offset + (z & 7)];
        nodes += stride;
      }
    }
  }
}

}  // namespace particle_surface_tracker
