#include "particle_surface_tracker/stages/mesh_lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/triangle_mesh.h"

#include "stages/nodes/node_masks.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;
using Kind = LatticePoint::Kind;

MeshLattice lattice_of(const TriangleMesh& mesh, double h) {
  return MeshLattice(mesh.positions(), mesh.triangles(), h);
}

/// Nodes with a winding number other than 0, as text "(x, y, z): w …".
std::string windings_near(const MeshLattice& lattice, int from, int to) {
  std::string text;
  for (int i = from; i <= to; ++i) {
    for (int j = from; j <= to; ++j) {
      for (int k = from; k <= to; ++k) {
        const int w = lattice.winding_number(Coord(i, j, k));
        if (w == 0) continue;
        text += std::to_string(i) + std::to_string(j) + std::to_string(k) + ":" + std::to_string(w) + " ";
      }
    }
  }
  return text;
}

TEST(MeshLattice, BoxAroundOneNodeCrossesItsSixEdges) {
  const TriangleMesh box = test::make_box({0.5, 0.75, 0.5}, {1.5, 1.5, 1.5});
  const MeshLattice lattice = lattice_of(box, 1.0);
  ASSERT_EQ(lattice.crossings().size(), 6u);
  for (const EdgeCrossing& crossing : lattice.crossings()) {
    const int axis = crossing.edge.axis;
    const bool is_below = crossing.edge.node[axis] == 0;
    EXPECT_EQ(crossing.step, is_below ? 1 : -1);
    EXPECT_EQ(crossing.place, is_below && axis == 1 ? 0.75 : 0.5);
    EXPECT_EQ(lattice.crossings_on(crossing.edge).size(), 1u);
  }
  EXPECT_TRUE(lattice.crossings_on({Coord(0, 0, 0), 0}).empty());
  EXPECT_TRUE(lattice.crossings_on({Coord(2, 1, 1), 0}).empty());
  EXPECT_EQ(windings_near(lattice, -1, 3), "111:1 ");
}

TEST(MeshLattice, VerticesOnPlanesAreMovedAboveThem) {
  const TriangleMesh box = test::make_box({1, 1, 1}, {2, 2, 2});
  const MeshLattice lattice = lattice_of(box, 1.0);
  EXPECT_EQ(lattice.cell_of_vertex(0), Coord(1, 1, 1));
  EXPECT_EQ(lattice.cell_of_vertex(7), Coord(2, 2, 2));
  EXPECT_EQ(windings_near(lattice, -1, 4), "222:1 ");
  EXPECT_EQ(windings_near(lattice_of(test::turned(box), 1.0), -1, 4), "222:-1 ");
  EXPECT_EQ(windings_near(lattice_of(test::joined({box, box}), 1.0), -1, 4), "222:2 ");
  EXPECT_EQ(windings_near(lattice_of(test::joined({box, test::turned(box)}), 1.0), -1, 4), "");
}

TEST(MeshLattice, VerticesBelowTheOriginAreInCellsBelowZero) {
  const TriangleMesh box = test::make_box({-1.5, -1, -1e-30}, {-0.5, 0, 0});
  const MeshLattice lattice = lattice_of(box, 1.0);
  EXPECT_EQ(lattice.cell_of_vertex(0), Coord(-2, -1, -1));
  EXPECT_EQ(lattice.cell_of_vertex(7), Coord(-1, 0, 0));
}

TEST(MeshLattice, BodiesThatShareAFaceOverlapThere) {
  const TriangleMesh boxes = test::joined(
      {test::make_box({0.5, 0.5, 0.5}, {2.5, 1.5, 1.5}), test::make_box({2.5, 0.5, 0.5}, {3.5, 1.5, 1.5})});
  const MeshLattice lattice = lattice_of(boxes, 1.0);
  EXPECT_EQ(windings_near(lattice, 0, 4), "111:1 211:1 311:1 ");
  const auto crossings = lattice.crossings_on({Coord(2, 1, 1), 0});
  ASSERT_EQ(crossings.size(), 2u);
  EXPECT_EQ(crossings[0].step, 1);
  EXPECT_EQ(crossings[1].step, -1);
}

TEST(MeshLattice, CrossingsOfOneEdgeAreInTheirOrder) {
  const TriangleMesh boxes = test::joined(
      {test::make_box({1.5, 0.5, 0.5}, {1.75, 1.5, 1.5}), test::make_box({0.5, 0.5, 0.5}, {1.25, 1.5, 1.5})});
  const auto lattice = lattice_of(boxes, 1.0);
  const auto crossings = lattice.crossings_on({Coord(1, 1, 1), 0});
  ASSERT_EQ(crossings.size(), 3u);
  EXPECT_EQ(crossings[0].place, 0.25);
  EXPECT_EQ(crossings[1].place, 0.5);
  EXPECT_EQ(crossings[2].place, 0.75);
  EXPECT_EQ(crossings[0].step, -1);
  EXPECT_EQ(crossings[1].step, 1);
  EXPECT_EQ(crossings[2].step, -1);
}

/// A triangle that faces up, from (0.25, 0.25) along x to 1.75 and along y to 0.75, at z = 0.5.
const std::vector<Vec3f> kCorners = {{0.25f, 0.25f, 0.5f}, {1.75f, 0.25f, 0.5f}, {0.25f, 0.75f, 0.5f}};

TEST(MeshLattice, TriangleAcrossOnePlaneIsCutOnce) {
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const MeshLattice lattice(kCorners, triangles, 1.0);
  const TriangleCut cut = lattice.cut_triangle(0);
  EXPECT_EQ(cut.cells[0], Coord(0, 0, 0));
  EXPECT_EQ(cut.cells[1], Coord(1, 0, 0));
  EXPECT_EQ(cut.cells[2], Coord(0, 0, 0));
  ASSERT_EQ(cut.points.size(), 2u);
  ASSERT_EQ(cut.segments.size(), 1u);
  const TriangleCut::Segment& segment = cut.segments[0];
  EXPECT_EQ(segment.face, (LatticeFace{Coord(1, 0, 0), 0}));
  EXPECT_EQ(segment.face.lower_cell(), Coord(0, 0, 0));
  EXPECT_EQ(segment.face.upper_cell(), Coord(1, 0, 0));
  // Seen from above, the lower cell is in the west: the way leads north.
  const LatticePoint& from = cut.points[segment.from];
  const LatticePoint& to = cut.points[segment.to];
  EXPECT_EQ(from, (LatticePoint{Kind::kOnLatticeFace, 0, 1, Coord(1, 0, 0), 0, 1, 0.5}));
  EXPECT_EQ(to, (LatticePoint{Kind::kOnLatticeFace, 0, -1, Coord(1, 0, 0), 1, 2, 0.5}));
  EXPECT_EQ(from.step, 1);
  EXPECT_EQ(to.step, -1);
  EXPECT_EQ(from.place, 0.5);
  EXPECT_EQ(to.place, 0.5);
}

TEST(MeshLattice, TriangleAcrossALatticeEdgeMeetsItsFourFaces) {
  const std::vector<Vec3f> corners = {{0.25f, 0.25f, 0.5f}, {2.0f, 0.25f, 0.5f}, {0.25f, 2.0f, 0.5f}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const MeshLattice lattice(corners, triangles, 1.0);
  const TriangleCut cut = lattice.cut_triangle(0);
  ASSERT_EQ(lattice.crossings().size(), 1u);
  EXPECT_EQ(lattice.crossings()[0].edge, (LatticeEdge{Coord(1, 1, 0), 2}));
  EXPECT_EQ(lattice.crossings()[0].step, -1);
  int edge_points = 0;
  for (std::uint32_t n = 0; n < cut.points.size(); ++n) {
    if (cut.points[n].kind != Kind::kOnLatticeEdge) continue;
    ++edge_points;
    EXPECT_EQ(cut.points[n].place, lattice.crossings()[0].place);
    int ends = 0;
    for (const TriangleCut::Segment& s : cut.segments) ends += (s.from == n) + (s.to == n);
    EXPECT_EQ(ends, 4);
  }
  EXPECT_EQ(edge_points, 1);
}

TEST(MeshLattice, PointsOfAMeshEdgeAreInTheirOrder) {
  const std::vector<Vec3f> corners = {{0.5f, 0.25f, 0.5f}, {2.5f, 2.25f, 0.5f}, {0.5f, 0.25f, 0.75f}};
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const MeshLattice lattice(corners, triangles, 1.0);
  const auto point = [](int axis, const Coord& node) {
    return LatticePoint{Kind::kOnLatticeFace, static_cast<std::uint8_t>(axis), 1, node, 0, 1, 0.0};
  };
  const std::vector<LatticePoint> ordered = {point(0, Coord(1, 0, 0)), point(1, Coord(1, 1, 0)),
                                             point(0, Coord(2, 1, 0)), point(1, Coord(2, 2, 0))};
  for (std::size_t i = 0; i < ordered.size(); ++i) {
    for (std::size_t j = 0; j < ordered.size(); ++j) {
      EXPECT_EQ(lattice.comes_before(ordered[i], ordered[j]), i < j) << i << ", " << j;
    }
  }
}

TEST(MeshLattice, TrianglesOfACellAreFound) {
  const TriangleMesh sphere = test::make_sphere({0.1, 0.2, 0.3}, 0.7, 1);
  const MeshLattice lattice = lattice_of(sphere, 0.25);
  std::size_t count = 0;
  for (const Coord& cell : lattice.cells()) {
    const auto triangles = lattice.triangles_in_cell(cell);
    EXPECT_TRUE(std::is_sorted(triangles.begin(), triangles.end()));
    EXPECT_EQ(std::adjacent_find(triangles.begin(), triangles.end()), triangles.end());
    count += triangles.size();
  }
  EXPECT_GE(count, sphere.triangle_count());
  EXPECT_TRUE(lattice.triangles_in_cell(Coord(0, 0, 0)).empty());
  EXPECT_TRUE(lattice.triangles_in_cell(Coord(100000, 0, 0)).empty());
}

TEST(MeshLattice, CellsAreThoseWithTriangles) {
  // Small triangles, whose bounding box counts, and large ones, which are cut.
  const TriangleMesh mesh =
      test::joined({test::make_sphere({0.1, 0.2, 0.3}, 0.7, 3), test::make_box({-2, -2, -2}, {2, 2, 2})});
  const MeshLattice lattice = lattice_of(mesh, 0.13);
  std::vector<Coord> with_triangles, odd;
  NodeMasks even;
  for (auto cell = openvdb::CoordBBox(Coord(-20), Coord(20)).begin(); cell; ++cell) {
    const Coord place = *cell;
    if (lattice.triangles_in_cell(place).empty()) continue;
    with_triangles.push_back(place);
    if ((place.x() + place.y() + place.z()) % 2 == 0) {
      even.insert(place);
    } else {
      odd.push_back(place);
    }
  }
  const auto sorted = [](std::vector<Coord> cells) {
    std::sort(cells.begin(), cells.end());
    return cells;
  };
  EXPECT_EQ(sorted(lattice.cells()), sorted(with_triangles));
  EXPECT_EQ(sorted(lattice.cells_outside(even)), sorted(odd));
  EXPECT_FALSE(odd.empty());
}

TEST(MeshLattice, TrianglesOfCellsAreTheSameForSeveralThreads) {
  const TriangleMesh sphere = test::make_sphere({0.1, 0.2, 0.3}, 0.7, 4);
  const MeshLattice alone = lattice_of(sphere, 0.05), shared = lattice_of(sphere, 0.05);
  const std::vector<Coord> cells = alone.cells();
  std::vector<char> agrees(8 * cells.size(), 0);
  tbb::parallel_for(std::size_t{0}, agrees.size(), [&](std::size_t n) {
    // Threads begin at different places and meet in the same leaves.
    const Coord cell = cells[(n / 8 + n % 8 * 100) % cells.size()];
    const auto found = shared.triangles_in_cell(cell);
    agrees[n] = static_cast<char>(!found.empty() && found.size() == alone.triangles_in_cell(cell).size());
  });
  EXPECT_EQ(std::count(agrees.begin(), agrees.end(), 1), static_cast<std::ptrdiff_t>(agrees.size()));
}

TEST(MeshLattice, NoMeshIsOutsideEverywhere) {
  const TriangleMesh nothing;
  const MeshLattice lattice = lattice_of(nothing, 1.0);
  EXPECT_TRUE(lattice.crossings().empty());
  EXPECT_TRUE(lattice.cells().empty());
  EXPECT_EQ(lattice.winding_number(Coord(1, 2, 3)), 0);
  EXPECT_EQ(signed_distances(lattice, {Coord(1, 2, 3)}, 2.5), std::vector<float>{2.5f});
}

/// The text of the error that a lattice of these throws.
template <typename ExpectedError>
std::string error_of(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, double h) {
  try {
    const MeshLattice lattice(positions, triangles, h);
  } catch (const ExpectedError& error) {
    return error.what();
  }
  return "no error";
}

TEST(MeshLattice, UnusableInputIsNamed) {
  const std::vector<Triangle> triangles = {{0, 1, 2}};
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const float infinity = std::numeric_limits<float>::infinity();
  const auto with = [&](float x) { return std::vector<Vec3f>{kCorners[0], {0.0f, x, 0.0f}, kCorners[2]}; };
  EXPECT_NE(error_of<MeshError>(with(nan), triangles, 1.0).find("Vertex 1 at (0, nan, 0) m"), std::string::npos);
  EXPECT_NE(error_of<MeshError>(with(-infinity), triangles, 1.0).find("Vertex 1"), std::string::npos);
  EXPECT_NE(error_of<MeshError>(with(2e9f), triangles, 1.0).find("2^30 cells"), std::string::npos);
  EXPECT_NE(error_of<MeshError>(kCorners, {{0, 1, 2}, {0, 3, 1}}, 1.0).find("Triangle 1 names the vertices 0, 3, 1"),
            std::string::npos);
  const std::vector<Vec3f> vast = {{0, 0, 0}, {1e6f, 0, 0}, {0, 1e6f, 0}};
  EXPECT_NE(error_of<MeshError>(vast, triangles, 1.0).find("larger cells"), std::string::npos);
  for (const double h : {0.0, -1.0, 1e-40, std::nan(""), HUGE_VAL}) {
    EXPECT_NE(error_of<ParameterError>(kCorners, triangles, h).find("cell size"), std::string::npos) << h;
  }
}

}  // namespace
}  // namespace particle_surface_tracker
