#pragma once

#include <string>
#include <vector>

#include "sequences/sequence_data.h"

namespace particle_surface_tracker::test {

/// φ = 0 of some particles as a first mesh.
/// \param r particle spacing [m].
TriangleMesh implicit_mesh(const ParticleFrame& particles, double r);

/// Liquids whose particles move by formulas, made to be hard to follow: spray, films of one particle, drops that join a
/// pool, liquid that is drawn out, particles that appear and vanish. The first mesh is φ = 0 of the first frame. Same
/// name, same bytes.
///
/// - fountain: particles are thrown up from a disc, spread, fall, and vanish at the ground
/// - sheet: a disc of one layer of particles spreads until it tears into drops
/// - squeeze: a ball is pressed flat, to less than one particle
/// - rain: drops fall into a pool and spread in it
/// - jets: two jets cross
///
/// \throw std::invalid_argument for any other name.
Sequence make_moving_liquid(const std::string& name);

/// All names.
std::vector<std::string> moving_liquid_names();

}  // namespace particle_surface_tracker::test
