#include "particle_surface_tracker/tracker/tracker.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "band.h"
#include "frame_description.h"
#include "implicit_surface_stages.h"
#include "long_step.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_validation.h"
#include "particle_surface_tracker/stages/advection.h"
#include "particle_surface_tracker/stages/component_disagreement.h"
#include "particle_surface_tracker/stages/stretched_detail.h"
#include "stage_timer.h"
#include "topology_update.h"
#include "vertex_ids.h"

namespace particle_surface_tracker {

namespace {

/// Farthest that the isosurface is searched for when δ is measured: details of a first mesh may hold no particle [r].
constexpr double kInitialReach = 64.0;

/// The last frame; replaced as a whole once nothing can fail any more.
struct Tracked : TrackedFrame {
  std::shared_ptr<const ImplicitSurface> surface;
  std::shared_ptr<TopologyCells> cells;
};

/// Largest |δ| and |φ(x)| over the vertices that were found and not flagged [m].
double largest_distance(const TriangleMesh& mesh, const Projection& projection, const Detection& detection) {
  double largest = 0.0;
  auto flagged = detection.flagged_vertices.begin();
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (flagged != detection.flagged_vertices.end() && *flagged == v) {
      ++flagged;
      continue;
    }
    largest = std::max({largest, std::abs(static_cast<double>(mesh.delta()[v])),
                        std::abs(static_cast<double>(projection.distances[v]))});
  }
  return largest;
}

void require_particles(const ParticleFrame& frame) {
  if (frame.empty()) {
    throw ParticleError("the first frame holds no particles; begin with a frame that does");
  }
}

}  // namespace

struct Tracker::State {
  Parameters parameters;
  std::unique_ptr<Tracked> tracked;
  UpkeepMemory upkeep_memory;
  bool records_cells = false;

  double r() const { return parameters.particle_spacing; }
  double smallest_reach() const { return parameters.tau * r(); }

  void require_same_cells(const ImplicitSurface& surface) const {
    const double dx = parameters.dx_phi * r();
    if (surface.dx == dx) return;
    throw TrackingError(
        fmt::format("the implicit surface has cells of {:.9g} m and this tracker wants {:.9g} m; make it with "
                    "the parameters of the tracker",
                    surface.dx, dx));
  }

  /// Where to record the cells of a frame; null: nowhere.
  std::shared_ptr<TopologyCells> new_cells() const {
    if (!records_cells) return nullptr;
    auto cells = std::make_shared<TopologyCells>();
    cells->cell_size = parameters.dx_gamma * r();
    return cells;
  }

  /// Measures δ of a new mesh and takes it over.
  void begin(TriangleMesh mesh, const ParticleFrame& frame, std::shared_ptr<const ImplicitSurface> surface,
             FrameReport& report, StageTimer& timer) {
    auto next = std::make_unique<Tracked>();
    next->mesh = std::move(mesh);
    next->particles = frame;
    next->particles_frame = report.frame;
    next->surface = std::move(surface);
    next->cells = new_cells();
    next->original_vertices = next->mesh.next_id();
    std::fill(next->mesh.delta().begin(), next->mesh.delta().end(), 0.0f);
    const Projection measured = NarrowBand(*next->surface, parameters, timer)
                                    .project(next->mesh.positions(), next->mesh.delta(), 4.0 * smallest_reach(),
                                             std::max(kInitialReach * r(), 4.0 * smallest_reach()));
    next->mesh.delta() = measured.distances;
    const auto lost = std::count_if(measured.status.begin(), measured.status.end(),
                                    [](ProjectionStatus status) { return status != ProjectionStatus::kFound; });
    if (lost > 0) {
      report.warnings.push_back(
          fmt::format("{} vertices of the first mesh have no implicit surface near them; their δ is "
                      "taken as 0",
                      lost));
    }
    note_birth(next->mesh);
    note_bridges(next->mesh, IsosurfaceQuery(*next->surface, parameters.dx_gamma * r()));
    next->band = largest_distance(next->mesh, measured, next->detection);
    timer.begin("measures");
    describe_frame(report, *next, next->surface.get(), frame);
    timer.finish();
    tracked = std::move(next);
  }

  /// Carries the vertices along with the particles of two frames.
  void advect_vertices(Tracked& next, const ParticleFrame& frame, FrameReport& report, StageTimer& timer) const {
    timer.begin("advection");
    Parameters over_gap = parameters;
    const std::uint64_t elapsed = report.frame > next.particles_frame ? report.frame - next.particles_frame : 1;
    over_gap.max_displacement *= static_cast<double>(elapsed);
    const ParticleMotion motion = match_particles(next.particles, frame, over_gap);
    report.particles_born = motion.born;
    report.particles_gone = motion.gone;
    if (motion.positions.empty()) {
      report.warnings.push_back("no particle of this frame was in the one before; the mesh is not advected");
      return;
    }
    warn_of_untrue_ids(report, frame.size());
    const int steps = steps_for(motion, elapsed, parameters);
    next.mesh.positions() = advect_in_steps(next.mesh.positions(), motion, steps, parameters);
  }

  /// Projects the advected vertices and flags those that jump.
  void project_vertices(Tracked& next, NarrowBand& band, FrameReport& report) const {
    const double reach = std::max(parameters.band_factor * next.band, smallest_reach());
    const double max_reach = std::max(parameters.max_reach * r(), reach);
    const Projection projection = band.project(next.mesh.positions(), next.mesh.delta(), reach, max_reach);
    next.detection = apply_projection(next.mesh, projection, parameters);
    report.flagged_vertices = next.detection.flagged_vertices.size();
    report.unreached_vertices = next.detection.unreached_vertices;
    if (parameters.topology == TopologyMode::kKeep) report.flagged_cells = next.detection.flagged_cells.size();
    next.band = largest_distance(next.mesh, projection, next.detection);
  }

  /// Splits and merges the mesh, and keeps its triangles in shape. What was flagged and is still there stays flagged.
  void match_topology(Tracked& next, const ParticleFrame& frame, NarrowBand& band, FrameReport& report,
                      StageTimer& timer) {
    const std::vector<std::uint32_t> flagged_ids = ids_of(next.mesh, next.detection.flagged_vertices);
    const double new_delta = update_topology(next.mesh, frame.positions, *next.surface, next.detection,
                                             static_cast<std::uint32_t>(next.original_vertices), parameters, band,
                                             upkeep_memory, report, timer, next.cells.get());
    next.band = std::max(next.band, new_delta);
    next.detection.flagged_vertices = vertices_of(next.mesh, flagged_ids);
  }
};

Tracker::Tracker(const Parameters& parameters) : state_(std::make_unique<State>()) {
  check_parameters(parameters);
  state_->parameters = parameters;
}

Tracker::Tracker(const TrackerState& state) : Tracker(state.parameters) {
  check_tracker_state(state);
  auto tracked = std::make_unique<Tracked>(Tracked{state.frame, nullptr, nullptr});
  tracked->surface = make_implicit_surface(tracked->particles, state.parameters);
  state_->tracked = std::move(tracked);
}

Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

FrameReport Tracker::start(const TriangleMesh& mesh, const ParticleFrame& frame, std::uint64_t frame_index) {
  require_particles(frame);
  FrameReport report;
  report.frame = frame_index;
  StageTimer timer(report);
  timer.begin("checks");
  check_closed_manifold(mesh);
  check_mesh_fits_particles(mesh, frame, state_->r());
  auto surface = make_implicit_surface(frame, state_->parameters, timer);
  state_->begin(mesh, frame, std::move(surface), report, timer);
  return report;
}

FrameReport Tracker::start_from_particles(const ParticleFrame& frame, std::uint64_t frame_index) {
  require_particles(frame);
  FrameReport report;
  report.frame = frame_index;
  StageTimer timer(report);
  timer.begin("checks");
  // Before the surface: with a spacing that is far off it takes all time and memory there is, or is one great drop.
  check_spacing_fits_particles(frame, state_->r());
  auto surface = make_implicit_surface(frame, state_->parameters, timer);
  if (surface->triangulation.triangles.empty()) {
    throw TrackingError(
        fmt::format("{} particles have no implicit surface at the spacing r = {:.6g} m", frame.size(), state_->r()));
  }
  TriangleMesh mesh(surface->triangulation.vertices, surface->triangulation.triangles);
  state_->begin(std::move(mesh), frame, std::move(surface), report, timer);
  return report;
}

bool Tracker::started() const {
  return state_->tracked != nullptr;
}

TrackerState Tracker::state() const {
  require_started();
  return {state_->parameters, static_cast<const TrackedFrame&>(*state_->tracked)};
}

void Tracker::require_started() const {
  if (!started()) throw TrackingError("there is no mesh yet: start with the first frame and its mesh");
}

FrameReport Tracker::advance(const ParticleFrame& frame, std::uint64_t frame_index) {
  return advance(frame, frame_index, nullptr);
}

FrameReport Tracker::advance(const ParticleFrame& frame, std::uint64_t frame_index,
                             std::shared_ptr<const ImplicitSurface> surface) {
  require_started();
  if (surface != nullptr) state_->require_same_cells(*surface);
  FrameReport report;
  report.frame = frame_index;
  StageTimer timer(report);
  auto next = std::make_unique<Tracked>(*state_->tracked);
  next->cells = state_->new_cells();
  if (frame.empty()) {
    report.particles_gone = next->particles.size();
    report.warnings.push_back("the frame holds no particles; the mesh waits for them to return");
    next->detection = {};
  } else {
    state_->advect_vertices(*next, frame, report, timer);
    // By what the liquid does, not by what the projection does: at details as thin as r the latter is not rigid.
    if (state_->parameters.stretched_detail == StretchedDetail::kThin) {
      timer.begin("stretched_detail");
      thin_stretched_detail(next->mesh, state_->tracked->mesh.positions());
    }
    next->surface = surface != nullptr ? std::move(surface) : make_implicit_surface(frame, state_->parameters, timer);
    NarrowBand band(*next->surface, state_->parameters, timer);
    state_->project_vertices(*next, band, report);
    if (state_->parameters.topology == TopologyMode::kMatch) {
      state_->match_topology(*next, frame, band, report, timer);
    }
    decay_delta(next->mesh, 1e-9 * static_cast<double>(frame.stamp_ns - next->particles.stamp_ns), state_->parameters);
    next->particles = frame;
    next->particles_frame = frame_index;
  }
  timer.begin("measures");
  describe_frame(report, *next, next->surface.get(), frame);
  timer.finish();
  state_->tracked = std::move(next);
  return report;
}

const Parameters& Tracker::parameters() const {
  return state_->parameters;
}

void Tracker::set_parameters(const Parameters& parameters) {
  check_parameters(parameters);
  if (started()) {
    for (const ParameterInfo& info : parameter_table()) {
      const std::string before = get_parameter(state_->parameters, info.name);
      const std::string after = get_parameter(parameters, info.name);
      if (info.needs_reset && before != after) {
        throw ParameterError(
            fmt::format("{} cannot change from {} to {} while a mesh is being tracked; start again with the "
                        "new value",
                        info.name, before, after));
      }
    }
  }
  state_->parameters = parameters;
}

const TriangleMesh& Tracker::mesh() const {
  static const TriangleMesh none;
  return started() ? state_->tracked->mesh : none;
}

std::shared_ptr<const ImplicitSurface> Tracker::implicit_surface() const {
  return started() ? state_->tracked->surface : nullptr;
}

void Tracker::record_topology_cells(bool on) {
  state_->records_cells = on;
}

std::shared_ptr<const TopologyCells> Tracker::topology_cells() const {
  return started() ? state_->tracked->cells : nullptr;
}

const Detection& Tracker::detection() const {
  static const Detection none;
  return started() ? state_->tracked->detection : none;
}

}  // namespace particle_surface_tracker
