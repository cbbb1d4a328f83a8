#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_reader_support.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(ReadObj, ReadsIndicesOfAllKindsInTheOrderOfTheFile) {
  const LoadedMesh loaded = test::load("mesh.obj", std::string("vt 0.5 0.25\n") + test::kTetrahedronObj);
  EXPECT_THAT(loaded.mesh.positions(), ElementsAre(Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)));
  EXPECT_THAT(loaded.mesh.triangles(),
              ElementsAre(Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{0, 3, 2}));
  EXPECT_THAT(test::values_of(loaded.mesh, TriangleMesh::texcoord_name), ElementsAre(0.5F, 0.25F, 0, 0, 0, 0, 0, 0));
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("dropped 1 vertices"));
}

TEST(ReadObj, RoundsNumbersToTheNearestFloat) {
  const LoadedMesh loaded =
      test::load("mesh.obj",
                 "v 1.17549435e-38 -3.40282347e+38 +7.0064923e-46\nv 1 0 0\nv 0 1 0\nv 0.1 1e-50 1E0\n"
                 "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  using Limits = std::numeric_limits<float>;
  EXPECT_EQ(loaded.mesh.positions()[0], Vec3f(Limits::min(), -Limits::max(), 0.0F));
  EXPECT_EQ(loaded.mesh.positions()[3], Vec3f(0.1F, 0.0F, 1.0F));
}

TEST(ReadObj, WarnsOfTextureSeams) {
  const LoadedMesh loaded = test::load("mesh.obj",
                                       "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 1\nvt 0.5 0.5\n"
                                       "f 1/1 3/1 2/1\nf 1/2 2/1 4/3\nf 2/3 3/1 4/3\nf 3/1 1/1 4/3\n");
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("2 vertices on texture seams"));
  EXPECT_THAT(test::values_of(loaded.mesh, TriangleMesh::texcoord_name), ElementsAre(0, 0, 0, 0, 0, 0, 0.5F, 0.5F));
}

TEST(ReadObj, BadFacesAreInputErrors) {
  EXPECT_THAT(test::error_of<InputError>("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("vertex 9")));
  EXPECT_THAT(test::error_of<InputError>("a.obj", "v 0 0 0\nf 0 0 0\n"), HasSubstr("line 2"));
  EXPECT_THAT(test::error_of<InputError>("a.obj", "v 0 0\n"), HasSubstr("line 1"));
  EXPECT_THAT(test::error_of<InputError>("a.obj", "v 0 0 1e99\n"), HasSubstr("1e99"));
  EXPECT_THAT(test::error_of<InputError>("a.obj", "v 0 0 0\n"), HasSubstr("no triangles"));
}

}  // namespace
}  // namespace particle_surface_tracker
