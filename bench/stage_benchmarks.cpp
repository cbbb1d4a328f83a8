// Times every stage on one frame of a filled body. `--mesh=FILE` takes the body from a file, else it is a procedural
// one. The argument of a benchmark is the number of particles.

#include <algorithm>
#include <cstdint>
#include <iostream>
#include <map>
#include <string>
#include <vector>

#include <benchmark/benchmark.h>

#include "filled_body.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/stages/advection.h"
#include "particle_surface_tracker/stages/disagreement.h"
#include "particle_surface_tracker/stages/distance_field.h"
#include "particle_surface_tracker/stages/implicit_function.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "particle_surface_tracker/stages/projection.h"
#include "particle_surface_tracker/stages/surface_triangulation.h"
#include "particle_surface_tracker/stages/topology_matching.h"
#include "support/detailed_body.h"

namespace particle_surface_tracker {

namespace {

std::string mesh_file;

const TriangleMesh& benchmark_mesh() {
  static const TriangleMesh mesh =
      mesh_file.empty() ? test::DetailedBody(0.03).mesh() : read_initial_mesh(mesh_file).mesh;
  return mesh;
}

const FilledBody& body_of(std::int64_t particle_count) {
  static std::map<std::int64_t, FilledBody> bodies;
  const auto found = bodies.find(particle_count);
  if (found != bodies.end()) return found->second;
  const FilledBody body = fill_body(benchmark_mesh(), static_cast<std::size_t>(particle_count));
  return bodies.emplace(particle_count, body).first->second;
}

ImplicitSurface surface_of(const FilledBody& body) {
  const ParticleGrid grid(body.particles.positions, implicit_function_cell_size(body.parameters));
  ImplicitSurface surface = evaluate_implicit_function(grid, body.parameters);
  surface.triangulation = triangulate_zero_level(*surface.field, surface.dx);
  return surface;
}

/// As far as the tracker looks by default: τ and room for the cubic stencil, or 1.25 times the largest δ.
double reach_of(const FilledBody& body) {
  return 2.0 * body.parameters.particle_spacing;
}

void advection(benchmark::State& state) {
  const FilledBody& body = body_of(state.range(0));
  const ParticleFrame later = next_frame(body.particles);
  while (state.KeepRunning()) {
    const ParticleMotion motion = match_particles(body.particles, later, body.parameters);
    const ParticleGrid grid(motion.positions, body.parameters.particle_spacing);
    benchmark::DoNotOptimize(advect(body.mesh.positions(), motion, grid, body.parameters));
  }
}

void implicit_function(benchmark::State& state) {
  const FilledBody& body = body_of(state.range(0));
  while (state.KeepRunning()) {
    const ParticleGrid grid(body.particles.positions, implicit_function_cell_size(body.parameters));
    benchmark::DoNotOptimize(evaluate_implicit_function(grid, body.parameters));
  }
  state.counters["particles"] = static_cast<double>(body.particles.size());
}

void triangulation(benchmark::State& state) {
  const FilledBody& body = body_of(state.range(0));
  const ImplicitSurface surface = surface_of(body);
  while (state.KeepRunning()) benchmark::DoNotOptimize(triangulate_zero_level(*surface.field, surface.dx));
  state.counters["triangles"] = static_cast<double>(surface.triangulation.triangles.size());
}

void distance_field(benchmark::State& state) {
  const FilledBody& body = body_of(state.range(0));
  const ImplicitSurface surface = surface_of(body);
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(DistanceFields(surface).at_stencils(body.mesh.positions(), reach_of(body)));
  }
}

void projection(benchmark::State& state) {
  const FilledBody& body = body_of(state.range(0));
  const SignedDistanceField field = DistanceFields(surface_of(body)).at_stencils(body.mesh.positions(), reach_of(body));
  std::vector<ProjectionStatus> status;
  const std::vector<float> delta = measure_delta(body.mesh.positions(), field, body.parameters, status);
  while (state.KeepRunning()) benchmark::DoNotOptimize(project(body.mesh.positions(), delta, field, body.parameters));
  state.counters["vertices"] = static_cast<double>(body.mesh.vertex_count());
}

/// The mesh of a body where it was put into the lattice of Γ, its δ, and flags within 3 r of one vertex.
struct MatchingInput {
  ImplicitSurface surface;
  MeshLattice lattice;
  std::vector<float> delta;
  std::vector<openvdb::Coord> flagged;

  explicit MatchingInput(const FilledBody& body)
      : surface(surface_of(body)), lattice(body.mesh.positions(), body.mesh.triangles(), cell_size(body)) {
    std::vector<ProjectionStatus> status;
    delta =
        measure_delta(body.mesh.positions(), DistanceFields(surface).at_stencils(body.mesh.positions(), reach_of(body)),
                      body.parameters, status);
    const int width = static_cast<int>(3.0 / body.parameters.dx_gamma);
    const openvdb::Coord center = lattice.cell_of_vertex(0);
    const openvdb::CoordBBox box(center.offsetBy(-width), center.offsetBy(width));
    for (auto cell = box.begin(); cell; ++cell) flagged.push_back(*cell);
  }

  static double cell_size(const FilledBody& body) {
    return body.parameters.dx_gamma * body.parameters.particle_spacing;
  }
};

void mesh_lattice(benchmark::State& state) {
  const FilledBody& body = body_of(state.range(0));
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(MeshLattice(body.mesh.positions(), body.mesh.triangles(), MatchingInput::cell_size(body)));
  }
}

void disagreement(benchmark::State& state) {
  const FilledBody& body = body_of(state.range(0));
  const MatchingInput input(body);
  while (state.KeepRunning()) {
    benchmark::DoNotOptimize(find_disagreement(MeshQuery(input.lattice), input.delta,
                                               IsosurfaceQuery(input.surface, input.lattice.h()), body.parameters));
  }
}

void match(benchmark::State& state, MatchingSolver solver, double reach) {
  const FilledBody& body = body_of(state.range(0));
  const MatchingInput input(body);
  Parameters parameters = body.parameters;
  parameters.matching_solver = solver;
  parameters.matching_reach = reach;
  MatchedVoxelization matched;
  while (state.KeepRunning())
    matched = match_topology(MeshQuery(input.lattice), IsosurfaceQuery(input.surface, input.lattice.h()), input.flagged,
                             parameters);
  state.counters["unknowns"] = static_cast<double>(matched.statistics.unknowns);
  state.counters["iterations"] = matched.statistics.iterations;
}

void matching_sor(benchmark::State& state) {
  match(state, MatchingSolver::kSor, Parameters().matching_reach);
}

void matching_pcg(benchmark::State& state) {
  match(state, MatchingSolver::kPcg, Parameters().matching_reach);
}

void matching_whole_sor(benchmark::State& state) {
  match(state, MatchingSolver::kSor, 0.0);
}

void matching_whole_pcg(benchmark::State& state) {
  match(state, MatchingSolver::kPcg, 0.0);
}

void few(benchmark::internal::Benchmark* benchmark) {
  benchmark->Arg(28000)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
}

void few_and_many(benchmark::internal::Benchmark* benchmark) {
  few(benchmark);
  benchmark->Arg(260000);
}

BENCHMARK(advection)->Apply(few);
BENCHMARK(implicit_function)->Apply(few_and_many);
BENCHMARK(triangulation)->Apply(few_and_many);
BENCHMARK(distance_field)->Apply(few);
BENCHMARK(projection)->Apply(few);
BENCHMARK(mesh_lattice)->Apply(few);
BENCHMARK(disagreement)->Apply(few);
BENCHMARK(matching_sor)->Apply(few);
BENCHMARK(matching_pcg)->Apply(few);
BENCHMARK(matching_whole_sor)->Apply(few);
BENCHMARK(matching_whole_pcg)->Apply(few);

}  // namespace

/// Takes `--mesh=FILE` out of the arguments.
void take_mesh_option(int& argc, char** argv) {
  const std::string option = "--mesh=";
  const auto rest = std::remove_if(argv + 1, argv + argc, [&](const char* argument) {
    const std::string text = argument;
    if (text.rfind(option, 0) != 0) return false;
    mesh_file = text.substr(option.size());
    return true;
  });
  argc = static_cast<int>(rest - argv);
}

}  // namespace particle_surface_tracker

int main(int argc, char** argv) {
  particle_surface_tracker::take_mesh_option(argc, argv);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  try {
    benchmark::RunSpecifiedBenchmarks();
  } catch (const particle_surface_tracker::Error& error) {
    std::cerr << "stage_benchmarks: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
