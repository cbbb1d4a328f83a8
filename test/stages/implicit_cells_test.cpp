// Which nodes are evaluated: the corners of all cells that the zero level of φ̃ passes through, and no others.

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/particle_grid.h"
#include "particle_surface_tracker/stages/implicit_function.h"
#include "support/implicit_bodies.h"

namespace particle_surface_tracker::test::implicit {
namespace {

openvdb::Coord corner(const openvdb::Coord& cell, int n) {
  return cell.offsetBy((n >> 2) & 1, (n >> 1) & 1, n & 1);
}

/// The cells whose eight corners are active and differ in sign, sorted.
std::vector<openvdb::Coord> cut_cells(const ImplicitSurface& surface) {
  std::vector<openvdb::Coord> cells;
  const auto field = surface.field->getConstAccessor();
  for (auto node = surface.field->cbeginValueOn(); node; ++node) {
    int active = 0;
    int inside = 0;
    for (int n = 0; n < 8; ++n) {
      float value = 0.0f;
      if (!field.probeValue(corner(node.getCoord(), n), value)) continue;
      ++active;
      inside += value < 0.0f;
    }
    if (active == 8 && inside > 0 && inside < 8) cells.push_back(node.getCoord());
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// The same from values at all nodes of the box around the particles.
std::vector<openvdb::Coord> cut_cells_by_brute_force(const Positions& positions, const Parameters& parameters) {
  const double dx = parameters.dx_phi * parameters.particle_spacing;
  const ParticleGrid grid(positions, implicit_function_cell_size(parameters));
  Eigen::AlignedBox3d box;
  for (const Vec3f& p : positions) box.extend(p.cast<double>());
  // Nothing is inside farther than r̄ from the convex hull of the particles.
  const double margin = 1.1 * parameters.surface_radius * parameters.particle_spacing + dx;
  const Eigen::Vector3i first = ((box.min().array() - margin) / dx).floor().cast<int>();
  const Eigen::Vector3i size = ((box.max().array() + margin) / dx).ceil().cast<int>() - first.array() + 1;
  std::vector<char> inside(static_cast<std::size_t>(size.prod()));
  const auto index = [&](int i, int j, int k) { return (static_cast<std::size_t>(i) * size.y() + j) * size.z() + k; };
  for (int i = 0; i < size.x(); ++i) {
    for (int j = 0; j < size.y(); ++j) {
      for (int k = 0; k < size.z(); ++k) {
        const Vec3d x = dx * (first + Eigen::Vector3i(i, j, k)).cast<double>();
        inside[index(i, j, k)] = implicit_function_at(grid, x, parameters) < 0.0;
      }
    }
  }
  std::vector<openvdb::Coord> cells;
  for (int i = 0; i + 1 < size.x(); ++i) {
    for (int j = 0; j + 1 < size.y(); ++j) {
      for (int k = 0; k + 1 < size.z(); ++k) {
        int count = 0;
        for (int n = 0; n < 8; ++n) count += inside[index(i + (n >> 2), j + ((n >> 1) & 1), k + (n & 1))];
        if (count > 0 && count < 8) cells.emplace_back(first.x() + i, first.y() + j, first.z() + k);
      }
    }
  }
  return cells;
}

/// The cut cells are the right ones, and nothing but their corners is active.
void expect_whole_surface(const Positions& positions, const Parameters& parameters) {
  const ImplicitSurface surface = evaluate(positions, parameters);
  const std::vector<openvdb::Coord> cells = cut_cells(surface);
  EXPECT_EQ(cells, cut_cells_by_brute_force(positions, parameters));

  std::vector<openvdb::Coord> corners;
  for (const openvdb::Coord& cell : cells) {
    for (int n = 0; n < 8; ++n) corners.push_back(corner(cell, n));
  }
  std::sort(corners.begin(), corners.end());
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  EXPECT_EQ(corners.size(), surface.field->activeVoxelCount());
  const auto field = surface.field->getConstAccessor();
  for (const openvdb::Coord& node : corners) ASSERT_TRUE(field.isValueOn(node));
}

TEST(ImplicitCells, AreTheWholeSurfaceOfSolids) {
  const Parameters parameters = make_parameters();
  const Inside torus = [](const Vec3d& p) { return std::hypot(std::hypot(p.x(), p.y()) - 0.5, p.z()) < 0.2; };
  const Inside hollow = [](const Vec3d& p) { return is_in_ball(p, 0.75) && !is_in_ball(p, 0.4); };
  expect_whole_surface(fill(0.8, 0.0, [](const Vec3d& p) { return is_in_ball(p, 0.6); }), parameters);
  expect_whole_surface(fill(0.8, 0.0, torus), parameters);
  expect_whole_surface(fill(0.8, 0.3, torus), parameters);
  expect_whole_surface(fill(0.9, 0.2, hollow), parameters);
  expect_whole_surface(fill(0.4, 0.0, [](const Vec3d&) { return true; }), parameters);
}

TEST(ImplicitCells, AreTheWholeSurfaceOfSplashes) {
  SCOPED_TRACE(kSeed);
  const Parameters parameters = make_parameters();
  expect_whole_surface(splash(), parameters);
  expect_whole_surface(random_cloud(300, 1.2, kSeed + 60), parameters);
  for (std::uint32_t seed = 0; seed < 3; ++seed) {
    Positions blobs;
    for (const Vec3f& center : random_cloud(5, 0.6, kSeed + 70 + seed)) {
      const Positions blob = moved(fill(0.3, 0.4, [](const Vec3d& p) { return is_in_ball(p, 0.28); }), center);
      blobs.insert(blobs.end(), blob.begin(), blob.end());
    }
    expect_whole_surface(blobs, parameters);
  }
}

TEST(ImplicitCells, AreTheWholeSurfaceOfOneAndTwoParticles) {
  const Parameters parameters = make_parameters();
  for (const float offset : {0.0f, 0.013f, 0.025f, 0.05f, 0.0731f}) {
    expect_whole_surface({{offset, 0.5f * offset, -offset}}, parameters);
    for (const float distance : {0.0f, 0.02f, 0.1f, 0.15f, 0.2f, 0.25f, 0.3f, 0.35f, 0.39f, 0.4f, 0.5f}) {
      expect_whole_surface({{offset, 0.0f, 0.0f}, {offset + distance, 0.3f * distance, 0.0f}}, parameters);
    }
  }
}

TEST(ImplicitCells, AreTheWholeSurfaceForOtherCellSizes) {
  const Positions ball = fill(0.6, 0.2, [](const Vec3d& p) { return is_in_ball(p, 0.45); });
  for (const double dx_phi : {0.2, 0.25, 1.0 / 3.0, 0.4, 0.6, 1.0, 1.3}) {
    SCOPED_TRACE(dx_phi);
    expect_whole_surface(ball, make_parameters(dx_phi));
  }
}

TEST(ImplicitCells, OfAHollowBallLieOnBothSides) {
  const Inside hollow = [](const Vec3d& p) { return is_in_ball(p, 0.8) && !is_in_ball(p, 0.4); };
  const ImplicitSurface surface = evaluate(fill(0.9, 0.0, hollow), make_parameters());
  double innermost = 1.0;
  double outermost = 0.0;
  for (const openvdb::Coord& cell : cut_cells(surface)) {
    const double distance = surface.dx * (cell.asVec3d() + openvdb::Vec3d(0.5)).length();
    innermost = std::min(innermost, distance);
    outermost = std::max(outermost, distance);
    EXPECT_TRUE(std::abs(distance - 0.4) < 0.12 || std::abs(distance - 0.8) < 0.12) << distance;
  }
  EXPECT_LT(innermost, 0.5);
  EXPECT_GT(outermost, 0.7);
}

TEST(ImplicitCells, TakeNothingForAnEmptyKilometre) {
  const Parameters parameters = make_parameters();
  const Positions near = {{0.0f, 0.0f, 0.0f}, {2.0f, 0.0f, 0.0f}};
  const Positions far = {{0.0f, 0.0f, 0.0f}, {1024.0f, 0.0f, 0.0f}};
  const ImplicitSurface surface = evaluate(far, parameters);
  EXPECT_LE(surface.field->tree().leafCount(), 2 * 27u);
  EXPECT_LT(surface.field->memUsage(), 2 * evaluate(near, parameters).field->memUsage() + 1000000u);
  const double middle = 512.0 / surface.dx;
  for (auto node = surface.field->cbeginValueOn(); node; ++node) {
    EXPECT_GT(std::abs(node.getCoord().x() - middle), middle - 4.0);
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test::implicit
