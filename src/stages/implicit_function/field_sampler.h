#pragma once

#include <cstdint>
#include <vector>

#include "implicit_kernel.h"
#include "node_lattice.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker::implicit {

/// Evaluates φ̃ at the nodes of lattices, many nodes at a time.
class FieldSampler {
 public:
  FieldSampler(const ParticleGrid& particles, const Parameters& parameters);

  /// Evaluates the requested nodes of some blocks, in parallel, and accepts their values.
  /// \param spacing distance between the nodes of the lattice [m].
  void evaluate(NodeLattice& lattice, const std::vector<std::uint32_t>& blocks, double spacing) const;

 private:
  struct Scratch;

  void evaluate_unit(NodeLattice& lattice, const LatticeCoord& origin, double spacing, Scratch& scratch) const;
  void evaluate_cube(NodeLattice& lattice, std::uint32_t block, const Cube& cube, int place, Scratch& scratch) const;
  void finish_batch(NodeLattice& lattice, std::size_t end, Scratch& scratch) const;

  const ParticleGrid& particles_;
  const Kernel& kernel_;
  KernelConstants constants_;
};

}  // namespace particle_surface_tracker::implicit
