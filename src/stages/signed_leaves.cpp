#include "signed_leaves.h"

#include <algorithm>
#include <cmath>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "sign_flood.h"

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;

/// What rounding leaves of the squared distance of a node next to the isosurface [cells²]. No distance becomes 0, which
/// would have lost its sign.
constexpr float kSmallestSquared = 1e-8f;

template <typename Visit>
void for_each_index(std::size_t count, Visit&& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) visit(n);
  });
}

/// What is known of a leaf before signs are carried.
SignLeaf seed_signs(const ImplicitSurface& surface, const NodeMasks& wanted, const NodeMasks::Leaf& wanted_leaf,
                    const LeafDistances& distances, float squared_reach) {
  SignLeaf leaf;
  for (int side = 0; side < 6; ++side) {
    openvdb::Coord neighbor = wanted_leaf.origin;
    neighbor[side >> 1] += side & 1 ? kWidth : -kWidth;
    leaf.neighbors[side] = wanted.find(neighbor);
  }
  for (int x = 0; x < kWidth; ++x) {
    for_each_bit(wanted_leaf.words[x],
                 [&](int bit) { leaf.unknown[x] |= std::uint64_t{distances[64 * x + bit] <= squared_reach} << bit; });
  }
  const auto* field = surface.field->tree().probeConstLeaf(wanted_leaf.origin);
  if (field == nullptr) return leaf;
  for (int x = 0; x < kWidth; ++x) {
    const std::uint64_t seeds = leaf.unknown[x] & field->getValueMask().getWord<openvdb::Index64>(x);
    for_each_bit(seeds, [&](int bit) {
      const bool is_inside = field->buffer().data()[64 * x + bit] < 0.0f;
      (is_inside ? leaf.inside : leaf.outside)[x] |= std::uint64_t{1} << bit;
    });
    leaf.unknown[x] &= ~seeds;
  }
  return leaf;
}

}  // namespace

SignedDistanceField sign_distances(const ImplicitSurface& surface, const NodeMasks& wanted,
                                   const std::vector<LeafDistances>& distances, double reach) {
  const auto squared_reach = static_cast<float>((reach / surface.dx) * (reach / surface.dx));
  std::vector<SignLeaf> signs(distances.size());
  for_each_index(signs.size(), [&](std::size_t n) {
    signs[n] = seed_signs(surface, wanted, wanted.leaves()[n], distances[n], squared_reach);
  });
  flood_signs(signs);

  SignedDistanceField field;
  field.dx = surface.dx;
  field.reach = reach;
  field.phi = openvdb::FloatGrid::create(SignedDistanceField::absent);
  field.phi->setTransform(openvdb::math::Transform::createLinearTransform(surface.dx));
  field.phi->setName("phi");
  using OutputLeaf = openvdb::FloatTree::LeafNodeType;
  std::vector<OutputLeaf*> outputs(signs.size(), nullptr);
  for (std::size_t n = 0; n < signs.size(); ++n) {
    if (is_zero(signs[n].inside) && is_zero(signs[n].outside)) continue;
    outputs[n] = new OutputLeaf(wanted.leaves()[n].origin, SignedDistanceField::absent, /*active*/ false);
    field.phi->tree().addLeaf(outputs[n]);
  }
  for_each_index(outputs.size(), [&](std::size_t n) {
    if (outputs[n] == nullptr) return;
    OutputLeaf::NodeMaskType mask;
    float* values = outputs[n]->buffer().data();
    for (int x = 0; x < kWidth; ++x) {
      mask.getWord<openvdb::Index64>(x) = signs[n].inside[x] | signs[n].outside[x];
      const auto write = [&](std::uint64_t nodes, float unit) {
        for_each_bit(nodes, [&](int bit) {
          const float squared = std::max(distances[n][64 * x + bit], kSmallestSquared);
          values[64 * x + bit] = std::sqrt(squared) * unit;
        });
      };
      write(signs[n].inside[x], static_cast<float>(-surface.dx));
      write(signs[n].outside[x], static_cast<float>(surface.dx));
    }
    outputs[n]->setValueMask(mask);
  });
  return field;
}

}  // namespace particle_surface_tracker
