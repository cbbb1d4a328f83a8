#include "field_stencil.h"

namespace particle_surface_tracker {

namespace {

/// Where the nodes of a stencil are, in the leaf of the first one and in the next one along each axis: entry n of
/// `leaf` is that one along x, y, z where bits 2, 1, 0 of n are set.
struct StencilPlace {
  const float* leaf[8];
  openvdb::Coord first;  // in its leaf
};

/// \tparam InFirst nodes of a row before it goes on in the next leaf.
template <int InFirst>
void load_rows(const StencilPlace& place, float* nodes, std::size_t stride) {
  for (int i = 0; i < 4; ++i) {
    const int x = place.first.x() + i;
    for (int j = 0; j < 4; ++j, nodes += 4 * stride) {
      const int y = place.first.y() + j;
      const float* const* leaves = &place.leaf[(x >> 3 << 2) + (y >> 3 << 1)];
      const int row = ((x & 7) << 6) + ((y & 7) << 3);
      const float* from = leaves[0] + row + place.first.z();
      for (int k = 0; k < InFirst; ++k) nodes[k * stride] = from[k];
      for (int k = InFirst; k < 4; ++k) nodes[k * stride] = leaves[1][row + k - InFirst];
    }
  }
}

}  // namespace

FieldLeaves::FieldLeaves(const SignedDistanceField& field) : index_(field.phi->tree().leafCount()) {
  absent_.fill(SignedDistanceField::absent);
  for (auto leaf = field.phi->tree().cbeginLeaf(); leaf; ++leaf) {
    index_.insert(leaf->origin(), static_cast<std::uint32_t>(values_.size()));
    values_.push_back(leaf->buffer().data());
  }
}

void FieldStencil::load(const openvdb::Coord& cell, float* nodes, std::size_t stride) const {
  const openvdb::Coord first = cell.offsetBy(-1);
  const openvdb::Coord origin = first & ~7;
  StencilPlace place{{}, first - origin};
  const openvdb::Coord last = place.first.offsetBy(3);
  for (int n = 0; n < 8; ++n) {
    const int x = n >> 2;
    const int y = (n >> 1) & 1;
    const int z = n & 1;
    if (x > last.x() >> 3 || y > last.y() >> 3 || z > last.z() >> 3) continue;
    place.leaf[n] = leaves_.values(origin.offsetBy(8 * x, 8 * y, 8 * z));
  }
  switch (8 - place.first.z()) {
    case 1:
      return load_rows<1>(place, nodes, stride);
    case 2:
      return load_rows<2>(place, nodes, stride);
    case 3:
      return load_rows<3>(place, nodes, stride);
    default:
      return load_rows<4>(place, nodes, stride);
  }
}

}  // namespace particle_surface_tracker
