#include "particle_surface_tracker/io/mesh_reader.h"

#include <limits>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_reader_support.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(ReadInitialMesh, TurnsAMeshThatIsInsideOut) {
  const test::TemporaryFolder folder;
  write_ply((folder / "mesh.ply"), test::turned(test::make_box({0, 0, 0}, {1, 1, 1})));
  const LoadedMesh loaded = read_initial_mesh((folder / "mesh.ply"));
  EXPECT_DOUBLE_EQ(test::volume_of(loaded.mesh), 1.0);
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("inside out"));
}

TEST(ReadInitialMesh, BadMeshesAreMeshErrorsThatNameTheFile) {
  const test::TemporaryFolder folder;
  const TriangleMesh box = test::make_box({0, 0, 0}, {1, 1, 1});
  const auto expect = [&](const TriangleMesh& mesh, const std::string& text) {
    write_ply((folder / "bad.ply"), mesh);
    try {
      read_initial_mesh((folder / "bad.ply"));
      ADD_FAILURE() << "accepted, instead of: " << text;
    } catch (const MeshError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr((folder / "bad.ply")), HasSubstr(text)));
    }
  };
  std::vector<Triangle> triangles = box.triangles();
  triangles.pop_back();
  expect(TriangleMesh(box.positions(), triangles), "open");

  triangles = box.triangles();
  std::swap(triangles[0][0], triangles[0][1]);
  expect(TriangleMesh(box.positions(), triangles), "partly flipped");

  TriangleMesh mesh = box;
  mesh.positions()[2].x() = std::numeric_limits<float>::quiet_NaN();
  expect(mesh, "not finite");
  mesh.positions()[2].x() = std::numeric_limits<float>::infinity();
  expect(mesh, "not finite");

  triangles = box.triangles();
  triangles.push_back({0, 1, 7});
  expect(TriangleMesh(box.positions(), triangles), "non-manifold");
}

TEST(ReadInitialMesh, FilesThatAreNoMeshesAreInputErrors) {
  EXPECT_THAT(test::error_of<InputError>("empty.ply", ""), HasSubstr("empty"));
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "a.txt", "a"}) {
    EXPECT_THAT(test::error_of<InputError>(name, "This is a letter,\nnot a mesh.\n"), HasSubstr(name));
  }
  // OBJ is known by its extension alone; PLY and OFF by their content whatever the name.
  test::error_of<InputError>("mesh.ply", test::kTetrahedronObj);
  EXPECT_EQ(test::load("mesh.obj", test::kTetrahedronPly).mesh.vertex_count(), 4U);
  EXPECT_EQ(test::load("mesh", test::kCubeOff).mesh.vertex_count(), 8U);
  EXPECT_EQ(test::load("MESH.OBJ", std::string("vt 0 0\n") + test::kTetrahedronObj).mesh.vertex_count(), 4U);
}

TEST(ReadInitialMesh, MissingFilesAndFoldersAreInputErrors) {
  const test::TemporaryFolder folder;
  for (const std::string& path : {(folder / "missing.ply"), (folder / "")}) {
    try {
      read_initial_mesh(path);
      ADD_FAILURE() << path;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(path));
    }
  }
}

}  // namespace
}  // namespace particle_surface_tracker
