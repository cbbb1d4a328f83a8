#include "particle_surface_tracker/stages/topology_matching.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "field_at_nodes.h"
#include "line_signs.h"
#include "matching_problem.h"
#include "matching_region.h"
#include "nodes_at_surfaces.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

namespace {

/// The region grows where Γ changes sides near its rim, but not for ever.
constexpr int kMostEnlargements = 6;

/// It grows by at least this, so that what changed is no longer near the rim, and by twice as much in every round, so
/// that a long bubble is not left half done [nodes].
constexpr int kSmallestGrowth = 3;

/// Up to here distances from the isosurface cost little, and most ψ are smaller [cells].
constexpr double kNearIsosurface = 4.0;

/// With the paper's ω_opt a few times N sweeps are enough.
constexpr int kMostIterations = 20000;

/// The conjugate gradients end when no residual exceeds this part of the largest right-hand side.
constexpr double kPcgTolerance = 1e-8;

/// Around mesh and isosurface, when the whole domain is asked for [nodes].
constexpr int kMargin = 3;
constexpr double kLargestDomain = 1 << 28;

/// Nodes, in order, with ψ at them.
NodeValues values_at(const std::vector<openvdb::Coord>& nodes, const double* psi) {
  std::vector<std::size_t> order(nodes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return nodes[a] < nodes[b]; });
  NodeValues values;
  for (const std::size_t n : order) {
    values.nodes.push_back(nodes[n]);
    values.values.push_back(static_cast<float>(psi[n]));
  }
  return values;
}

/// Rounds of solving in a region that grows.
class TopologyMatching {
 public:
  TopologyMatching(const MeshQuery& mesh, const FieldAtNodes& field, const NodeMasks& flagged,
                   const NodeMasks& follows_phi, const Parameters& parameters, TopologyCells* record)
      : lattice_(mesh.lattice()),
        flagged_(flagged),
        follows_phi_(follows_phi),
        parameters_(parameters),
        record_(record),
        diagonal_(std::sqrt(3.0) * mesh.lattice().h()),
        mesh_signs_(mesh.signs()),
        field_(field) {}

  /// \param reach by which the region grows where it is too small [nodes]; 0: never.
  MatchedVoxelization run(NodeMasks region, int reach) {
    for (int round = 0;; ++round) {
      solve(region);
      if (reach == 0 || round == kMostEnlargements) break;
      NodeMasks more;
      for (const openvdb::Coord& node : result_.changed) {
        if (is_near_rim(region, node)) more.insert(node);
      }
      if (more.leaves().empty()) break;
      ++result_.statistics.enlargements;
      const int growth = std::max(reach, kSmallestGrowth) << round;
      more.dilate(growth, growth);
      unite(region, more);
    }
    return std::move(result_);
  }

 private:
  /// Algorithm 1 on the nodes of a region.
  void solve(const NodeMasks& region) {
    const MatchingNodes nodes = classify_nodes(region, flagged_, mesh_signs_);
    MatchingProblem problem(nodes);
    const double reach = fix_values(problem);
    guess_from_fixed_values(problem.poisson);
    const SolverResult solved = parameters_.matching_solver == MatchingSolver::kSor
                                    ? solve_sor(problem.poisson, parameters_.beta * lattice_.h(), kMostIterations)
                                    : solve_pcg(problem.poisson, kPcgTolerance, kMostIterations);
    MatchingStatistics& statistics = result_.statistics;
    statistics.unknowns = problem.unknowns.nodes().size();
    statistics.free_unknowns = problem.free_unknowns;
    statistics.fixed = problem.fixed.size();
    statistics.iterations += solved.iterations;
    statistics.converged = solved.converged;
    statistics.residual = largest_residual(problem.poisson);
    if (record_ != nullptr) {
      record_->unknown = values_at(problem.unknowns.nodes(), problem.poisson.values.data());
      record_->fixed = values_at(problem.fixed, problem.poisson.values.data() + problem.poisson.size());
    }
    take_over(nodes.unknown, problem, reach);
  }

  /// ψ = Γ − φ at the fixed nodes (Eq. 2).
  /// \return how far φ has to be known [m]: no |ψ| is larger than those at the fixed nodes.
  double fix_values(MatchingProblem& problem) const {
    const double farthest = parameters_.max_reach * parameters_.particle_spacing + 2.0 * diagonal_;
    const std::vector<float> phi = field_.distances(problem.fixed, farthest);
    const std::vector<float> gamma = signed_distances(lattice_, problem.fixed, 1.001 * diagonal_);
    double largest = 0.0;
    for (std::size_t n = 0; n < problem.fixed.size(); ++n) {
      const double psi = static_cast<double>(gamma[n]) - static_cast<double>(phi[n]);
      problem.poisson.values[problem.poisson.size() + n] = psi;
      // Where φ is cut off at a fixed node, it must be cut off at the same distance around it.
      largest = std::max(largest, std::abs(phi[n]) < static_cast<float>(farthest) ? std::abs(psi) : farthest);
    }
    return std::min(largest + diagonal_, farthest);
  }

  /// φ at nodes, as far as it matters: where it is larger than |ψ|, Γ has its side whatever it is.
  /// \param psi one per node, and others behind [m].
  /// \param reach where φ may matter at all [m].
  std::vector<float> field_at(const std::vector<openvdb::Coord>& nodes, const std::vector<double>& psi,
                              double reach) const {
    const double near = std::min(kNearIsosurface * lattice_.h(), reach);
    std::vector<float> phi = field_.distances(nodes, near);
    if (near == reach) return phi;
    // Zeros of Γ are placed by nodes up to a diagonal away from them.
    std::vector<std::size_t> places;
    std::vector<openvdb::Coord> far;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      if (std::abs(static_cast<double>(phi[n])) < near - diagonal_ || std::abs(psi[n]) < near - 2.0 * diagonal_)
        continue;
      places.push_back(n);
      far.push_back(nodes[n]);
    }
    const std::vector<float> farther = field_.distances(far, reach);
    for (std::size_t n = 0; n < far.size(); ++n) phi[places[n]] = farther[n];
    return phi;
  }

  /// Γ = ψ + φ at the unknowns; at those that are to have the side of φ, without what takes Γ towards the other one.
  void take_over(const NodeMasks& unknown, const MatchingProblem& problem, double reach) {
    result_.nodes = problem.unknowns.nodes();
    const std::vector<float> phi = field_at(result_.nodes, problem.poisson.values, reach);
    result_.gamma.resize(phi.size());
    for (std::size_t n = 0; n < phi.size(); ++n) {
      double psi = problem.poisson.values[n];
      if (follows_phi_.contains(result_.nodes[n])) psi = phi[n] < 0.0F ? std::min(psi, 0.0) : std::max(psi, 0.0);
      result_.gamma[n] = static_cast<float>(psi + static_cast<double>(phi[n]));
    }
    std::vector<char> has_changed(phi.size(), 0);
    for (const NodeMasks::Leaf& leaf : unknown.leaves()) {
      const LeafWords inside = mesh_signs_.leaf(leaf.origin).inside;
      for (int x = 0; x < 8; ++x) {
        for_each_bit(leaf.words[x], [&](int bit) {
          const std::uint32_t n = problem.unknowns.find(leaf.origin.offsetBy(x, bit >> 3, bit & 7));
          has_changed[n] = static_cast<char>((inside[x] >> bit & 1) != (result_.gamma[n] < 0.0f ? 1u : 0u));
        });
      }
    }
    result_.changed.clear();
    for (std::size_t n = 0; n < phi.size(); ++n) {
      if (has_changed[n] != 0) result_.changed.push_back(result_.nodes[n]);
    }
  }

  const MeshLattice& lattice_;
  const NodeMasks& flagged_;
  const NodeMasks& follows_phi_;
  const Parameters& parameters_;
  TopologyCells* record_;
  double diagonal_;
  const LineSigns& mesh_signs_;
  const FieldAtNodes& field_;
  MatchedVoxelization result_;
};

/// All nodes in the box around mesh and isosurface.
NodeMasks whole_domain(const NodeMasks& surfaces) {
  NodeMasks domain;
  if (surfaces.leaves().empty()) return domain;
  openvdb::CoordBBox box;
  for (const NodeMasks::Leaf& leaf : surfaces.leaves()) {
    for (int x = 0; x < 8; ++x) {
      for_each_bit(leaf.words[x], [&](int bit) { box.expand(leaf.origin.offsetBy(x, bit >> 3, bit & 7)); });
    }
  }
  box.expand(kMargin);
  const openvdb::Coord size = box.dim();
  const double nodes = static_cast<double>(size.x()) * size.y() * size.z();
  if (nodes > kLargestDomain) {
    throw TrackingError(
        fmt::format("matching_reach is 0, but the box around the surface has {} × {} × {} nodes of Γ, more than "
                    "{:.0f}; set a reach",
                    size.x(), size.y(), size.z(), kLargestDomain));
  }
  for (auto node = box.begin(); node; ++node) domain.insert(*node);
  return domain;
}

}  // namespace

MatchedVoxelization match_topology(const MeshQuery& mesh, const IsosurfaceQuery& isosurface,
                                   const std::vector<openvdb::Coord>& flagged_cells, const Parameters& parameters,
                                   const std::vector<openvdb::Coord>& at_conflicts, TopologyCells* record) {
  const bool everywhere = parameters.matching_frames == MatchingFrames::kEvery;
  if (flagged_cells.empty() && at_conflicts.empty() && !everywhere) return {};
  NodeMasks follows_phi;
  for (const openvdb::Coord& node : at_conflicts) follows_phi.insert(node);
  NodeMasks flagged = nodes_at_cells(flagged_cells);
  unite(flagged, follows_phi);
  const int reach =
      static_cast<int>(std::ceil(parameters.matching_reach * parameters.particle_spacing / mesh.lattice().h() - 1e-9));
  NodeMasks region = flagged;
  if (everywhere || reach == 0) unite(region, nodes_at_surfaces(mesh.lattice(), isosurface.surface()));
  if (reach == 0) {
    region = whole_domain(region);
  } else {
    region.dilate(reach, reach);
  }
  TopologyMatching matching(mesh, isosurface.field(), flagged, follows_phi, parameters, record);
  MatchedVoxelization matched = matching.run(std::move(region), reach);
  for (const NodeMasks::Leaf& leaf : flagged.leaves()) {
    for (int x = 0; x < 8; ++x) {
      matched.statistics.flagged_nodes += static_cast<std::size_t>(__builtin_popcountll(leaf.words[x]));
    }
  }
  return matched;
}

}  // namespace particle_surface_tracker
