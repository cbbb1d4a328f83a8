#include <fmt/format.h>

#include "particle_surface_tracker/core/mesh_check.h"

namespace particle_surface_tracker {
namespace {

std::string describe_vertex(const char* name, std::uint32_t index, const Vec3f& position) {
  return fmt::format("{} {} at ({:g}, {:g}, {:g})", name, index, position.x(), position.y(), position.z());
}

}  // namespace

std::vector<NamedMeshDefect> list_defects(const MeshDefects& defects) {
  return {
      {"dangling_triangles", "triangles name a vertex that is not there", "triangle", &defects.dangling_triangles},
      {"not_finite_vertices", "vertices are not finite", "vertex", &defects.not_finite_vertices},
      {"degenerate_triangles", "triangles are degenerate (a vertex occurs twice)", "triangle",
       &defects.degenerate_triangles},
      {"unused_vertices", "vertices belong to no triangle", "vertex", &defects.unused_vertices},
      {"open_edges", "edges are open (only one triangle; fill the holes)", "edge", &defects.open_edges},
      {"non_manifold_edges", "edges are non-manifold (more than two triangles; separate the sheets)", "edge",
       &defects.non_manifold_edges},
      {"flipped_edges",
       "edges lie between triangles of opposite orientation (the mesh is partly flipped; orient it consistently)",
       "edge", &defects.flipped_edges},
      {"non_manifold_vertices", "vertices are non-manifold (several umbrellas meet in a point; double the vertex)",
       "vertex", &defects.non_manifold_vertices},
      {"duplicate_triangles", "triangles are there twice (remove the duplicates)", "triangle",
       &defects.duplicate_triangles},
  };
}

std::vector<NamedMeshDefect> list_defects(const MeshCheck& check) {
  std::vector<NamedMeshDefect> kinds = list_defects(check.defects);
  kinds.push_back(
      {"flat_triangles", "triangles are flat (their corners lie on a line)", "triangle", &check.flat_triangles});
  kinds.push_back(
      {"self_intersecting_triangles", "triangles intersect others", "triangle", &check.self_intersecting_triangles});
  const std::vector<NamedMeshDefect> nesting = list_nesting_defects(check);
  kinds.insert(kinds.end(), nesting.begin(), nesting.end());
  return kinds;
}

std::vector<NamedMeshDefect> list_nesting_defects(const MeshCheck& check) {
  return {{"inside_out_components", "components are inside out (negative volume, in no solid)", "component",
           &check.inside_out_components},
          {"solids_in_solids", "components are solids inside a solid", "component", &check.solids_in_solids},
          {"cavities_in_overlaps", "components are cavities inside more than one solid", "component",
           &check.cavities_in_overlaps},
          {"components_without_volume", "components have no volume", "component", &check.components_without_volume}};
}

std::string describe(const std::vector<NamedMeshDefect>& kinds) {
  std::string text;
  for (const NamedMeshDefect& kind : kinds) {
    if (kind.defect->count == 0) continue;
    text += fmt::format("{}{} {}, first {}", text.empty() ? "" : "; ", kind.defect->count, kind.text,
                        describe_place(kind.element, kind.defect->places.front()));
  }
  return text;
}

std::string describe_place(const char* element, const MeshPlace& place) {
  const bool is_edge = std::string(element) == "edge";
  std::string first = describe_vertex(is_edge ? "vertex" : element, place.index, place.position);
  if (place.other == place.index) return first;
  const std::string other = describe_vertex(is_edge ? "vertex" : element, place.other, place.other_position);
  return is_edge ? fmt::format("between {} and {}", first, other) : fmt::format("{}, with {}", first, other);
}

}  // namespace particle_surface_tracker
