// The measurements of docs/topology_matching.md, on a recorded sequence: what detection finds, and how topology
// matching depends on its reach and its solver.

#include <algorithm>
#include <cmath>
#include <ctime>
#include <iterator>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/stages/disagreement.h"
#include "particle_surface_tracker/stages/topology_matching.h"
#include "particle_surface_tracker/tracker/tracker.h"
#include "sequences/sequence_data.h"

namespace particle_surface_tracker {

namespace {

struct Options {
  std::string sequence = "two_drops";
  std::size_t first = 0;
  std::size_t last = 40;
  int restart = 0;  // frames after which the mesh is made anew from the particles; 0: never
  std::size_t smallest = 1;
  std::vector<double> reaches = {1, 2, 3, 4, 6};
};

double cpu_ms() {
  return 1e3 * static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Run {
  MatchedVoxelization matched;
  double milliseconds = 0.0;
};

Run run(const MeshLattice& lattice, const ImplicitSurface& surface, const std::vector<openvdb::Coord>& cells,
        const Parameters& parameters) {
  const double begin = cpu_ms();
  Run result{match_topology(MeshQuery(lattice), IsosurfaceQuery(surface, lattice.h()), cells, parameters)};
  result.milliseconds = cpu_ms() - begin;
  return result;
}

/// The changed nodes of one that the other did not change.
struct Missed {
  std::size_t count = 0;
  double depth = 0.0;  ///< Largest |Γ| at one of them [m]: small where only the place of the zero differs.
};

Missed missed_by(const MatchedVoxelization& a, const MatchedVoxelization& b) {
  std::vector<openvdb::Coord> difference;
  std::set_difference(a.changed.begin(), a.changed.end(), b.changed.begin(), b.changed.end(),
                      std::back_inserter(difference));
  Missed missed{difference.size()};
  for (const openvdb::Coord& node : difference) {
    const auto found = std::lower_bound(a.nodes.begin(), a.nodes.end(), node) - a.nodes.begin();
    missed.depth = std::max(missed.depth, std::abs(static_cast<double>(a.gamma[found])));
  }
  return missed;
}

void print(const std::string& name, const Run& run, const Run& reference, double h) {
  const MatchingStatistics& s = run.matched.statistics;
  const Missed missed = missed_by(reference.matched, run.matched);
  const Missed extra = missed_by(run.matched, reference.matched);
  fmt::print(
      "    {:12} {:8} unknown {:7} fixed {:5} free {:6} iterations {:2} enlargements {:6} changed {:5} missed {:5} "
      "extra {:5.2f} h deep {:8.1f} ms\n",
      name, s.unknowns, s.fixed, s.free_unknowns, s.iterations, s.enlargements, run.matched.changed.size(),
      missed.count, extra.count, std::max(missed.depth, extra.depth) / h, run.milliseconds);
}

double largest_difference(const MatchedVoxelization& a, const MatchedVoxelization& b) {
  double largest = 0.0;
  for (std::size_t n = 0; n < a.gamma.size() && a.nodes.size() == b.nodes.size(); ++n) {
    largest = std::max(largest, std::abs(static_cast<double>(a.gamma[n]) - static_cast<double>(b.gamma[n])));
  }
  return largest;
}

void study_frame(std::size_t frame, const Tracker& tracker, const Options& options) {
  Parameters parameters = tracker.parameters();
  const TriangleMesh& mesh = tracker.mesh();
  const double h = parameters.dx_gamma * parameters.particle_spacing;
  const double lattice_begin = cpu_ms();
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), h);
  const double begin = cpu_ms();
  const IsosurfaceQuery isosurface(*tracker.implicit_surface(), lattice.h());
  const Disagreement disagreement = find_disagreement(MeshQuery(lattice), mesh.delta(), isosurface, parameters);
  const double end = cpu_ms();
  std::vector<openvdb::Coord> cells = tracker.detection().flagged_cells;
  const std::size_t by_tau = cells.size();
  cells.insert(cells.end(), disagreement.flagged_cells.begin(), disagreement.flagged_cells.end());
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  fmt::print(
      "frame {:3}: {:6} triangles, {:5} cells flagged by tau, {:5} more by {:5} nodes in {:.1f} ms (lattice {:.1f} "
      "ms)\n",
      frame, mesh.triangle_count(), by_tau, cells.size() - by_tau, disagreement.nodes.size(), end - begin,
      begin - lattice_begin);
  if (cells.size() < options.smallest || options.reaches.empty()) return;
  const ImplicitSurface& surface = *tracker.implicit_surface();
  parameters.matching_reach = 0.0;
  parameters.matching_solver = MatchingSolver::kPcg;
  const Run whole = run(lattice, surface, cells, parameters);
  print("whole, pcg", whole, whole, h);
  parameters.matching_solver = MatchingSolver::kSor;
  const Run whole_sor = run(lattice, surface, cells, parameters);
  print("whole, sor", whole_sor, whole, h);
  fmt::print("      sor differs by up to {:.1f} beta\n",
             largest_difference(whole_sor.matched, whole.matched) / (parameters.beta * h));
  for (const double reach : options.reaches) {
    parameters.matching_reach = reach;
    parameters.matching_solver = MatchingSolver::kPcg;
    const Run pcg = run(lattice, surface, cells, parameters);
    print(fmt::format("{} r, pcg", reach), pcg, whole, h);
    parameters.matching_solver = MatchingSolver::kSor;
    const Run sor = run(lattice, surface, cells, parameters);
    print(fmt::format("{} r, sor", reach), sor, pcg, h);
    fmt::print("      sor differs by up to {:.1f} beta\n",
               largest_difference(sor.matched, pcg.matched) / (parameters.beta * h));
  }
}

void study(const Options& options) {
  const test::Sequence sequence = test::load_sequence(options.sequence, options.last + 1);
  Parameters parameters;
  parameters.particle_spacing = sequence.spacing;
  Tracker tracker(parameters);
  for (std::size_t n = options.first; n < sequence.frames.size(); ++n) {
    const bool from_particles = options.restart > 0 && (n - options.first) % options.restart == 0;
    if (from_particles) {
      tracker.start_from_particles(sequence.frames[n], n);
    } else if (!tracker.started()) {
      tracker.start(sequence.mesh, sequence.frames[n], n);
    } else {
      tracker.advance(sequence.frames[n], n);
    }
    study_frame(n, tracker, options);
  }
}

}  // namespace

}  // namespace particle_surface_tracker

int main(int argc, char** argv) {
  particle_surface_tracker::Options options;
  CLI::App app("What detection finds in a recorded sequence, and what topology matching makes of it");
  app.add_option("sequence", options.sequence, "name of the sequence");
  app.add_option("--first", options.first, "first frame");
  app.add_option("--last", options.last, "last frame");
  app.add_option("--restart", options.restart, "make the mesh anew from the particles every so many frames; 0: never");
  app.add_option("--smallest", options.smallest, "match frames with at least so many flagged cells only");
  app.add_option("--reach", options.reaches, "reaches to compare [r]");
  CLI11_PARSE(app, argc, argv);
  try {
    particle_surface_tracker::study(options);
  } catch (const particle_surface_tracker::Error& error) {
    fmt::print(stderr, "matching_study: {}\n", error.what());
    return 2;
  }
  return 0;
}
