#include "stages/upkeep/butterfly.h"

#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "stages/upkeep/editable_surface.h"
#include "stages/upkeep/half_edges.h"
#include "support/shapes.h"

// The weights of the modified butterfly scheme, one by one, and what they are made for.

namespace particle_surface_tracker {
namespace {

constexpr int kRings = 12, kSides = 12;

TriangleMesh make_regular_torus() {
  return test::make_torus(Vec3d::Zero(), 3.0, 1.0, kRings, kSides);
}

/// A mesh with the twins that belong to it.
class Surface {
 public:
  explicit Surface(TriangleMesh mesh) : mesh_(std::move(mesh)) {
    pair_half_edges(mesh_.vertex_count(), mesh_.triangles(), twins_);
    surface_.emplace(mesh_, twins_);
  }

  EditableSurface& operator*() { return *surface_; }
  EditableSurface* operator->() { return &*surface_; }

  std::uint32_t half_edge(std::uint32_t from, std::uint32_t to) const {
    std::uint32_t found = kNoHalfEdge;
    surface_->for_each_outgoing(from, [&](std::uint32_t h) {
      if (surface_->end(h) == to) found = h;
    });
    return found;
  }

  /// The weight of every vertex that has one, by moving one vertex at a time: the new position is linear in them.
  std::map<std::uint32_t, double> weights(std::uint32_t half_edge) {
    for (Vec3f& position : mesh_.positions()) position.setZero();
    std::map<std::uint32_t, double> weights;
    for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
      mesh_.positions()[v].x() = 1.0F;
      const double weight = butterfly_position(*surface_, half_edge).x();
      mesh_.positions()[v].x() = 0.0F;
      if (weight != 0.0) weights[v] = weight;
    }
    return weights;
  }

  /// The neighbours of the start of a half-edge, counter-clockwise from its end.
  std::vector<std::uint32_t> ring(std::uint32_t half_edge) const {
    std::vector<std::uint32_t> ring;
    std::uint32_t h = half_edge;
    do {
      ring.push_back(surface_->end(h));
      h = surface_->turn(h);
    } while (h != half_edge);
    return ring;
  }

 private:
  TriangleMesh mesh_;
  std::vector<std::uint32_t> twins_;
  std::optional<EditableSurface> surface_;
};

/// Some vertex of a valence, with a neighbour of another.
std::uint32_t find_half_edge(const EditableSurface& surface, std::uint32_t start_valence, std::uint32_t end_valence) {
  for (std::uint32_t h = 0; h < 3 * surface.triangle_slots(); ++h) {
    if (surface.valence(surface.start(h)) == start_valence && surface.valence(surface.end(h)) == end_valence) return h;
  }
  return kNoHalfEdge;
}

void expect_weights_around(Surface& surface, std::uint32_t half_edge, const std::vector<double>& of_neighbors) {
  ASSERT_NE(half_edge, kNoHalfEdge);
  const std::vector<std::uint32_t> ring = surface.ring(half_edge);
  ASSERT_EQ(ring.size(), of_neighbors.size());
  std::map<std::uint32_t, double> weights = surface.weights(half_edge);
  EXPECT_NEAR(weights[surface->start(half_edge)], 0.75, 1e-15);
  double sum = weights[surface->start(half_edge)];
  for (std::size_t i = 0; i < ring.size(); ++i) {
    EXPECT_NEAR(weights[ring[i]], of_neighbors[i], 1e-15) << "neighbour " << i;
    sum += weights[ring[i]];
  }
  EXPECT_NEAR(sum, 1.0, 1e-15) << "and no other vertex has a weight";
  for (const auto& [vertex, weight] : weights) sum -= weight;
  EXPECT_NEAR(sum, 0.0, 1e-15);
}

TEST(Butterfly, HasEightWeightsBetweenRegularVertices) {
  Surface surface(make_regular_torus());
  const std::uint32_t h = 40;
  const std::uint32_t twin = surface->twin(h);
  std::map<std::uint32_t, double> expected;
  for (const std::uint32_t side : {h, twin}) {
    expected[surface->start(side)] = 0.5;
    expected[surface->apex(side)] = 0.125;
    expected[surface->apex(surface->twin(next_half_edge(side)))] = -0.0625;
    expected[surface->apex(surface->twin(previous_half_edge(side)))] = -0.0625;
  }
  ASSERT_EQ(expected.size(), 8U);
  EXPECT_EQ(surface.weights(h), expected);
}

TEST(Butterfly, HasItsOwnWeightsAroundAVertexOfValenceThree) {
  TriangleMesh mesh = make_regular_torus();
  std::vector<Triangle> triangles = mesh.triangles();
  const auto [a, b, c] = triangles[40];
  const std::uint32_t m = mesh.append_vertex({}, {});
  triangles[40] = {a, b, m};
  triangles.push_back({b, c, m});
  triangles.push_back({c, a, m});
  mesh.set_triangles(triangles);
  Surface surface(std::move(mesh));
  // A flip of an edge of `a` that is far from the new vertex makes `a` regular again.
  const std::uint32_t to_new = surface.half_edge(a, m);
  surface->flip(surface->turn(surface->turn(surface->turn(to_new))));
  ASSERT_EQ(surface->valence(a), 6U);
  ASSERT_EQ(surface->valence(m), 3U);
  expect_weights_around(surface, surface.half_edge(m, a), {5.0 / 12.0, -1.0 / 12.0, -1.0 / 12.0});
}

TEST(Butterfly, HasItsOwnWeightsAroundAVertexOfValenceFour) {
  Surface surface(test::make_sphere(Vec3d::Zero(), 1.0, 3));
  expect_weights_around(surface, find_half_edge(*surface, 4, 6), {3.0 / 8.0, 0.0, -1.0 / 8.0, 0.0});
}

TEST(Butterfly, FollowsTheFormulaAroundOtherVertices) {
  Surface surface(make_regular_torus());
  surface->flip(40);
  // s_i = (1/4 + cos(2πi/K) + cos(4πi/K)/2) / K, written out.
  const double c1 = (std::sqrt(5.0) - 1.0) / 4.0, c2 = -(std::sqrt(5.0) + 1.0) / 4.0;
  const double next = (0.25 + c1 + c2 / 2.0) / 5.0, far = (0.25 + c2 + c1 / 2.0) / 5.0;
  expect_weights_around(surface, find_half_edge(*surface, 5, 6), {1.75 / 5.0, next, far, far, next});
  const double a = 0.62348980185873353, b = -0.22252093395631440, c = -0.90096886790241913;  // cos(2πi/7), i = 1, 2, 3
  const double s1 = (0.25 + a + b / 2.0) / 7.0, s2 = (0.25 + b + c / 2.0) / 7.0, s3 = (0.25 + c + a / 2.0) / 7.0;
  expect_weights_around(surface, find_half_edge(*surface, 7, 6), {0.25, s1, s2, s3, s3, s2, s1});
}

TEST(Butterfly, IsTheMeanOfBothEndsWhereNeitherIsRegular) {
  Surface surface(make_regular_torus());
  surface->flip(40);
  const std::uint32_t h = find_half_edge(*surface, 5, 7);
  ASSERT_NE(h, kNoHalfEdge);
  std::map<std::uint32_t, double> weights = surface.weights(h);
  EXPECT_EQ(weights.size(), 10U) << "both ends, their other neighbours, two of which they have in common";
  EXPECT_NEAR(weights[surface->start(h)], (0.75 + 1.75 / 7.0) / 2.0, 1e-15);
  EXPECT_NEAR(weights[surface->end(h)], (0.75 + 1.75 / 5.0) / 2.0, 1e-15);
}

TEST(Butterfly, ReproducesCubicPolynomialsOnARegularGrid) {
  TriangleMesh mesh = make_regular_torus();
  // Vertex (i, j) of the torus at (i, j) of an oblique grid: away from where the torus closes that is a plane, and
  // small integers are exact.
  const auto height = [](double u, double v) {
    return u * u * u - 2.0 * u * u * v + 3.0 * u * v * v - v * v * v + u * v;
  };
  for (int i = 0; i < kRings; ++i) {
    for (int j = 0; j < kSides; ++j) {
      const double u = i - 6, v = j - 6;
      mesh.positions()[static_cast<std::size_t>(i * kSides + j)] = Vec3d(u, v, height(u, v)).cast<float>();
    }
  }
  Surface surface(std::move(mesh));
  int edges = 0;
  for (std::uint32_t h = 0; h < 3 * surface->triangle_slots(); ++h) {
    const Vec3d from = surface->position(surface->start(h)), to = surface->position(surface->end(h));
    if (from.head<2>().cwiseAbs().maxCoeff() > 3.0 || to.head<2>().cwiseAbs().maxCoeff() > 3.0) continue;
    const Vec3d middle = butterfly_position(*surface, h);
    EXPECT_EQ(middle.head<2>(), (0.5 * (from + to)).head<2>());
    EXPECT_EQ(middle.z(), height(middle.x(), middle.y()));
    ++edges;
  }
  EXPECT_GT(edges, 200);
}

}  // namespace
}  // namespace particle_surface_tracker
