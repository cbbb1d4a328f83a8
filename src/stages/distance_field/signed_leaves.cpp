#include "signed_leaves.h"

#include <memory>
#include <vector>

#include <openvdb/openvdb.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "leaf_values.h"
#include "sign_flood.h"

namespace particle_surface_tracker {

namespace {

using OutputLeaf = openvdb::FloatTree::LeafNodeType;

constexpr int kWidth = 8;

template <typename Visit>
void for_each_index(std::size_t count, Visit&& visit) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 16), [&](const auto& range) {
    for (std::size_t n = range.begin(); n != range.end(); ++n) visit(n);
  });
}

/// What is known of a leaf before signs are carried.
/// \param near nodes within reach.
SignLeaf seed_signs(const ImplicitSurface& surface, const NodeMasks& wanted, const NodeMasks::Leaf& wanted_leaf,
                    const LeafWords& near) {
  SignLeaf leaf;
  for (int side = 0; side < 6; ++side) {
    openvdb::Coord neighbor = wanted_leaf.origin;
    neighbor[side >> 1] += side & 1 ? kWidth : -kWidth;
    leaf.neighbors[side] = wanted.find(neighbor);
  }
  for (int x = 0; x < kWidth; ++x) leaf.unknown[x] = wanted_leaf.words[x] & near[x];
  const auto* field = surface.field->tree().probeConstLeaf(wanted_leaf.origin);
  if (field == nullptr) return leaf;
  const LeafWords positive = nodes_at_least_zero(field->buffer().data());
  for (int x = 0; x < kWidth; ++x) {
    const std::uint64_t seeds = leaf.unknown[x] & field->getValueMask().getWord<openvdb::Index64>(x);
    leaf.inside[x] = seeds & ~positive[x];
    leaf.outside[x] = seeds & positive[x];
    leaf.unknown[x] &= ~seeds;
  }
  return leaf;
}

}  // namespace

SignedDistanceField sign_distances(const ImplicitSurface& surface, const NodeMasks& wanted,
                                   const SquaredDistances& squared, double reach) {
  const auto squared_reach = static_cast<float>((reach / surface.dx) * (reach / surface.dx));
  std::vector<SignLeaf> signs(wanted.leaves().size());
  for_each_index(signs.size(), [&](std::size_t n) {
    signs[n] = seed_signs(surface, wanted, wanted.leaves()[n], nodes_at_most(squared.leaf(n), squared_reach));
  });
  flood_signs(signs);
  std::vector<std::unique_ptr<OutputLeaf>> leaves(signs.size());
  for_each_index(leaves.size(), [&](std::size_t n) {
    leaves[n] = std::make_unique<OutputLeaf>(openvdb::PartialCreate(), wanted.leaves()[n].origin);
    OutputLeaf::NodeMaskType mask;
    for (int x = 0; x < kWidth; ++x) mask.getWord<openvdb::Index64>(x) = signs[n].inside[x] | signs[n].outside[x];
    leaves[n]->setValueMask(mask);
    sign_values(squared.leaf(n), signs[n].inside, signs[n].outside, static_cast<float>(surface.dx),
                leaves[n]->buffer().data());
  });

  SignedDistanceField field;
  field.dx = surface.dx;
  field.reach = reach;
  field.phi = openvdb::FloatGrid::create(SignedDistanceField::absent);
  field.phi->setTransform(openvdb::math::Transform::createLinearTransform(surface.dx));
  field.phi->setName("phi");
  for (std::unique_ptr<OutputLeaf>& leaf : leaves) {
    if (!leaf->isEmpty()) field.phi->tree().addLeaf(leaf.release());
  }
  return field;
}

}  // namespace particle_surface_tracker
