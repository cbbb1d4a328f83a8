#include "stages/triangulation/cell_loops.h"

#include <set>
#include <utility>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/types.h"
#include "stages/triangulation/loop_filling.h"

namespace particle_surface_tracker {
namespace {

std::set<int> cut_edges(unsigned inside) {
  std::set<int> edges;
  for (int e = 0; e < kCellEdges; ++e) {
    const CellEdge& edge = cell_edges()[e];
    if ((inside >> edge.lower & 1) != (inside >> edge.upper & 1)) edges.insert(e);
  }
  return edges;
}

Vec3d corner_position(int corner) {
  return Vec3d(corner & 1, corner >> 1 & 1, corner >> 2);
}

Vec3d edge_middle(int edge) {
  return 0.5 * (corner_position(cell_edges()[edge].lower) + corner_position(cell_edges()[edge].upper));
}

TEST(CellLoops, EdgesAreTheTwelvePairsOfCornersThatDifferAlongOneAxis) {
  std::set<std::pair<int, int>> pairs;
  for (const CellEdge& edge : cell_edges()) {
    EXPECT_EQ(edge.lower ^ edge.upper, 1 << edge.axis);
    EXPECT_LT(edge.lower, edge.upper);
    pairs.insert({edge.lower, edge.upper});
  }
  EXPECT_EQ(pairs.size(), 12u);
}

TEST(CellLoops, EveryCutEdgeIsInExactlyOneLoop) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    const CellLoops& loops = cell_loops()[inside];
    std::multiset<int> points(loops.edge.begin(), loops.edge.begin() + loops.begin[loops.count]);
    const std::set<int> expected = cut_edges(inside);
    EXPECT_EQ(points, std::multiset<int>(expected.begin(), expected.end())) << inside;
    for (int loop = 0; loop < loops.count; ++loop) EXPECT_GE(loops.size(loop), 3) << inside;
  }
}

TEST(CellLoops, LoopsConsistOfTheSegmentsOfTheFaces) {
  for (unsigned inside = 0; inside < 256; ++inside) {
    std::set<std::pair<int, int>> segments;
    for (int face = 0; face < kCellFaces; ++face) {
      const FaceSegments on_face = face_segments(face, inside);
      for (int s = 0; s < on_face.count; ++s) segments.insert({on_face.segments[s].from, on_face.segments[s].to});
    }
    std::set<std::pair<int, int>> steps;
    const CellLoops& loops = cell_loops()[inside];
    for (int loop = 0; loop < loops.count; ++loop) {
      for (int i = 0; i < loops.size(loop); ++i) {
        steps.insert({loops.edge[loops.begin[loop] + i], loops.edge[loops.begin[loop] + (i + 1) % loops.size(loop)]});
      }
    }
    EXPECT_EQ(steps, segments) << inside;
  }
}

/// The edge of the next cell along an axis that is the edge `edge` of the upper face of this one.
int seen_by_neighbor(int edge, int axis) {
  for (int e = 0; e < kCellEdges; ++e) {
    if (edge_middle(e) == edge_middle(edge) - corner_position(1 << axis)) return e;
  }
  return -1;
}

TEST(CellLoops, NeighboringCellsCutTheirFaceTheSameWayInOppositeDirections) {
  for (int axis = 0; axis < 3; ++axis) {
    for (unsigned inside = 0; inside < 256; ++inside) {
      unsigned neighbor = 0;  // Shares the upper face; its far corners are outside.
      for (int c = 0; c < kCellCorners; ++c) {
        if ((c >> axis & 1) == 1 && (inside >> c & 1) != 0) neighbor |= 1u << (c ^ 1 << axis);
      }
      const FaceSegments here = face_segments(2 * axis + 1, inside);
      const FaceSegments there = face_segments(2 * axis, neighbor);
      std::set<std::pair<int, int>> expected;
      std::set<std::pair<int, int>> found;
      for (int s = 0; s < here.count; ++s) {
        expected.insert({seen_by_neighbor(here.segments[s].to, axis), seen_by_neighbor(here.segments[s].from, axis)});
      }
      for (int s = 0; s < there.count; ++s) found.insert({there.segments[s].from, there.segments[s].to});
      EXPECT_EQ(found, expected) << "axis " << axis << " pattern " << inside;
    }
  }
}

TEST(CellLoops, InsideCornersOfAnAmbiguousFaceAreKeptApart) {
  // Corners 0 and 3 of the lower face across z are inside.
  const FaceSegments on_face = face_segments(4, 0b1001);
  ASSERT_EQ(on_face.count, 2);
  for (int s = 0; s < 2; ++s) {
    const CellEdge& from = cell_edges()[on_face.segments[s].from];
    const CellEdge& to = cell_edges()[on_face.segments[s].to];
    const std::set<int> shared = {from.lower, from.upper};
    const int corner = shared.count(to.lower) != 0 ? to.lower : to.upper;
    EXPECT_TRUE(corner == 0 || corner == 3);
  }
}

TEST(CellLoops, OneInsideCornerIsCutOffCounterClockwiseSeenFromOutside) {
  for (int corner = 0; corner < kCellCorners; ++corner) {
    for (const bool turned : {false, true}) {
      const CellLoops& loops = cell_loops()[turned ? 255 - (1 << corner) : 1 << corner];
      ASSERT_EQ(loops.count, 1);
      ASSERT_EQ(loops.size(0), 3);
      const Vec3d a = edge_middle(loops.edge[0]);
      const Vec3d normal = (edge_middle(loops.edge[1]) - a).cross(edge_middle(loops.edge[2]) - a);
      const double towards_corner = normal.dot(corner_position(corner) - a);
      EXPECT_EQ(towards_corner > 0, turned) << corner;
    }
  }
}

TEST(LoopFilling, FillsEveryLoopAsADiscWithoutDiagonalsInsideFaces) {
  for (int inside = 0; inside < 256; ++inside) {
    const CellLoops& loops = cell_loops()[inside];
    const LoopFilling& filling = loop_fillings()[inside];
    std::set<std::pair<int, int>> open;  // Directed sides without their opposite.
    for (int t = 0; t < filling.triangle_count; ++t) {
      for (int i = 0; i < 3; ++i) {
        const std::pair<int, int> side(filling.triangles[t][i], filling.triangles[t][(i + 1) % 3]);
        if (open.erase({side.second, side.first}) == 1) {
          EXPECT_FALSE(edges_share_face(side.first, side.second)) << inside;
        } else {
          EXPECT_TRUE(open.insert(side).second) << inside;
        }
      }
    }
    std::set<std::pair<int, int>> outline;
    int triangles = 0;
    for (int loop = 0; loop < loops.count; ++loop) {
      triangles += loops.size(loop) - 2;
      for (int i = 0; i < loops.size(loop); ++i) {
        outline.insert({loops.edge[loops.begin[loop] + i], loops.edge[loops.begin[loop] + (i + 1) % loops.size(loop)]});
      }
    }
    EXPECT_EQ(filling.triangle_count, triangles) << inside;
    EXPECT_EQ(open, outline) << inside;
  }
}

}  // namespace
}  // namespace particle_surface_tracker
