#include "particle_surface_tracker/tracker/make_implicit_surface.h"

#include "implicit_surface_stages.h"
#include "particle_surface_tracker/core/particle_grid.h"
#include "particle_surface_tracker/stages/implicit_function.h"
#include "particle_surface_tracker/stages/surface_triangulation.h"

namespace particle_surface_tracker {

std::shared_ptr<const ImplicitSurface> make_implicit_surface(const ParticleFrame& frame, const Parameters& parameters,
                                                             StageTimer& timer) {
  timer.begin("implicit_function");
  const ParticleGrid grid(frame.positions, implicit_function_cell_size(parameters));
  auto surface = std::make_shared<ImplicitSurface>(evaluate_implicit_function(grid, parameters));
  timer.begin("triangulation");
  surface->triangulation = triangulate_zero_level(*surface->field, surface->dx);
  return surface;
}

std::shared_ptr<const ImplicitSurface> make_implicit_surface(const ParticleFrame& frame, const Parameters& parameters,
                                                             FrameReport* report) {
  FrameReport unread;
  StageTimer timer(report != nullptr ? *report : unread);
  auto surface = make_implicit_surface(frame, parameters, timer);
  timer.finish();
  return surface;
}

}  // namespace particle_surface_tracker
