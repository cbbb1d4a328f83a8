#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "particle_surface_tracker/stages/upkeep.h"
#include "support/shapes.h"
#include "upkeep_support.h"

namespace {
std::size_t allocations = 0;
}  // namespace

// What everything else is allocated with has nothing but malloc() below it.
// NOLINTBEGIN(cppcoreguidelines-no-malloc)
// Not inlined: the compiler would take one without the other for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
// NOLINTEND(cppcoreguidelines-no-malloc)

namespace particle_surface_tracker {
namespace {

TEST(UpkeepAtRest, LeavesAMeshAtRestAloneBitForBit) {
  TriangleMesh mesh = test::detailed_mesh();
  const Parameters parameters = test::parameters_for_cells_of(0.05);
  note_birth(mesh);
  const TriangleMesh before = mesh;
  for (int n = 0; n < 3; ++n) EXPECT_FALSE(keep_up(mesh, parameters).has_changes());
  test::expect_same_bits(mesh, before);
}

TEST(UpkeepAtRest, LeavesNeedlesCapsFoldsAndTinyTrianglesOfBirthAlone) {
  // All limits are far beyond what this mesh has, but it was born so.
  TriangleMesh mesh =
      test::joined({test::make_box({0, 0, 0}, {1, 0.001, 1}), test::make_torus({3, 0, 0}, 1, 0.01, 8, 40),
                    test::make_sphere({0, 3, 0}, 1e-4, 4), test::make_tetrahedron(50.0)});
  test::move_vertices(mesh, [](const Vec3d& x) { return Vec3d(x.x(), 0.02 * x.y(), x.z() + 30.0 * x.x()); });
  ASSERT_LT(test::shape_of(mesh).smallest_angle, 0.01);
  ASSERT_GT(test::shape_of(mesh).largest_fold, 178.0);
  const TriangleMesh before = mesh;
  const UpkeepReport report = keep_up(mesh, test::parameters_for_cells_of(0.5));
  EXPECT_FALSE(report.has_changes());
  EXPECT_EQ(report.refused, 0U);
  EXPECT_EQ(mesh.positions(), before.positions());
  EXPECT_EQ(mesh.triangles(), before.triangles());
}

TEST(UpkeepAtRest, AllocatesNothingWhenThereIsNothingToDo) {
  TriangleMesh mesh = test::detailed_mesh();
  const Parameters parameters = test::parameters_for_cells_of(0.05);
  UpkeepMemory memory;
  keep_up(mesh, parameters, memory);
  const std::size_t before = allocations;
  keep_up(mesh, parameters, memory);
  EXPECT_EQ(allocations, before);
}

}  // namespace
}  // namespace particle_surface_tracker
