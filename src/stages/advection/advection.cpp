#include "particle_surface_tracker/stages/advection.h"

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

  const SortedMotion sorted(motion, grid);
  const ParticleGrid vertex_grid(vertices, VertexAdvection::cell_size(grid));
  const auto& tiles = vertex_grid.tiles();
  tbb::enumerable_thread_specific<VertexAdvection> advections([&] { return VertexAdvection(sorted, parameters); });
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, tiles.size()), [&](const auto& range) {
    VertexAdvection& advection = advections.local();
    for (std::size_t t = range.begin(); t != range.end(); ++t) {
      advection.advect_tile(vertex_grid, tiles[t], advected);
    }
  });
  return advected;
}

}  // namespace particle_surface_tracker
