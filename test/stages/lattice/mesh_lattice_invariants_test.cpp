// What must hold for every closed manifold mesh, however it lies.

#include <algorithm>
#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "sequences/solid_judge.h"
#include "stages/lattice/lattice_cases.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;
using test::Coordinates;
using test::LatticeCase;

MeshLattice lattice_of(const LatticeCase& body) {
  return MeshLattice(body.mesh.positions(), body.mesh.triangles(), body.h);
}

/// Calls visit(node) for the nodes in and around the bounding box of a mesh, at most about 20 along each axis.
template <typename Visit>
void for_nodes_around(const MeshLattice& lattice, Visit&& visit) {
  Coord lower = lattice.cell_of_vertex(0);
  Coord upper = lower;
  for (std::uint32_t v = 0; v < lattice.positions().size(); ++v) {
    lower.minComponent(lattice.cell_of_vertex(v));
    upper.maxComponent(lattice.cell_of_vertex(v));
  }
  const Coord stride(1 + (upper.x() - lower.x()) / 20, 1 + (upper.y() - lower.y()) / 20,
                     1 + (upper.z() - lower.z()) / 20);
  for (int i = lower.x() - 1; i <= upper.x() + 2; i += stride.x()) {
    for (int j = lower.y() - 1; j <= upper.y() + 2; j += stride.y()) {
      for (int k = lower.z() - 1; k <= upper.z() + 2; k += stride.z()) visit(Coord(i, j, k));
    }
  }
}

void expect_axes_agree(const MeshLattice& lattice) {
  for_nodes_around(lattice, [&](const Coord& node) {
    const int along_z = lattice.winding_number(node, 2);
    EXPECT_EQ(lattice.winding_number(node, 0), along_z) << node;
    EXPECT_EQ(lattice.winding_number(node, 1), along_z) << node;
  });
}

/// Ends of segments at one point of one face.
struct Ends {
  int from = 0;
  int to = 0;
};

/// Order of points with their face.
struct PlaceOrder {
  using Place = std::pair<LatticeFace, LatticePoint>;
  bool operator()(const Place& p, const Place& q) const {
    return std::tie(p.first, p.second) < std::tie(q.first, q.second);
  }
};

void expect_paths_on_faces(const MeshLattice& lattice) {
  std::map<PlaceOrder::Place, Ends, PlaceOrder> graph;
  TriangleCut cut;
  for (std::uint32_t t = 0; t < lattice.triangles().size(); ++t) {
    lattice.cut_triangle(t, cut);
    std::vector<LatticeFace> faces;
    for (const TriangleCut::Segment& s : cut.segments) {
      faces.push_back(s.face);
      ++graph[{s.face, cut.points[s.from]}].from;
      ++graph[{s.face, cut.points[s.to]}].to;
    }
    std::sort(faces.begin(), faces.end());
    EXPECT_EQ(std::adjacent_find(faces.begin(), faces.end()), faces.end()) << "triangle " << t;
  }
  for (const auto& [place, ends] : graph) {
    if (place.second.kind == LatticePoint::Kind::kOnLatticeFace) {
      EXPECT_EQ(ends.from, 1);
      EXPECT_EQ(ends.to, 1);
    } else {
      EXPECT_EQ(ends.from + ends.to, 1);
    }
  }
}

/// Along every edge, the winding number changes by the steps from that of its lower node to that of its upper one.
void expect_steps_between_nodes(const MeshLattice& lattice) {
  for (const EdgeCrossing& crossing : lattice.crossings()) {
    const int axis = crossing.edge.axis;
    Coord upper = crossing.edge.node;
    ++upper[axis];
    int winding = lattice.winding_number(crossing.edge.node, (axis + 1) % 3);
    for (const EdgeCrossing& c : lattice.crossings_on(crossing.edge)) winding += c.step;
    EXPECT_EQ(winding, lattice.winding_number(upper, (axis + 2) % 3));
  }
}

void expect_invariants(const LatticeCase& body) {
  SCOPED_TRACE(body.name);
  const MeshLattice lattice = lattice_of(body);
  expect_axes_agree(lattice);
  expect_paths_on_faces(lattice);
  expect_steps_between_nodes(lattice);
}

class RandomMeshes : public testing::TestWithParam<Coordinates> {};

TEST_P(RandomMeshes, HaveOneWindingNumberAndPathsOnFaces) {
  for (std::uint32_t seed = 1000; seed < 1500; ++seed) {
    expect_invariants(test::random_closed_mesh(seed, GetParam()));
    if (HasFailure()) return;
  }
}

INSTANTIATE_TEST_SUITE_P(MeshLattice, RandomMeshes,
                         testing::Values(Coordinates::kRandom, Coordinates::kOnLattice, Coordinates::kNearLattice,
                                         Coordinates::kNudged, Coordinates::kFarAway));

TEST(MeshLatticeInvariants, HoldForAlignedBodies) {
  for (const LatticeCase& body : test::aligned_bodies()) expect_invariants(body);
}

TEST(MeshLatticeInvariants, WindingNumbersAreThoseOfCgal) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    const LatticeCase body = test::random_closed_mesh(seed, Coordinates::kRandom);
    SCOPED_TRACE(body.name);
    const MeshLattice lattice = lattice_of(body);
    const test::SolidJudge judge(body.mesh.positions(), body.mesh.triangles());
    for_nodes_around(lattice, [&](const Coord& node) {
      // The judge counts how often rays leave the mesh, so outwards is positive for it as well.
      const Vec3f place(node.x() * 0.5f, node.y() * 0.5f, node.z() * 0.5f);
      EXPECT_EQ(lattice.winding_number(node), judge.winding_number(place)) << node;
    });
  }
}

TEST(MeshLatticeInvariants, ThreadsDoNotChangeTheResult) {
  const TriangleMesh mesh =
      test::joined({test::make_sphere({0, 0, 0}, 1.0, 5), test::make_sphere({0.5, 0, 0}, 1.0, 5),
                    test::make_torus({0, 0, 0}, 1.5, 0.5, 64, 64), test::make_torus({0, 0, 0}, 1.5, 0.5, 64, 64)});
  std::vector<EdgeCrossing> crossings[2];
  std::vector<Coord> cells[2];
  std::vector<float> distances[2];
  for (int n = 0; n < 2; ++n) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, n + 1);
    const MeshLattice lattice(mesh.positions(), mesh.triangles(), 0.05);
    crossings[n] = lattice.crossings();
    cells[n] = lattice.cells();
    distances[n] = signed_distances(lattice, cells[n], 0.1);
  }
  ASSERT_EQ(crossings[0].size(), crossings[1].size());
  for (std::size_t n = 0; n < crossings[0].size(); ++n) {
    EXPECT_EQ(crossings[0][n].edge, crossings[1][n].edge);
    EXPECT_EQ(crossings[0][n].triangle, crossings[1][n].triangle);
    EXPECT_EQ(crossings[0][n].place, crossings[1][n].place);
  }
  EXPECT_EQ(cells[0], cells[1]);
  EXPECT_EQ(distances[0], distances[1]);
}

}  // namespace
}  // namespace particle_surface_tracker
