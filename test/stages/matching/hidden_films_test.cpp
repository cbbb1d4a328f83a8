// A film of air thinner than a cell between a body and a piece of mesh that belongs to it.

#include <algorithm>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/core/mesh_validation.h"
#include "particle_surface_tracker/stages/detail_conflict.h"
#include "particle_surface_tracker/stages/remeshing.h"
#include "stages/matching/matching_cases.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test::matching {
namespace {

// The film is between x = 0.015 and 0.035, nodes are at 0 and 0.05: both are inside.
const Body kBody = ball({-0.5, 0.01, 0.02}, 0.515);
const Body kDrop = ball({0.275, 0.01, 0.02}, 0.24);
const Body kNeck = capsule({-0.2, 0.01, 0.02}, {0.2, 0.01, 0.02}, 0.1);

struct Film {
  TriangleMesh mesh = joined({make_mesh(kBody), make_mesh(kDrop)});
  MeshLattice lattice{mesh.positions(), mesh.triangles(), kH};
  ImplicitSurface surface = make_surface(either(either(kBody, kDrop), kNeck));
  IsosurfaceQuery isosurface{surface, kH};
  MeshQuery query{lattice};
  ComponentDisagreement pieces;
  std::vector<openvdb::Coord> at_conflicts;
  MatchedVoxelization matched;

  Film() {
    pieces.stray_cells = cells_where(mesh, [](const Vec3d& x) { return x.x() > 0.1; });
    const std::vector<openvdb::Coord> at_film = cells_where(make_mesh(kDrop), [](const Vec3d&) { return true; });
    pieces.stray_cells.insert(pieces.stray_cells.end(), at_film.begin(), at_film.end());
    std::sort(pieces.stray_cells.begin(), pieces.stray_cells.end());
    pieces.stray_cells.erase(std::unique(pieces.stray_cells.begin(), pieces.stray_cells.end()),
                             pieces.stray_cells.end());
    at_conflicts = find_conflicting_nodes(query, pieces, {}, isosurface, make_parameters());
    matched = match_topology(query, isosurface, {}, make_parameters(), at_conflicts);
  }

  std::size_t components_with(const std::vector<openvdb::Coord>& flagged) const {
    RemeshingRequest request;
    request.flagged_cells = flagged;
    request.nodes = matched.nodes;
    request.gamma = matched.gamma;
    TriangleMesh result = mesh;
    remesh(result, lattice, request);
    EXPECT_EQ(describe_mesh_defects(result.positions(), result.triangles()), "");
    return measure_mesh(result.positions(), result.triangles()).components;
  }
};

TEST(HiddenFilms, TheWayLeadsThroughThem) {
  const Film film;
  EXPECT_TRUE(std::binary_search(film.at_conflicts.begin(), film.at_conflicts.end(), openvdb::Coord(0, 0, 0)));
  EXPECT_TRUE(std::binary_search(film.at_conflicts.begin(), film.at_conflicts.end(), openvdb::Coord(1, 0, 0)));
}

TEST(HiddenFilms, AreWhereThePieceIsJoined) {
  Film film;
  const std::vector<openvdb::Coord> cells = find_hidden_films(film.lattice, film.at_conflicts, film.matched);
  EXPECT_TRUE(std::binary_search(cells.begin(), cells.end(), openvdb::Coord(0, 0, 0)));
  for (const openvdb::Coord& cell : cells) EXPECT_LE(std::abs(cell.x()), 4) << cell;
  EXPECT_EQ(film.components_with(cells), 1U);
}

TEST(HiddenFilms, NoneWithoutConflicts) {
  const Film film;
  EXPECT_TRUE(find_hidden_films(film.lattice, {}, {}).empty());
}

}  // namespace
}  // namespace particle_surface_tracker::test::matching
