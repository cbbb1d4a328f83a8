// Compares MeshLattice with rational numbers, triangle by triangle.

#include <algorithm>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "stages/lattice/exact_lattice.h"
#include "stages/lattice/lattice_cases.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;
using test::Coordinates;
using test::ExactLattice;
using test::LatticeCase;

ExactLattice::PointName name_of(const LatticePoint& point) {
  return {point.kind == LatticePoint::Kind::kOnLatticeFace, point.axis, point.node, point.a, point.b};
}

std::vector<ExactLattice::Segment> segments_of(const TriangleCut& cut) {
  std::vector<ExactLattice::Segment> segments;
  for (const TriangleCut::Segment& s : cut.segments) {
    segments.push_back({s.face.axis, s.face.node, name_of(cut.points[s.from]), name_of(cut.points[s.to])});
  }
  std::sort(segments.begin(), segments.end());
  return segments;
}

void expect_same_segments(const MeshLattice& lattice, const ExactLattice& exact, std::uint32_t triangle) {
  const TriangleCut cut = lattice.cut_triangle(triangle);
  const auto segments = segments_of(cut);
  const auto expected = exact.segments(triangle);
  ASSERT_EQ(segments.size(), expected.size()) << "triangle " << triangle;
  for (std::size_t n = 0; n < segments.size(); ++n) {
    EXPECT_TRUE(segments[n] == expected[n]) << "triangle " << triangle << ", segment " << n << " on the face across "
                                            << expected[n].axis << " at " << expected[n].face;
  }
  for (int corner = 0; corner < 3; ++corner) {
    EXPECT_EQ(cut.cells[corner], lattice.cell_of_vertex(lattice.triangles()[triangle][corner]));
  }
}

/// All crossings, in the order that MeshLattice promises.
std::vector<ExactLattice::Crossing> sorted_crossings(const ExactLattice& exact, std::size_t triangle_count) {
  std::vector<ExactLattice::Crossing> all;
  for (std::uint32_t t = 0; t < triangle_count; ++t) {
    const auto some = exact.crossings(t);
    all.insert(all.end(), some.begin(), some.end());
  }
  const auto edge_of = [](const ExactLattice::Crossing& crossing) {
    return LatticeEdge{crossing.node, static_cast<std::uint8_t>(crossing.axis)};
  };
  std::sort(all.begin(), all.end(), [&](const ExactLattice::Crossing& p, const ExactLattice::Crossing& q) {
    if (edge_of(p) != edge_of(q)) return edge_of(p) < edge_of(q);
    if (p.place != q.place) return p.place < q.place;
    return std::make_tuple(-p.step, p.triangle) < std::make_tuple(-q.step, q.triangle);
  });
  return all;
}

void expect_same_crossings(const MeshLattice& lattice, const ExactLattice& exact) {
  const auto expected = sorted_crossings(exact, lattice.triangles().size());
  const std::vector<EdgeCrossing>& crossings = lattice.crossings();
  ASSERT_EQ(crossings.size(), expected.size());
  for (std::size_t n = 0; n < expected.size(); ++n) {
    const LatticeEdge edge = {expected[n].node, static_cast<std::uint8_t>(expected[n].axis)};
    EXPECT_EQ(crossings[n].edge, edge) << "crossing " << n;
    EXPECT_EQ(crossings[n].triangle, expected[n].triangle) << "crossing " << n;
    EXPECT_EQ(crossings[n].step, expected[n].step) << "crossing " << n;
    const double below = lattice.plane(edge.node[edge.axis]);
    const double place = (static_cast<double>(expected[n].place) - below) / lattice.h();
    const double extent = static_cast<double>(lattice.positions()[0].cwiseAbs().maxCoeff()) / lattice.h();
    EXPECT_NEAR(crossings[n].place, place, 1e-9 + 1e-12 * extent) << "crossing " << n;
  }
}

void expect_same_order(const MeshLattice& lattice, const ExactLattice& exact) {
  std::vector<LatticePoint> points;
  for (std::uint32_t t = 0; t < lattice.triangles().size(); ++t) {
    const TriangleCut cut = lattice.cut_triangle(t);
    for (const LatticePoint& p : cut.points) {
      if (p.kind == LatticePoint::Kind::kOnLatticeFace) points.push_back(p);
    }
  }
  for (const LatticePoint& p : points) {
    const auto share = exact.share(p.a, p.b, p.axis, p.node[p.axis]);
    EXPECT_NEAR(p.place, static_cast<double>(share), 1e-9);
    for (const LatticePoint& q : points) {
      if (p.a != q.a || p.b != q.b) continue;
      EXPECT_EQ(lattice.comes_before(p, q), share < exact.share(q.a, q.b, q.axis, q.node[q.axis]));
    }
  }
}

/// The cells that a triangle meets, by its cut.
std::vector<Coord> met_cells(const TriangleCut& cut) {
  std::vector<Coord> cells(cut.cells.begin(), cut.cells.end());
  for (const TriangleCut::Segment& s : cut.segments) {
    cells.push_back(s.face.lower_cell());
    cells.push_back(s.face.upper_cell());
  }
  return cells;
}

void expect_in_cells(const MeshLattice& lattice, std::uint32_t triangle) {
  for (const Coord& cell : met_cells(lattice.cut_triangle(triangle))) {
    const auto triangles = lattice.triangles_in_cell(cell);
    EXPECT_TRUE(std::binary_search(triangles.begin(), triangles.end(), triangle)) << triangle << " in " << cell;
  }
}

void expect_exact(const LatticeCase& body) {
  SCOPED_TRACE(body.name);
  const MeshLattice lattice(body.mesh.positions(), body.mesh.triangles(), body.h);
  const ExactLattice exact(body.mesh.positions(), body.mesh.triangles(), body.h);
  for (std::uint32_t v = 0; v < body.mesh.vertex_count(); ++v) EXPECT_EQ(lattice.cell_of_vertex(v), exact.cell(v));
  for (std::uint32_t t = 0; t < body.mesh.triangle_count(); ++t) {
    expect_same_segments(lattice, exact, t);
    expect_in_cells(lattice, t);
  }
  expect_same_crossings(lattice, exact);
  expect_same_order(lattice, exact);
}

class RandomTriangles : public testing::TestWithParam<Coordinates> {};

TEST_P(RandomTriangles, AreCutAsByRationalNumbers) {
  for (std::uint32_t seed = 0; seed < 25; ++seed) {
    expect_exact(test::random_triangles(seed, GetParam()));
    expect_exact(test::random_closed_mesh(seed, GetParam()));
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(MeshLattice, RandomTriangles,
                         testing::Values(Coordinates::kRandom, Coordinates::kOnLattice, Coordinates::kNearLattice,
                                         Coordinates::kNudged, Coordinates::kFarAway));

TEST(MeshLatticeExactness, AlignedBodiesAreCutAsByRationalNumbers) {
  for (const LatticeCase& body : test::aligned_bodies()) expect_exact(body);
}

}  // namespace
}  // namespace particle_surface_tracker
