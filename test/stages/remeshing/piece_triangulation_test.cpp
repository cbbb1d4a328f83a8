#include "stages/remeshing/piece_triangulation.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <random>

#include <gtest/gtest.h>

namespace particle_surface_tracker::remeshing {
namespace {

using Eigen::Vector2d;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// A piece and all that it refers to.
struct Piece {
  std::vector<std::vector<std::uint32_t>> loops;
  std::vector<Vector2d> places;
  std::vector<std::uint8_t> edges;
  std::vector<Pair> apart;

  void add_loop(const std::vector<Vector2d>& loop) {
    loops.emplace_back();
    for (const Vector2d& place : loop) {
      loops.back().push_back(static_cast<std::uint32_t>(places.size()));
      places.push_back(place);
      edges.push_back(0);
    }
  }

  bool triangulate(std::vector<std::array<std::uint32_t, 3>>& triangles) const {
    return triangulate_piece({loops, &places, &edges, &apart}, triangles);
  }
};

double area(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return 0.5 * ((b - a).x() * (c - a).y() - (b - a).y() * (c - a).x());
}

/// Every directed side once; those without a partner are the loops' edges.
void expect_disc_or_ring(const Piece& piece, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  std::map<Pair, int> sides;
  for (const auto& triangle : triangles) {
    for (int k = 0; k < 3; ++k) ++sides[{triangle[k], triangle[(k + 1) % 3]}];
  }
  std::vector<Pair> border;
  for (const auto& [side, count] : sides) {
    EXPECT_EQ(count, 1);
    if (sides.count({side.second, side.first}) == 0) border.push_back(side);
  }
  std::vector<Pair> expected;
  for (const auto& loop : piece.loops) {
    for (std::size_t n = 0; n < loop.size(); ++n) expected.push_back({loop[n], loop[(n + 1) % loop.size()]});
  }
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(border, expected);
}

double covered_area(const Piece& piece, const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  double sum = 0.0;
  for (const auto& [a, b, c] : triangles) {
    const double part = area(piece.places[a], piece.places[b], piece.places[c]);
    EXPECT_GE(part, -1e-12);
    sum += part;
  }
  return sum;
}

TEST(PieceTriangulation, SquareWithSquareHole) {
  Piece piece;
  piece.add_loop({{1, 1}, {1, 2}, {2, 2}, {2, 1}});
  piece.add_loop({{0, 0}, {3, 0}, {3, 3}, {0, 3}});
  std::vector<std::array<std::uint32_t, 3>> triangles;
  ASSERT_TRUE(piece.triangulate(triangles));
  EXPECT_EQ(triangles.size(), 8u);
  expect_disc_or_ring(piece, triangles);
  EXPECT_DOUBLE_EQ(covered_area(piece, triangles), 8.0);
}

TEST(PieceTriangulation, NeverJoinsVerticesOfOneTriangleEdge) {
  // Both diagonals of a flat strip look fine; only one is allowed.
  for (const std::uint32_t first : {0u, 1u}) {
    Piece piece;
    piece.add_loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
    piece.edges[first] = piece.edges[first + 2] = 1;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    ASSERT_TRUE(piece.triangulate(triangles));
    expect_disc_or_ring(piece, triangles);
    for (const auto& triangle : triangles) {
      EXPECT_FALSE(std::count(triangle.begin(), triangle.end(), first) > 0 &&
                   std::count(triangle.begin(), triangle.end(), first + 2) > 0);
    }
  }
}

TEST(PieceTriangulation, SaysWhereNothingIsAllowed) {
  Piece piece;
  piece.add_loop({{0, 0}, {1, 0}, {1, 1}, {0, 1}});
  piece.edges[0] = piece.edges[2] = 1;
  piece.apart = {{1, 3}};
  std::vector<std::array<std::uint32_t, 3>> triangles;
  EXPECT_FALSE(piece.triangulate(triangles));
}

TEST(PieceTriangulation, StarsOfAllSizesWithHoles) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    const auto uniform = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    const int size = 3 + static_cast<int>(random() % (seed % 10 == 0 ? 150 : 20));
    const int holes = static_cast<int>(random() % 4);
    Piece piece;
    double expected = 0.0;
    const auto add_star = [&](const Vector2d& center, double low, double high, int points, bool turned) {
      std::vector<Vector2d> loop;
      for (int n = 0; n < points; ++n) {
        const double angle = 2.0 * std::acos(-1.0) * n / points;
        loop.push_back(center + uniform(low, high) * Vector2d(std::cos(angle), std::sin(angle)));
      }
      for (int n = 1; n + 1 < points; ++n) expected += (turned ? -1 : 1) * area(loop[0], loop[n], loop[n + 1]);
      if (turned) std::reverse(loop.begin(), loop.end());
      piece.add_loop(loop);
    };
    add_star({0, 0}, size < 6 ? 9.0 : 4.0, 10.0, size, false);
    const Vector2d centers[3] = {{0.8, 0.0}, {-0.6, 0.7}, {-0.6, -0.7}};
    for (int hole = 0; hole < holes; ++hole) add_star(centers[hole], 0.2, 0.5, 3 + hole, true);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    ASSERT_TRUE(piece.triangulate(triangles));
    expect_disc_or_ring(piece, triangles);
    EXPECT_NEAR(covered_area(piece, triangles), expected, 1e-9);
  }
}

}  // namespace
}  // namespace particle_surface_tracker::remeshing
