// Bodies pushed through each other, in chosen unlucky positions and at random, against their exact union. The seeds are
// printed; PST_FIRST_SEED and PST_CASES choose others than those that always run.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <tbb/global_control.h>
#include <Eigen/Geometry>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/stages/remeshing.h"
#include "sequences/mesh_judge.h"
#include "sequences/solid_judge.h"
#include "support/shapes.h"
#include "support/torture_meshes.h"
#include "union_reference.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;
using test::TortureMesh;

/// The bounds c of the distances c · h [h], and of the volume c · h · A, A being the area of the union.
constexpr double kFarFromUnion = 2.0;
constexpr double kFarFromMesh = 2.0;
constexpr double kFarFromMeshNearby = 3.5;  // 2√3: nodes of both sides are no farther.
constexpr double kVolume = 0.25;

/// New vertices are smoothed within the surface by at most this, and those at the front kept apart [h].
constexpr double kSmoothing = 0.41;

std::uint32_t number_from_environment(const char* name, std::uint32_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : static_cast<std::uint32_t>(std::stoul(text));
}

/// Largest values over many cases.
struct Worst {
  double from_union = 0.0;        ///< A sample of the result to the union [h].
  double from_mesh = 0.0;         ///< A sample of the union in a cell with nodes on both sides to the result [h].
  double from_mesh_nearby = 0.0;  ///< The same in cells that have nodes on both sides up to distance 1 around them.
  double volume = 0.0;            ///< Difference of the volumes [h · A].
  std::size_t changed = 0;
  std::size_t cases = 0;
};

struct Result {
  TriangleMesh mesh;
  RemeshingReport report;
  TopologyCells cells;
};

Result united(const TortureMesh& torture) {
  Result result;
  result.mesh = torture.mesh;
  const MeshLattice lattice(torture.mesh.positions(), torture.mesh.triangles(), torture.h);
  result.report = remesh(result.mesh, lattice, {}, &result.cells);
  return result;
}

/// True if nodes at distance up to `around` from the corners of the cell of a point are on both sides.
bool is_seen(const MeshLattice& lattice, const Vec3d& point, int around) {
  Coord cell;
  for (int axis = 0; axis < 3; ++axis) cell[axis] = static_cast<int>(std::floor(point[axis] / lattice.h()));
  bool is_inside = false, is_outside = false;
  const openvdb::CoordBBox nodes(cell.offsetBy(-around), cell.offsetBy(1 + around));
  for (auto node = nodes.begin(); node; ++node) {
    const bool inside = lattice.winding_number(*node) >= 1;
    is_inside = is_inside || inside;
    is_outside = is_outside || !inside;
  }
  return is_inside && is_outside;
}

/// True if a marked cell meets a box that is widened by some margin [m].
bool meets_marked(const std::vector<Coord>& marked, double h, const Eigen::AlignedBox3d& box, double margin) {
  Coord lower, upper;
  for (int axis = 0; axis < 3; ++axis) {
    lower[axis] = static_cast<int>(std::floor((box.min()[axis] - margin) / h));
    upper[axis] = static_cast<int>(std::floor((box.max()[axis] + margin) / h));
  }
  const openvdb::CoordBBox cells(lower, upper);
  for (auto cell = cells.begin(); cell; ++cell) {
    if (std::binary_search(marked.begin(), marked.end(), *cell)) return true;
  }
  return false;
}

/// What is kept keeps its bits. New vertices lie in marked cells or, after smoothing, beside them.
void expect_vertices_in_marked_cells(const TortureMesh& torture, const Result& result) {
  const double margin = kSmoothing * torture.h + 2e-7 * torture.mesh.positions().front().norm();
  for (std::uint32_t v = 0; v < result.mesh.vertex_count(); ++v) {
    const Vec3f& place = result.mesh.positions()[v];
    const std::uint32_t id = result.mesh.ids()[v];
    if (id < torture.mesh.vertex_count()) {
      ASSERT_EQ(place, torture.mesh.positions()[id]);
    } else {
      const Eigen::AlignedBox3d box(place.cast<double>());
      ASSERT_TRUE(meets_marked(result.cells.marked, torture.h, box, margin)) << place.transpose();
    }
  }
}

/// Triangles go in marked cells, or with the whole of a component.
void expect_triangles_kept_elsewhere(const TortureMesh& torture, const Result& result) {
  const std::vector<std::uint32_t>& ids = result.mesh.ids();
  std::set<Triangle> kept;
  for (const Triangle& t : result.mesh.triangles()) {
    kept.insert({ids[t[0]], ids[t[1]], ids[t[2]]});
  }
  const auto [component, count] = *torture.mesh.components();
  std::vector<char> lives(count, 0);
  for (const std::uint32_t id : ids) {
    if (id < torture.mesh.vertex_count()) lives[component[id]] = 1;
  }
  for (const Triangle& t : torture.mesh.triangles()) {
    if (kept.count(t) > 0 || lives[component[t[0]]] == 0) continue;
    Eigen::AlignedBox3d box;
    for (const std::uint32_t v : t) box.extend(torture.mesh.positions()[v].cast<double>());
    ASSERT_TRUE(meets_marked(result.cells.marked, torture.h, box, 1e-6 * torture.h))
        << t[0] << " " << t[1] << " " << t[2];
  }
}

void expect_near_union(const TortureMesh& torture, const Result& result, Worst& worst) {
  const double h = torture.h;
  const TriangleMesh& mesh = result.mesh;
  // Sides are asked close to a triangle, for sheets can be thin.
  const double offset = 0.002 * h;
  const test::UnionReference reference(torture.mesh, 0.5 * h, offset);
  double from_union = 0.0;
  test::for_samples_of(mesh.positions(), mesh.triangles(), h, 1, [&](const Vec3d& point, const Vec3d&, double) {
    from_union = std::max(from_union, reference.distance(point) / h);
  });
  double from_mesh = 0.0, from_mesh_nearby = 0.0;
  if (!mesh.triangles().empty()) {
    const MeshLattice lattice(torture.mesh.positions(), torture.mesh.triangles(), h);
    const test::SolidJudge judge(mesh.positions(), mesh.triangles());
    for (const Vec3d& point : reference.samples()) {
      if (!is_seen(lattice, point, 1)) continue;
      const double distance = judge.distance(point) / h;
      from_mesh_nearby = std::max(from_mesh_nearby, distance);
      if (is_seen(lattice, point, 0)) from_mesh = std::max(from_mesh, distance);
    }
  }
  constexpr int kLines = 200;
  const double expected = test::covered_volume(torture.mesh.positions(), torture.mesh.triangles(), kLines);
  const double volume = test::covered_volume(mesh.positions(), mesh.triangles(), kLines);
  // Where nothing is left there is nothing to divide by; then the volume must have been that of specks.
  const double off = std::abs(volume - expected) / (h * std::max(reference.area(), h * h));
  EXPECT_LE(from_union, kFarFromUnion);
  EXPECT_LE(from_mesh, kFarFromMesh);
  EXPECT_LE(from_mesh_nearby, kFarFromMeshNearby);
  EXPECT_LE(off, kVolume);
  worst.from_union = std::max(worst.from_union, from_union);
  worst.from_mesh = std::max(worst.from_mesh, from_mesh);
  worst.from_mesh_nearby = std::max(worst.from_mesh_nearby, from_mesh_nearby);
  worst.volume = std::max(worst.volume, off);
}

void judge(const TortureMesh& torture, Worst& worst) {
  SCOPED_TRACE(torture.name + ", h = " + std::to_string(torture.h));
  const Result result = united(torture);
  EXPECT_FALSE(result.report.gave_up);
  EXPECT_EQ(result.report.fallbacks, 0u);
  EXPECT_TRUE(test::find_surface_defects(result.mesh.vertex_count(), result.mesh.triangles()).none());
  expect_vertices_in_marked_cells(torture, result);
  expect_triangles_kept_elsewhere(torture, result);
  expect_near_union(torture, result, worst);
  ++worst.cases;
  worst.changed += result.report.changed() ? 1 : 0;
}

TortureMesh at_size(TortureMesh torture, double factor) {
  torture.h *= factor;
  return torture;
}

void print(const Worst& worst) {
  std::printf(
      "%zu cases, %zu changed; at most %.2f h from the union, %.2f h from the mesh (%.2f h where Γ is seen in the "
      "next cell only), %.3f h·A of volume\n",
      worst.cases, worst.changed, worst.from_union, worst.from_mesh, worst.from_mesh_nearby, worst.volume);
}

TEST(RemeshingUnion, OfBodiesInUnluckyPositions) {
  Worst worst;
  for (const TortureMesh& torture : test::chosen_torture_meshes()) {
    for (const double factor : {2.0, 1.0, 0.5}) judge(at_size(torture, factor), worst);
  }
  print(worst);
}

TortureMesh random_case(std::uint32_t seed) {
  constexpr double kFactors[] = {2.0, 1.0, 0.5};
  return at_size(test::make_torture_mesh(seed), kFactors[seed / 2 % 3]);
}

TEST(RemeshingUnion, OfRandomBodiesThatOnceFailed) {
  Worst worst;
  // The middle of a fan was smoothed first and then moved inside its loop, by the farthest that is allowed each time.
  judge(random_case(5765), worst);
  // These failed for the reference alone, which saw no part of a small triangle, and no sheet thinner than 0.016 h.
  for (const std::uint32_t seed : {5848U, 5903U}) judge(random_case(seed), worst);
}

TEST(RemeshingUnion, OfRandomBodies) {
  const std::uint32_t first = number_from_environment("PST_FIRST_SEED", 0);
  const std::uint32_t cases = number_from_environment("PST_CASES", 20);
  std::printf("seeds %u to %u\n", first, first + cases - 1);
  Worst worst;
  for (std::uint32_t seed = first; seed < first + cases; ++seed) {
    judge(random_case(seed), worst);
  }
  print(worst);
  EXPECT_GT(worst.changed, cases / 2);
}

TEST(RemeshingUnion, IsTheSameForAnyNumberOfThreadsAndAgain) {
  for (std::uint32_t seed = 0; seed < 20; ++seed) {
    const TortureMesh torture = test::make_torture_mesh(seed);
    SCOPED_TRACE(torture.name);
    const Result parallel = united(torture);
    const Result again = united(torture);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    const Result serial = united(torture);
    for (const Result* other : {&again, &serial}) {
      EXPECT_EQ(parallel.mesh.positions(), other->mesh.positions());
      EXPECT_EQ(parallel.mesh.triangles(), other->mesh.triangles());
      EXPECT_EQ(parallel.mesh.ids(), other->mesh.ids());
      EXPECT_EQ(parallel.cells.marked, other->cells.marked);
    }
  }
}

}  // namespace
}  // namespace particle_surface_tracker
