#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// Where a defect is: a vertex, an edge (two vertices), a triangle, two triangles, or a component.
struct MeshPlace {
  std::uint32_t index = 0;        ///< Of the vertex, triangle or component; of an edge its lower vertex.
  std::uint32_t other = 0;        ///< The edge's other vertex, or the other triangle; `index` where there is none.
  Vec3f position{0, 0, 0};        ///< Of the vertex, or of the first vertex of triangle or component [m].
  Vec3f other_position{0, 0, 0};  ///< The same of `other` [m].
};

/// How often a kind of defect occurs, and its first places, in an order that depends on nothing but the mesh.
struct MeshDefect {
  static constexpr std::size_t max_places = 5;

  std::size_t count = 0;
  std::vector<MeshPlace> places;  ///< At most max_places.

  void add(const MeshPlace& place);
  /// Adds defects that come behind these.
  void append(const MeshDefect& other);
};

/// What keeps triangles from being a closed, consistently oriented 2-manifold of finite positions.
struct MeshDefects {
  MeshDefect dangling_triangles;     ///< That name a vertex that is not there.
  MeshDefect degenerate_triangles;   ///< In which a vertex occurs twice.
  MeshDefect not_finite_vertices;    ///< With a coordinate that is infinite or not a number.
  MeshDefect unused_vertices;        ///< Of no triangle.
  MeshDefect duplicate_triangles;    ///< Of the same three vertices as another one, in whatever order.
  MeshDefect open_edges;             ///< With one triangle.
  MeshDefect non_manifold_edges;     ///< With more than two triangles.
  MeshDefect flipped_edges;          ///< With two triangles that run along it in the same direction.
  MeshDefect non_manifold_vertices;  ///< With more than one umbrella of triangles.

  /// Whether nothing was found.
  bool none() const;
};

/// Finds the defects of a mesh. Edges and vertices are looked at without dangling and degenerate triangles; a vertex is
/// non-manifold only if all its edges are in order.
MeshDefects find_mesh_defects(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

/// A part of a mesh that is connected by shared vertices.
struct MeshComponent {
  std::uint32_t first_vertex = 0;  ///< Its lowest one.
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  bool is_closed = false;    ///< All its edges have two triangles of opposite directions.
  bool is_manifold = false;  ///< Closed, and all its vertices have one umbrella.
  std::int64_t genus = 0;    ///< Of a manifold component; else 0.
  double volume = 0.0;       ///< Signed, of a closed component [m³]; else 0.
  double area = 0.0;         ///< [m²].

  /// How often the other closed components wind around it: the median over nine of its vertices (all of them, if they
  /// are fewer), so that it is exact where no other component crosses it. 0 if it is not closed.
  int winding_around = 0;
};

/// What check_mesh() looks at.
struct MeshCheckOptions {
  bool unused_vertices = true;  ///< Whether vertices of no triangle count as defects.
  bool self_intersections = true;
  bool nesting = true;
};

/// Everything that can be wrong with a mesh, and its parts. Triangles that are dangling, degenerate, or have a vertex
/// that is not finite are left out of components, flat triangles and self-intersections.
struct MeshCheck {
  std::size_t vertices = 0;
  std::size_t triangles = 0;
  MeshDefects defects;
  MeshDefect flat_triangles;  ///< Their three corners lie on a line; exact.

  /// Triangles that meet another one, of any component, in more than the vertices and edges they share by index, be it
  /// in a point only; exact. Flat triangles are left out: what they cover is covered by the edges of their neighbours.
  MeshDefect self_intersecting_triangles;

  std::vector<MeshComponent> components;  ///< In the order of their lowest vertices.
  MeshDefect inside_out_components;       ///< Of negative volume, in no solid.
  MeshDefect solids_in_solids;            ///< Of positive volume where the others wind around it already.
  MeshDefect cavities_in_overlaps;        ///< Of negative volume, in more than one solid.
  MeshDefect components_without_volume;   ///< Closed, of volume 0.

  /// [m³], [m²]; sums over the components.
  double volume() const;
  double area() const;
  /// Sum over the components.
  std::int64_t genus() const;
  /// Of all triangles, in [0, 1].
  double self_intersecting_share() const;
  /// Whether nothing is wrong but up to a share of self-intersecting triangles.
  bool is_sound(double max_self_intersecting_share = 0.0) const;
};

/// Checks a mesh, whatever its state: closed, manifold, oriented; self-intersections and flat triangles by exact
/// predicates; nesting of its components by exact winding numbers. Time grows with the number of triangles and of
/// overlaps of their boxes. The result does not depend on the number of threads.
MeshCheck check_mesh(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles,
                     const MeshCheckOptions& options = {});

/// A kind of defect for people and machines.
struct NamedMeshDefect {
  const char* name;     ///< As the member of MeshCheck or MeshDefects.
  const char* text;     ///< Follows the count: "edges are open (…)".
  const char* element;  ///< What MeshPlace::index counts: "vertex", "edge", "triangle", "component".
  const MeshDefect* defect;
};

/// All kinds of defects in a fixed order, also those that do not occur.
std::vector<NamedMeshDefect> list_defects(const MeshDefects& defects);
std::vector<NamedMeshDefect> list_defects(const MeshCheck& check);
/// Those of the nesting of components.
std::vector<NamedMeshDefect> list_nesting_defects(const MeshCheck& check);

/// "3 edges are open (…), first between …; 1 vertices …": the kinds that occur, each with its first place.
std::string describe(const std::vector<NamedMeshDefect>& kinds);

/// "vertex 3 at (0, 1, 2)", "between vertex 3 at … and vertex 4 at …", "triangle 7 at …, with triangle 9 at …".
std::string describe_place(const char* element, const MeshPlace& place);

/// Triangles as they are after vertices of the same position (−0 is 0) have been joined into the first of them, as many
/// readers of mesh files do. Vertices keep their numbers; those joined to another are of no triangle any more.
struct WeldedTriangles {
  std::vector<Triangle> triangles;  ///< As many as before, in their order; some may be degenerate now.
  std::size_t merged_vertices = 0;
};

WeldedTriangles weld_by_position(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles);

}  // namespace particle_surface_tracker
