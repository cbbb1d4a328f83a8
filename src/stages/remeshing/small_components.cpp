#include "small_components.h"

#include <algorithm>
#include <map>

#include <Eigen/Geometry>

#include "cell_set.h"
#include "lattice_parts.h"

namespace particle_surface_tracker::remeshing {

namespace {

using IsLiquid = std::function<bool(const openvdb::Coord&)>;

double six_volumes(const MeshLattice& lattice, const std::vector<std::uint32_t>& members) {
  const auto at = [&](std::uint32_t vertex) { return lattice.positions()[vertex].cast<double>().eval(); };
  const Vec3d origin = at(lattice.triangles()[members.front()][0]);
  double sum = 0.0;
  for (const std::uint32_t member : members) {
    const auto& [a, b, c] = lattice.triangles()[member];
    sum += (at(a) - origin).dot((at(b) - origin).cross(at(c) - origin));
  }
  return sum;
}

/// Corners of the cells that some triangles meet.
std::vector<openvdb::Coord> nodes_around(TriangleCuts& cuts, const std::vector<std::uint32_t>& members) {
  CellSet cells;
  for (const std::uint32_t member : members) {
    const TriangleCut& cut = cuts.of(member);
    for (const openvdb::Coord& cell : cut.cells) cells.insert(cell);
    for (const TriangleCut::Segment& segment : cut.segments) {
      cells.insert(segment.face.lower_cell());
      cells.insert(segment.face.upper_cell());
    }
  }
  CellSet nodes;
  for (const openvdb::Coord& cell : cells.cells()) {
    for (int corner = 0; corner < kCellCorners; ++corner) nodes.insert(corner_of(cell, corner));
  }
  return nodes.cells();
}

bool is_confirmed(TriangleCuts& cuts, const std::vector<std::uint32_t>& members, const IsLiquid& is_liquid) {
  const double volume = six_volumes(cuts.lattice(), members);
  if (volume == 0.0) return false;
  const bool is_drop = volume > 0.0;
  const std::vector<openvdb::Coord> nodes = nodes_around(cuts, members);
  const auto is_surrounded = [&](const openvdb::Coord& node) {
    return cuts.lattice().winding_number(node) == (is_drop ? 0 : 1);
  };
  const auto speaks_for_it = [&](const openvdb::Coord& node) {
    return (is_liquid != nullptr && is_liquid(node)) == is_drop;
  };
  return std::all_of(nodes.begin(), nodes.end(), is_surrounded) &&
         std::any_of(nodes.begin(), nodes.end(), speaks_for_it);
}

}  // namespace

bool SmallComponents::contain(std::uint32_t triangle) const {
  return std::binary_search(kept.begin(), kept.end(), triangle) ||
         std::binary_search(removed.begin(), removed.end(), triangle);
}

SmallComponents find_small_components(TriangleCuts& cuts, const VertexComponents& components,
                                      const IsLiquid& is_liquid) {
  SmallComponents result;
  const std::vector<Triangle>& triangles = cuts.lattice().triangles();
  const std::vector<std::uint32_t>& component = components.of_vertex;
  std::vector<char> crosses(components.count, 0);
  for (const EdgeCrossing& crossing : cuts.lattice().crossings()) {
    crosses[component[triangles[crossing.triangle][0]]] = 1;
  }
  if (std::find(crosses.begin(), crosses.end(), 0) == crosses.end()) return result;

  std::map<std::uint32_t, std::vector<std::uint32_t>> members;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t c = component[triangles[t][0]];
    if (crosses[c] == 0) members[c].push_back(t);
  }
  for (const auto& [c, its_triangles] : members) {
    const bool stays = is_confirmed(cuts, its_triangles, is_liquid);
    ++(stays ? result.kept_count : result.removed_count);
    std::vector<std::uint32_t>& list = stays ? result.kept : result.removed;
    list.insert(list.end(), its_triangles.begin(), its_triangles.end());
  }
  std::sort(result.kept.begin(), result.kept.end());
  std::sort(result.removed.begin(), result.removed.end());
  return result;
}

}  // namespace particle_surface_tracker::remeshing
