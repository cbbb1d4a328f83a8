#include "matching_problem.h"

#include <algorithm>

namespace particle_surface_tracker {

namespace {

openvdb::Coord neighbor_of(const openvdb::Coord& node, int side) {
  openvdb::Coord neighbor = node;
  neighbor[side >> 1] += (side & 1) != 0 ? 1 : -1;
  return neighbor;
}

/// Walks through the sets of unknowns that neighbours connect.
class ConnectedSets {
 public:
  ConnectedSets(PoissonProblem& problem, const std::vector<openvdb::Coord>& nodes)
      : problem_(problem), nodes_(nodes), is_visited_(nodes.size(), 0) {}

  /// Sets the problem's width, and makes its matrix regular: where a set touches no fixed node, ψ is 0.
  /// \return the number of unknowns in such sets.
  std::size_t settle() {
    std::size_t free = 0;
    problem_.width = 1;
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      if (is_visited_[i] != 0) continue;
      visit_from(i);
      if (touches_fixed_) {
        for (int axis = 0; axis < 3; ++axis) problem_.width = std::max(problem_.width, upper_[axis] - lower_[axis] + 1);
      } else {
        ++problem_.diagonal[i];  // as if one of its missing neighbours were fixed at 0
        free += set_.size();
      }
    }
    return free;
  }

 private:
  void visit_from(std::uint32_t first) {
    const auto size = static_cast<std::uint32_t>(nodes_.size());
    const auto missing = static_cast<std::uint32_t>(problem_.values.size() - 1);
    set_.assign(1, first);
    is_visited_[first] = 1;
    touches_fixed_ = false;
    lower_ = upper_ = nodes_[first];
    for (std::size_t next = 0; next < set_.size(); ++next) {
      lower_.minComponent(nodes_[set_[next]]);
      upper_.maxComponent(nodes_[set_[next]]);
      for (const std::uint32_t n : problem_.neighbors[set_[next]]) {
        touches_fixed_ = touches_fixed_ || (n >= size && n != missing);
        if (n >= size || is_visited_[n] != 0) continue;
        is_visited_[n] = 1;
        set_.push_back(n);
      }
    }
  }

  PoissonProblem& problem_;
  const std::vector<openvdb::Coord>& nodes_;
  std::vector<char> is_visited_;
  std::vector<std::uint32_t> set_;
  bool touches_fixed_ = false;
  openvdb::Coord lower_;
  openvdb::Coord upper_;
};

}  // namespace

MatchingProblem::MatchingProblem(const MatchingNodes& nodes) : unknowns(nodes.unknown) {
  const std::vector<openvdb::Coord>& all = unknowns.nodes();
  const auto size = static_cast<std::uint32_t>(all.size());
  const NodeNumbers all_fixed(nodes.fixed);
  // Only those next to an unknown get a number.
  std::vector<std::uint32_t> number(all_fixed.nodes().size(), NodeNumbers::none);
  poisson.neighbors.resize(size);
  poisson.diagonal.assign(size, 0);
  poisson.is_red.resize(size);
  for (std::uint32_t i = 0; i < size; ++i) {
    poisson.is_red[i] = static_cast<std::uint8_t>((all[i].x() ^ all[i].y() ^ all[i].z() ^ 1) & 1);
    for (int side = 0; side < 6; ++side) {
      const openvdb::Coord neighbor = neighbor_of(all[i], side);
      std::uint32_t& at = poisson.neighbors[i][side];
      at = unknowns.find(neighbor);
      if (at == NodeNumbers::none) {
        const std::uint32_t found = all_fixed.find(neighbor);
        if (found == NodeNumbers::none) continue;
        if (number[found] == NodeNumbers::none) {
          number[found] = size + static_cast<std::uint32_t>(fixed.size());
          fixed.push_back(neighbor);
        }
        at = number[found];
      }
      ++poisson.diagonal[i];
    }
  }
  const auto missing = size + static_cast<std::uint32_t>(fixed.size());
  for (auto& neighbors : poisson.neighbors) {
    for (std::uint32_t& at : neighbors) at = at == NodeNumbers::none ? missing : at;
  }
  poisson.values.assign(missing + 1, 0.0);
  free_unknowns = ConnectedSets(poisson, all).settle();
}

}  // namespace particle_surface_tracker
