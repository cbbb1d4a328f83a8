#include "particle_surface_tracker/stages/advection.h"

#include <cstdint>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "vertex_advection.h"

namespace particle_surface_tracker {

ParticleMotion match_particles(const ParticleFrame& earlier, const ParticleFrame& later, const Parameters& parameters) {
  ParticleMotion motion;
  motion.positions.reserve(earlier.size());
  motion.displacements.reserve(earlier.size());
  const double limit = parameters.max_displacement * parameters.particle_spacing;
  std::size_t j = 0;
  for (std::size_t i = 0; i < earlier.size(); ++i) {
    while (j < later.size() && later.ids[j] < earlier.ids[i]) ++j;
    if (j == later.size()) break;
    if (later.ids[j] != earlier.ids[i]) continue;
    const Vec3d displacement = later.positions[j].cast<double>() - earlier.positions[i].cast<double>();
    if (displacement.squaredNorm() > limit * limit) continue;
    motion.positions.push_back(earlier.positions[i]);
    motion.displacements.push_back(displacement.cast<float>());
  }
  motion.gone = earlier.size() - motion.positions.size();
  motion.born = later.size() - motion.positions.size();
  return motion;
}

std::vector<Vec3f> advect(const std::vector<Vec3f>& vertices, const ParticleMotion& motion, const ParticleGrid& grid,
                          const Parameters& parameters) {
  std::vector<Vec3f> advected = vertices;
  if (motion.positions.empty() || vertices.empty()) return advected;

  // Vertices of one cell share the particles around it.
  const SortedMotion sorted(motion, grid);
  const ParticleGrid vertex_grid(vertices, grid.cell_size());
  const auto& tiles = vertex_grid.tiles();
  const std::uint32_t* const order = vertex_grid.index().data();
  tbb::enumerable_thread_specific<VertexAdvection> advections([&] { return VertexAdvection(sorted, parameters); });
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, tiles.size()), [&](const tbb::blocked_range<std::size_t>& range) {
        VertexAdvection& advection = advections.local();
        for (std::size_t t = range.begin(); t != range.end(); ++t) {
          ParticleGrid::for_each_cell(tiles[t], [&](const LatticeCoord& cell, std::uint32_t begin, std::uint32_t end) {
            advection.advect_cell(cell, order + begin, order + end, vertices, advected);
          });
        }
      });
  return advected;
}

}  // namespace particle_surface_tracker
