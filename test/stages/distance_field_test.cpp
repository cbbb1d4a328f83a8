#include "particle_surface_tracker/stages/distance_field.h"

#include <cmath>
#include <functional>

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include "core/instruction_set.h"
#include "particle_surface_tracker/stages/surface_triangulation.h"
#include "support/sampled_field.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;
using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, CGAL::AABB_triangle_primitive<Kernel, Triangles::iterator>>>;
using Function = std::function<double(const Vec3d&)>;

constexpr double kDx = 0.1;
constexpr int kHalfWidth = 22;

/// Of a distance [cells]: the method finds the closest triangle, so that only rounding is left.
constexpr double kTolerance = 2e-3;

ImplicitSurface make_surface(const Function& function, double dx = kDx, const Coord& center = Coord(0)) {
  ImplicitSurface surface;
  surface.dx = dx;
  surface.field = test::sample_cut_cells(function, dx, kHalfWidth - 5, center);
  surface.triangulation = triangulate_zero_level(*surface.field, dx);
  return surface;
}

/// Exact distances, in cells.
class Judge {
 public:
  explicit Judge(const ImplicitSurface& surface) {
    for (const Triangle& t : surface.triangulation.triangles) {
      const auto corner = [&](int i) {
        const Vec3d v = surface.triangulation.vertices[t[i]].cast<double>() / surface.dx;
        return Kernel::Point_3(v.x(), v.y(), v.z());
      };
      triangles_.emplace_back(corner(0), corner(1), corner(2));
    }
    tree_.rebuild(triangles_.begin(), triangles_.end());
    tree_.accelerate_distance_queries();
  }
  Kernel::Point_3 closest(const Vec3d& x) const { return tree_.closest_point(Kernel::Point_3(x.x(), x.y(), x.z())); }
  double operator()(const Coord& node) const {
    return std::sqrt(tree_.squared_distance(Kernel::Point_3(node.x(), node.y(), node.z())));
  }

 private:
  Triangles triangles_;
  Tree tree_;
};

struct Case {
  const char* name;
  Function function;
};

double sphere(const Vec3d& x, double radius) {
  return x.norm() - radius;
}

const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"sphere", [](const Vec3d& x) { return sphere(x - Vec3d(0.01, 0.02, 0.03), 1.1); }},
      {"sphere on the lattice", [](const Vec3d& x) { return sphere(x, 1.0); }},
      {"torus", [](const Vec3d& x) { return std::hypot(std::hypot(x.x(), x.y()) - 1.0, x.z()) - 0.35; }},
      {"two spheres",
       [](const Vec3d& x) { return std::min(sphere(x - Vec3d(0.8, 0, 0), 0.5), sphere(x + Vec3d(0.8, 0, 0), 0.6)); }},
      {"two spheres nearly touching",
       [](const Vec3d& x) {
         return std::min(sphere(x - Vec3d(0.62, 0, 0), 0.55), sphere(x + Vec3d(0.62, 0, 0), 0.55));
       }},
      {"ball with a cavity", [](const Vec3d& x) { return std::max(sphere(x, 1.3), -sphere(x, 0.6)); }},
      {"sheet",
       [](const Vec3d& x) { return std::max(std::abs(x.z() + 0.2 * std::sin(2 * x.x())) - 0.07, sphere(x, 1.3)); }},
      {"bumps",
       [](const Vec3d& x) {
         return sphere(x, 1.2) + 0.15 * std::sin(9 * x.x()) * std::sin(8 * x.y() + 1) * std::sin(10 * x.z());
       }},
      {"waves", [](const Vec3d& x) {
         return sphere(x, 1.1) + 0.1 * (std::sin(11 * x.x() + 3 * x.y()) + std::sin(12 * x.z() + x.x()));
       }}};
  return all;
}

class DistanceFieldOf : public testing::TestWithParam<std::size_t> {};

TEST_P(DistanceFieldOf, IsThereWithinReachExactAndOfTheRightSign) {
  const Case& shape = cases()[GetParam()];
  SCOPED_TRACE(shape.name);
  const ImplicitSurface surface = make_surface(shape.function);
  const Judge judge(surface);
  const double reach = 4.0;
  const SignedDistanceField field = DistanceFields(surface).everywhere(reach * kDx);
  std::size_t present = 0;
  for (int i = -kHalfWidth; i <= kHalfWidth; ++i) {
    for (int j = -kHalfWidth; j <= kHalfWidth; ++j) {
      for (int k = -kHalfWidth; k <= kHalfWidth; ++k) {
        const Coord node(i, j, k);
        const double distance = judge(node);
        const float value = field.phi->tree().getValue(node);
        const bool is_there = field.phi->tree().isValueOn(node);
        present += is_there;
        ASSERT_EQ(is_there, value != SignedDistanceField::absent) << node;
        if (distance < reach - 1e-4) {
          ASSERT_TRUE(is_there) << node << " at " << distance;
        }
        if (distance > reach + 1e-4) {
          ASSERT_FALSE(is_there) << node << " at " << distance;
        }
        if (!is_there) continue;
        ASSERT_NEAR(std::abs(value) / kDx, distance, kTolerance) << node;
        ASSERT_EQ(value < 0, shape.function(Vec3d(i, j, k) * kDx) < 0) << node;
      }
    }
  }
  EXPECT_EQ(present, field.phi->activeVoxelCount());
  EXPECT_GT(present, 1000u);
}

INSTANTIATE_TEST_SUITE_P(AllShapes, DistanceFieldOf, testing::Range(std::size_t{0}, cases().size()));

TEST(DistanceField, NearPositionsEqualsTheWholeField) {
  const ImplicitSurface surface = make_surface(cases()[7].function);
  for (const double reach : {2.0, 4.0, 6.5}) {
    const SignedDistanceField whole = DistanceFields(surface).everywhere(reach * kDx);
    const std::vector<Vec3f> positions = {Vec3f(1.2f, 0.03f, -0.1f), Vec3f(-0.5f, -0.8f, 0.6f), Vec3f(90, 0, 0)};
    const SignedDistanceField near = DistanceFields(surface).around(positions, reach * kDx);
    for (auto value = near.phi->cbeginValueOn(); value; ++value) {
      ASSERT_NEAR(*value, whole.phi->tree().getValue(value.getCoord()), 1e-6 * kDx);
    }
    std::size_t expected = 0;
    for (auto value = whole.phi->cbeginValueOn(); value; ++value) {
      const Coord c = value.getCoord();
      for (const Vec3f& position : positions) {
        const Vec3d apart = Vec3d(c.x(), c.y(), c.z()) - position.cast<double>() / kDx;
        if (apart.cwiseAbs().maxCoeff() > std::max(reach, 4.0)) continue;
        ASSERT_TRUE(near.phi->tree().isValueOn(c)) << c;
        ++expected;
      }
    }
    EXPECT_GT(expected, 100u);
    EXPECT_LT(near.phi->activeVoxelCount(), whole.phi->activeVoxelCount());
  }
}

std::vector<Coord> stencil_of(const Coord& cell) {
  std::vector<Coord> nodes;
  for (int n = 0; n < 64; ++n) nodes.push_back(cell.offsetBy((n >> 4) - 1, ((n >> 2) & 3) - 1, (n & 3) - 1));
  return nodes;
}

TEST(DistanceField, HasTheStencilsOfCutCellsAndOfPositionsNearTheSurface) {
  for (const std::size_t shape : {0, 4, 6, 7, 8}) {
    SCOPED_TRACE(cases()[shape].name);
    const ImplicitSurface surface = make_surface(cases()[shape].function);
    const Judge judge(surface);
    const double reach = 6.0;  // beyond the far corner of any stencil asked for
    std::vector<Vec3f> positions;
    std::vector<Coord> cells;
    for (std::size_t v = 0; v < surface.triangulation.vertices.size(); v += 7) {
      // Up to 1 Δx away, in a direction that does not depend on the surface.
      const Vec3d away = Vec3d(std::sin(1.0 * v), std::sin(2.0 * v), std::sin(3.0 * v)).normalized();
      positions.push_back((surface.triangulation.vertices[v].cast<double>() + kDx * away).cast<float>());
      const Vec3d lattice = positions.back().cast<double>() / kDx;
      cells.push_back(Coord::floor(openvdb::Vec3d(lattice.x(), lattice.y(), lattice.z())));
    }
    for (std::size_t c = 0; c + 1 < surface.triangulation.cells.size(); ++c) {
      cells.push_back(surface.triangulation.cells[c].origin);
    }
    const SignedDistanceField field = DistanceFields(surface).at_stencils(positions, reach * kDx);
    for (const Coord& cell : cells) {
      for (const Coord& node : stencil_of(cell)) {
        ASSERT_TRUE(field.phi->tree().isValueOn(node)) << node;
        const double value = field.phi->tree().getValue(node);
        ASSERT_NEAR(std::abs(value) / kDx, judge(node), kTolerance) << node;
        ASSERT_EQ(value < 0, cases()[shape].function(Vec3d(node.x(), node.y(), node.z()) * kDx) < 0) << node;
      }
    }
  }
}

TEST(DistanceField, LeadsFromPositionsToTheSurface) {
  const ImplicitSurface surface = make_surface(cases()[7].function);
  const Judge judge(surface);
  const DistanceFields fields(surface);
  for (const Vec3d& position : {Vec3d(1.7, 0.03, -0.1), Vec3d(-0.4, -0.5, 0.4), Vec3d(0.2, 1.1, 1.3)}) {
    const SignedDistanceField field = fields.on_ways({position.cast<float>()}, 1.2);
    Vec3d x = position / kDx;
    for (int step = 0; step < 60; ++step) {
      for (const Coord& node : stencil_of(Coord::floor(openvdb::Vec3d(x.x(), x.y(), x.z())))) {
        ASSERT_TRUE(field.phi->tree().isValueOn(node)) << node << " at step " << step;
        const double value = field.phi->tree().getValue(node);
        ASSERT_NEAR(std::abs(value) / kDx, judge(node), kTolerance) << node;
        ASSERT_EQ(value < 0, cases()[7].function(Vec3d(node.x(), node.y(), node.z()) * kDx) < 0) << node;
      }
      const Kernel::Point_3 closest = judge.closest(x);
      x += 0.35 * (Vec3d(closest.x(), closest.y(), closest.z()) - x);
    }
  }
}

TEST(DistanceField, IsAsGoodFarFromTheOrigin) {
  const double dx = 0.25;
  const Coord center(40000, -40000, 123456);
  const Vec3d middle = Vec3d(center.x(), center.y(), center.z()) * dx;
  const ImplicitSurface surface = make_surface([&](const Vec3d& x) { return sphere(x - middle, 2.5); }, dx, center);
  const Judge judge(surface);
  const SignedDistanceField field = DistanceFields(surface).around(surface.triangulation.vertices, 3 * dx);
  EXPECT_GT(field.phi->activeVoxelCount(), 1000u);
  for (auto value = field.phi->cbeginValueOn(); value; ++value) {
    ASSERT_NEAR(std::abs(*value) / dx, judge(value.getCoord()), 0.02);
  }
}

TEST(DistanceField, OfNothingIsEmpty) {
  ImplicitSurface surface;
  surface.dx = kDx;
  surface.field = openvdb::FloatGrid::create(0.0f);
  surface.triangulation = triangulate_zero_level(*surface.field, kDx);
  EXPECT_TRUE(DistanceFields(surface).everywhere(1.0).phi->empty());
  EXPECT_TRUE(DistanceFields(surface).around({Vec3f::Zero()}, 1.0).phi->empty());
  EXPECT_TRUE(DistanceFields(surface).on_ways({Vec3f::Zero()}, 1.0).phi->empty());
  const ImplicitSurface ball = make_surface(cases()[0].function);
  EXPECT_TRUE(DistanceFields(ball).around({}, 1.0).phi->empty());
  EXPECT_TRUE(DistanceFields(ball).on_ways({Vec3f(90, 0, 0)}, 1.0).phi->empty());
}

void expect_same_bytes(const std::vector<SignedDistanceField>& results) {
  for (const SignedDistanceField& result : results) {
    EXPECT_TRUE(result.phi->tree().hasSameTopology(results[0].phi->tree()));
    for (auto value = result.phi->cbeginValueOn(); value; ++value) {
      ASSERT_EQ(*value, results[0].phi->tree().getValue(value.getCoord()));
    }
  }
}

TEST(DistanceField, ThreadsDoNotChangeIt) {
  const ImplicitSurface surface = make_surface(cases()[8].function);
  std::vector<SignedDistanceField> results;
  for (const int threads : {1, 2, 4}) {
    tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    results.push_back(DistanceFields(surface).around(surface.triangulation.vertices, 0.4));
  }
  expect_same_bytes(results);
}

TEST(DistanceField, InstructionSetsDoNotChangeIt) {
  const ImplicitSurface surface = make_surface(cases()[8].function);
  std::vector<SignedDistanceField> results;
  for (const InstructionSet set : {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (!is_supported(set)) continue;
    const ForcedInstructionSet forced(set);
    results.push_back(DistanceFields(surface).everywhere(0.5));
  }
  expect_same_bytes(results);
}

}  // namespace
}  // namespace particle_surface_tracker
