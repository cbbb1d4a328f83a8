#pragma once

#include "node_lattice.h"
#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker::implicit {

/// The largest number of fine cells along an edge of a coarse cell.
constexpr int kLargestRatio = 31;

/// Requests the corners of the fine cells that the surface probably passes through, by trilinear interpolation in the
/// coarse cells that it passes through.
/// \param coarse every mixed cell has values at all corners.
/// \param ratio fine cells along an edge of a coarse cell.
/// \param margin cells are requested where the surface is that close to passing through them [m].
void request_predicted_cells(const NodeLattice& coarse, int ratio, double margin, NodeLattice& fine);

/// Requests all fine nodes within about r of particles that no coarse node near them accounts for: the drop around a
/// lone particle is drawn aside by particles far away and shrinks, so that it fits between the coarse nodes.
/// \param particles its cells are centred at the coarse nodes.
/// \param reach r in units of the fine cell, rounded up.
void request_around_stray_particles(const ParticleGrid& particles, const NodeLattice& coarse, int ratio, int reach,
                                    NodeLattice& fine);

/// Requests all fine nodes around coarse nodes that are barely inside although the surface passes through no coarse
/// cell next to them: there may be a bubble between the coarse nodes.
/// \param depth how far φ̃ is below zero at most [m].
void request_around_shallow_nodes(const NodeLattice& coarse, int ratio, double depth, NodeLattice& fine);

/// Gives the blocks of the fine lattice the values known from the coarse one.
void share_values(const NodeLattice& coarse, int ratio, NodeLattice& fine);

}  // namespace particle_surface_tracker::implicit
