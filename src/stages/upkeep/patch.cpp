#include "patch.h"

namespace particle_surface_tracker {

namespace {

Vec3d normal_of(const EditableSurface& surface, std::uint32_t triangle) {
  return area_normal(surface.corners(triangle));
}

/// The triangles around the start of `half_edge`, from the one after its own to the one before its twin's, with the
/// centre replaced. `is_first` and `is_last` tell the ends of the open fan, which close onto other triangles of the
/// patch.
void append_fan(const EditableSurface& surface, std::uint32_t half_edge, std::uint32_t center, const Vec3d& position,
                PlannedPatch& patch) {
  for (std::uint32_t h = surface.turn(half_edge); surface.turn(h) != half_edge; h = surface.turn(h)) {
    const std::uint32_t outer = next_half_edge(h);
    const std::uint32_t a = surface.start(outer), b = surface.end(outer);
    patch.triangles.push_back({{center, a, b},
                               {position, surface.position(a), surface.position(b)},
                               normal_of(surface, h / 3),
                               {kNoHalfEdge, surface.twin(outer), kNoHalfEdge}});
    patch.replaced.push_back(h / 3);
  }
}

/// The two halves of the triangle (a, b, c) of a half-edge that is split.
void append_halves(const EditableSurface& surface, std::uint32_t half_edge, const Vec3d& middle, PlannedPatch& patch) {
  const std::uint32_t a = surface.start(half_edge), b = surface.end(half_edge), c = surface.apex(half_edge);
  const Vec3d at_a = surface.position(a), at_b = surface.position(b), at_c = surface.position(c);
  const Vec3d normal = normal_of(surface, half_edge / 3);
  patch.triangles.push_back({{kNewVertex, b, c},
                             {middle, at_b, at_c},
                             normal,
                             {kNoHalfEdge, surface.twin(next_half_edge(half_edge)), kNoHalfEdge}});
  patch.triangles.push_back({{kNewVertex, c, a},
                             {middle, at_c, at_a},
                             normal,
                             {kNoHalfEdge, surface.twin(previous_half_edge(half_edge)), kNoHalfEdge}});
  patch.replaced.push_back(half_edge / 3);
}

}  // namespace

void plan_collapse(const EditableSurface& surface, std::uint32_t half_edge, const Vec3f& position,
                   PlannedPatch& patch) {
  const std::uint32_t twin = surface.twin(half_edge);
  const std::uint32_t kept = surface.end(half_edge);
  patch.triangles.clear();
  patch.replaced = {half_edge / 3, twin / 3};
  append_fan(surface, half_edge, kept, position.cast<double>(), patch);
  append_fan(surface, twin, kept, position.cast<double>(), patch);
}

void plan_split(const EditableSurface& surface, std::uint32_t half_edge, const Vec3f& position, PlannedPatch& patch) {
  patch.triangles.clear();
  patch.replaced.clear();
  append_halves(surface, half_edge, position.cast<double>(), patch);
  append_halves(surface, surface.twin(half_edge), position.cast<double>(), patch);
}

void plan_flip(const EditableSurface& surface, std::uint32_t half_edge, PlannedPatch& patch) {
  const std::uint32_t twin = surface.twin(half_edge);
  const std::uint32_t a = surface.start(half_edge), b = surface.end(half_edge);
  const std::uint32_t c = surface.apex(half_edge), d = surface.apex(twin);
  const Vec3d at_a = surface.position(a), at_b = surface.position(b);
  const Vec3d at_c = surface.position(c), at_d = surface.position(d);
  const Vec3d normal = normal_of(surface, half_edge / 3) + normal_of(surface, twin / 3);
  patch.triangles.clear();
  patch.triangles.push_back(
      {{d, b, c},
       {at_d, at_b, at_c},
       normal,
       {surface.twin(previous_half_edge(twin)), surface.twin(next_half_edge(half_edge)), kNoHalfEdge}});
  patch.triangles.push_back(
      {{c, a, d},
       {at_c, at_a, at_d},
       normal,
       {surface.twin(previous_half_edge(half_edge)), surface.twin(next_half_edge(twin)), kNoHalfEdge}});
  patch.replaced = {half_edge / 3, twin / 3};
}

}  // namespace particle_surface_tracker
