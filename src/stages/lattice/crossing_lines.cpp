#include "crossing_lines.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include <oneapi/tbb/parallel_for.h>

#include "crossing_finder.h"
#include "lattice_predicates.h"
#include "triangle_blocks.h"

namespace particle_surface_tracker {

namespace {

CrossedTriangle crossed_triangle(const LatticeMesh& mesh, const EdgeCrossing& crossing) {
  const auto& [a, b, c] = mesh.triangle(crossing.triangle);
  return {{&mesh.position(a), &mesh.position(b), &mesh.position(c)}, -crossing.step};
}

/// Order of two crossings of one edge.
bool is_before(const LatticeMesh& mesh, const EdgeCrossing& p, const EdgeCrossing& q) {
  const int order =
      compare_along_line(crossed_triangle(mesh, p), crossed_triangle(mesh, q), p.edge.axis, mesh.node(p.edge.node));
  if (order != 0) return order < 0;
  return std::make_tuple(-p.step, p.triangle) < std::make_tuple(-q.step, q.triangle);
}

/// What crossings are sorted by first.
struct EdgeKey {
  openvdb::Coord node;
  std::uint32_t number;
};

/// Up to so many lattice planes there is one counter for each.
constexpr std::int64_t kMostPlanes = 1 << 16;

/// Sorts by one coordinate, and leaves those in their order that have the same.
void sort_stably(std::vector<EdgeKey>& keys, int axis, std::vector<EdgeKey>& scratch) {
  if (keys.empty()) return;
  std::int32_t lowest = keys.front().node[axis];
  std::int32_t highest = lowest;
  for (const EdgeKey& key : keys) {
    lowest = std::min(lowest, key.node[axis]);
    highest = std::max(highest, key.node[axis]);
  }
  const std::int64_t planes = std::int64_t{highest} - lowest + 1;
  if (planes > kMostPlanes) {
    std::stable_sort(keys.begin(), keys.end(),
                     [&](const EdgeKey& p, const EdgeKey& q) { return p.node[axis] < q.node[axis]; });
    return;
  }
  std::vector<std::uint32_t> begin(static_cast<std::size_t>(planes) + 1, 0);
  for (const EdgeKey& key : keys) ++begin[key.node[axis] - lowest + 1];
  for (std::size_t n = 1; n < begin.size(); ++n) begin[n] += begin[n - 1];
  scratch.resize(keys.size());
  for (const EdgeKey& key : keys) scratch[begin[key.node[axis] - lowest]++] = key;
  keys.swap(scratch);
}

/// Sorts by edge, and leaves those of one edge in their order.
void sort_by_edge(std::vector<EdgeCrossing>& crossings) {
  std::array<std::vector<EdgeKey>, 3> keys;
  for (std::vector<EdgeKey>& some : keys) some.reserve(crossings.size() / 2);
  for (std::uint32_t n = 0; n < crossings.size(); ++n) {
    keys[crossings[n].edge.axis].push_back({crossings[n].edge.node, n});
  }
  tbb::parallel_for(0, 3, [&](int axis) {
    std::vector<EdgeKey> scratch;
    for (const int coordinate : {axis, (axis + 2) % 3, (axis + 1) % 3}) sort_stably(keys[axis], coordinate, scratch);
  });
  std::vector<EdgeCrossing> sorted;
  sorted.reserve(crossings.size());
  for (const std::vector<EdgeKey>& some : keys) {
    for (const EdgeKey& key : some) sorted.push_back(crossings[key.number]);
  }
  crossings = std::move(sorted);
}

}  // namespace

CrossingLines::CrossingLines(const LatticeMesh& mesh) {
  find(mesh);
  order_edges(mesh);
  index_lines();
}

void CrossingLines::find(const LatticeMesh& mesh) {
  std::vector<std::vector<EdgeCrossing>> found(triangle_block_count(mesh));
  for_triangle_blocks(mesh, [&](std::size_t block, std::uint32_t begin, std::uint32_t end) {
    CrossingFinder finder(mesh);
    found[block].reserve(2 * kTrianglesPerBlock);
    for (std::uint32_t t = begin; t < end; ++t) finder.append_crossings(t, found[block]);
  });
  std::size_t count = 0;
  for (const auto& part : found) count += part.size();
  crossings_.reserve(count);
  for (const auto& part : found) crossings_.insert(crossings_.end(), part.begin(), part.end());
}

void CrossingLines::order_edges(const LatticeMesh& mesh) {
  sort_by_edge(crossings_);
  std::vector<std::array<std::size_t, 2>> shared;
  for (std::size_t begin = 0, end = 0; begin < crossings_.size(); begin = end) {
    while (end < crossings_.size() && crossings_[end].edge == crossings_[begin].edge) ++end;
    if (end - begin > 1) shared.push_back({begin, end});
  }
  tbb::parallel_for(std::size_t{0}, shared.size(), [&](std::size_t n) {
    EdgeCrossing* const all = crossings_.data();
    std::sort(all + shared[n][0], all + shared[n][1],
              [&](const EdgeCrossing& p, const EdgeCrossing& q) { return is_before(mesh, p, q); });
  });
}

void CrossingLines::index_lines() {
  windings_.resize(crossings_.size());
  const LatticeEdge* last = nullptr;
  for (std::size_t n = 0; n < crossings_.size(); ++n) {
    const LatticeEdge& edge = crossings_[n].edge;
    const int first = (edge.axis + 1) % 3;
    const int second = (edge.axis + 2) % 3;
    const bool is_same_line = last != nullptr && last->axis == edge.axis && last->node[first] == edge.node[first] &&
                              last->node[second] == edge.node[second];
    if (!is_same_line) lines_[edge.axis].push_back({edge.node[first], edge.node[second], n, n});
    windings_[n] = crossings_[n].step + (is_same_line ? windings_[n - 1] : 0);
    lines_[edge.axis].back().end = n + 1;
    last = &edge;
  }
}

ArrayRange<EdgeCrossing> CrossingLines::line_through(const openvdb::Coord& node, int axis) const {
  const std::int32_t first = node[(axis + 1) % 3];
  const std::int32_t second = node[(axis + 2) % 3];
  const auto line = std::lower_bound(lines_[axis].begin(), lines_[axis].end(), std::make_tuple(first, second),
                                     [](const Line& candidate, const std::tuple<std::int32_t, std::int32_t>& place) {
                                       return std::make_tuple(candidate.first, candidate.second) < place;
                                     });
  if (line == lines_[axis].end() || line->first != first || line->second != second) return {};
  return {crossings_.data() + line->begin, crossings_.data() + line->end};
}

ArrayRange<EdgeCrossing> CrossingLines::on_edge(const LatticeEdge& edge) const {
  const ArrayRange<EdgeCrossing> line = line_through(edge.node, edge.axis);
  const auto before = [](const EdgeCrossing& crossing, const LatticeEdge& place) { return crossing.edge < place; };
  const auto after = [](const LatticeEdge& place, const EdgeCrossing& crossing) { return place < crossing.edge; };
  const EdgeCrossing* const begin = std::lower_bound(line.begin(), line.end(), edge, before);
  return {begin, std::upper_bound(begin, line.end(), edge, after)};
}

int CrossingLines::winding_number(const openvdb::Coord& node, int axis) const {
  const ArrayRange<EdgeCrossing> line = line_through(node, axis);
  const EdgeCrossing* const beyond = std::partition_point(
      line.begin(), line.end(), [&](const EdgeCrossing& crossing) { return crossing.edge.node[axis] < node[axis]; });
  return beyond == line.begin() ? 0 : windings_[static_cast<std::size_t>(beyond - crossings_.data()) - 1];
}

}  // namespace particle_surface_tracker
