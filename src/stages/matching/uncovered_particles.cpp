#include "uncovered_particles.h"

#include <atomic>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "near_vertices.h"
#include "particle_surface_tracker/core/particle_grid.h"
#include "stages/nodes/lattice_cell.h"
#include "triangle_extent.h"

namespace particle_surface_tracker {

namespace {

Vec3d in_cells(const Vec3f& position, double h) {
  return position.cast<double>() / h;
}

/// The particles whose cell has no corner inside, and their cells.
struct Candidates {
  std::vector<std::uint32_t> indices;
  std::vector<Vec3f> positions;
  NodeMasks cells;
};

Candidates find_candidates(const std::vector<Vec3f>& particles, const LineSigns& before,
                           const MatchedVoxelization& matched, double h) {
  NodeMasks cells;
  for (const Vec3f& particle : particles) {
    if (has_cell(in_cells(particle, h))) cells.insert(cell_of(in_cells(particle, h)));
  }
  cells.dilate(0, 1);
  NodeMasks held = inside_by_gamma(cells, before, matched);
  held.dilate(1, 0);
  Candidates candidates;
  for (std::uint32_t p = 0; p < particles.size(); ++p) {
    if (!has_cell(in_cells(particles[p], h))) continue;
    const openvdb::Coord cell = cell_of(in_cells(particles[p], h));
    if (held.contains(cell)) continue;
    candidates.indices.push_back(p);
    candidates.positions.push_back(particles[p]);
    candidates.cells.insert(cell);
  }
  return candidates;
}

}  // namespace

NodeMasks inside_by_gamma(const NodeMasks& set, const LineSigns& mesh, const MatchedVoxelization& matched) {
  NodeMasks inside(set.leaves().size());
  for (const NodeMasks::Leaf& leaf : set.leaves()) {
    if (is_zero(leaf.words)) continue;
    const LeafWords in_mesh = mesh.leaf(leaf.origin).inside;
    LeafWords& words = inside.words_at(leaf.origin);
    for (int x = 0; x < 8; ++x) words[x] = leaf.words[x] & in_mesh[x];
  }
  for (std::size_t n = 0; n < matched.nodes.size(); ++n) {
    const openvdb::Coord& node = matched.nodes[n];
    if (!set.contains(node)) continue;
    const std::uint64_t bit = std::uint64_t{1} << (8 * (node.y() & 7) + (node.z() & 7));
    std::uint64_t& word = inside.words_at(node & ~7)[node.x() & 7];
    word = matched.gamma[n] < 0.0F ? word | bit : word & ~bit;
  }
  return inside;
}

std::vector<std::uint32_t> find_uncovered_particles(const std::vector<Vec3f>& particles, const LineSigns& before,
                                                    const MatchedVoxelization& matched, const TriangleMesh& mesh,
                                                    double h, double reach) {
  const Candidates candidates = find_candidates(particles, before, matched, h);
  if (candidates.indices.empty()) return {};
  const ParticleGrid grid(candidates.positions, reach);
  // A particle is up to h from the node of its cell. The few triangles that are longer than two cells are all looked
  // at.
  const double longest = 2.0 * h;
  const auto squared_longest = static_cast<float>(longest * longest);
  const NearVertices near(mesh.positions(), candidates.cells, h, reach + h + longest);
  // Threads only ever set a mark, so their order does not matter.
  std::vector<std::atomic<char>> is_covered(candidates.indices.size());
  const auto cover = [&](const Triangle& t) {
    const std::vector<Vec3f>& positions = mesh.positions();
    if (!near.may_be_near(t[0]) && !may_be_longer(positions, t, squared_longest)) return;
    const Vec3f lower = positions[t[0]].cwiseMin(positions[t[1]]).cwiseMin(positions[t[2]]);
    const Vec3f upper = positions[t[0]].cwiseMax(positions[t[1]]).cwiseMax(positions[t[2]]);
    const Vec3d margin = Vec3d::Constant(reach);
    const Corners corners = corners_of(positions, t);
    const auto cover_each = [&](std::uint32_t begin, std::uint32_t end) {
      for (std::uint32_t n = begin; n < end; ++n) {
        std::atomic<char>& mark = is_covered[grid.index()[n]];
        // Dozens of triangles cover the same particle.
        if (mark.load(std::memory_order_relaxed) != 0) continue;
        const openvdb::Vec3d place(grid.x()[n], grid.y()[n], grid.z()[n]);
        if (squared_distance(corners, place) <= reach * reach) mark.store(1, std::memory_order_relaxed);
      }
    };
    grid.for_each_range(grid.cell_of(lower.cast<double>() - margin), grid.cell_of(upper.cast<double>() + margin),
                        cover_each);
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, mesh.triangle_count(), 1024), [&](const auto& range) {
    for (std::size_t t = range.begin(); t != range.end(); ++t) cover(mesh.triangles()[t]);
  });
  std::vector<std::uint32_t> uncovered;
  for (std::size_t n = 0; n < candidates.indices.size(); ++n) {
    if (is_covered[n].load(std::memory_order_relaxed) == 0) uncovered.push_back(candidates.indices[n]);
  }
  return uncovered;
}

}  // namespace particle_surface_tracker
