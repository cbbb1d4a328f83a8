#include "particle_surface_tracker/stages/distance_field.h"

#include <algorithm>
#include <cmath>

#include "band_distances.h"
#include "closest_place.h"
#include "signed_leaves.h"
#include "stages/nodes/lattice_cell.h"
#include "stages/nodes/node_masks.h"
#include "surface_cells.h"

namespace particle_surface_tracker {

namespace {

/// Around a cell, the nodes of a cubic stencil: one more below the lower corner, two more above it, along each axis.
constexpr int kStencilDown = 1;
constexpr int kStencilUp = 2;

/// A search that does not go quite straight stays within this of the way [cells].
constexpr int kWayWidth = 1;

/// The least that a band around a position holds along each axis [cells].
constexpr double kSmallestBand = 4.0;

void insert_cut_cells(const SurfaceCells& surface, NodeMasks& cells) {
  const std::vector<CutCell>& cut = surface.surface().triangulation.cells;
  for (const SurfaceCells::Leaf& leaf : surface.leaves()) {
    LeafWords& words = cells.words_at(leaf.origin);
    for (std::uint32_t c = leaf.begin; c != leaf.end; ++c) {
      const openvdb::Coord at = cut[c].origin - leaf.origin;
      words[at.x()] |= std::uint64_t{1} << (8 * at.y() + at.z());
    }
  }
}

void insert_cells_of(const std::vector<Vec3f>& positions, double dx, NodeMasks& cells) {
  const double per_meter = 1.0 / dx;
  for (const Vec3f& position : positions) {
    const Vec3d lattice = position.cast<double>() * per_meter;
    if (has_cell(lattice)) cells.insert(cell_of(lattice));
  }
}

/// The cells on the straight way between two positions [cells], and a few beside it.
void insert_way(const Vec3d& from, const Vec3d& to, NodeMasks& cells) {
  const auto steps = static_cast<int>(std::ceil(2.0 * (to - from).norm()));
  for (int i = 0; i <= steps; ++i) cells.insert(cell_of(from + (to - from) * (i / std::max(1.0, 1.0 * steps))));
}

SignedDistanceField make_field(const SurfaceCells& cells, const NodeMasks& wanted, double reach) {
  return sign_distances(cells.surface(), wanted, measure_distances(cells, wanted, reach / cells.surface().dx), reach);
}

}  // namespace

DistanceFields::DistanceFields(const ImplicitSurface& surface)
    : surface_(surface), cells_(std::make_shared<SurfaceCells>(surface)) {}

DistanceFields::~DistanceFields() = default;

SignedDistanceField DistanceFields::at_stencils(const std::vector<Vec3f>& positions, double reach) const {
  NodeMasks wanted;
  insert_cut_cells(*cells_, wanted);
  insert_cells_of(positions, surface_.dx, wanted);
  wanted.dilate(kStencilDown, kStencilUp);
  return make_field(*cells_, wanted, reach);
}

SignedDistanceField DistanceFields::on_ways(const std::vector<Vec3f>& positions, double reach) const {
  NodeMasks wanted;
  ClosestPlaceSearch search(*cells_, reach / surface_.dx);
  const double farthest = (reach / surface_.dx) * (reach / surface_.dx);
  for (const Vec3f& position : positions) {
    const Vec3d lattice = position.cast<double>() / surface_.dx;
    if (!has_cell(lattice)) continue;
    const ClosestPlace closest = search.find(lattice);
    if (closest.squared_distance <= farthest) insert_way(lattice, closest.place, wanted);
  }
  wanted.dilate(kStencilDown + kWayWidth, kStencilUp + kWayWidth);
  return make_field(*cells_, wanted, reach);
}

SignedDistanceField DistanceFields::around(const std::vector<Vec3f>& positions, double reach) const {
  NodeMasks wanted;
  insert_cells_of(positions, surface_.dx, wanted);
  const int width = static_cast<int>(std::ceil(std::max(reach / surface_.dx, kSmallestBand)));
  wanted.dilate(width, width + 1);
  return make_field(*cells_, wanted, reach);
}

SignedDistanceField DistanceFields::everywhere(double reach) const {
  NodeMasks wanted;
  insert_cut_cells(*cells_, wanted);
  const int width = static_cast<int>(std::ceil(reach / surface_.dx));
  wanted.dilate(width, width + 1);
  return make_field(*cells_, wanted, reach);
}

}  // namespace particle_surface_tracker
