#include "particle_surface_tracker/io/raw_mesh_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

RawMesh read(const std::string& name, const std::string& content) {
  const test::TemporaryFolder folder;
  return read_raw_mesh(folder.write(name, content));
}

TEST(ReadRawMesh, KeepsWhatTheFileHas) {
  const RawMesh mesh = read("mesh.off", "OFF 5 3 0\n0 0 0\n1 0 0\n0 1 0\n0 1 0\n9 9 9\n3 2 1 0\n3 0 1 1\n3 0 1 7\n");
  EXPECT_EQ(mesh.positions.size(), 5U);
  EXPECT_EQ(mesh.positions[3], Vec3f(0, 1, 0));
  EXPECT_THAT(mesh.triangles, ElementsAre(Triangle{2, 1, 0}, Triangle{0, 1, 1}, Triangle{0, 1, 7}));
  EXPECT_TRUE(mesh.has_indices);
}

TEST(ReadRawMesh, CutsPolygonsAndKeepsSmallFaces) {
  const std::string vertices = "OFF 4 3 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n";
  const RawMesh mesh = read("mesh.off", vertices + "4 0 1 2 3\n2 0 1\n1 3\n");
  EXPECT_EQ(mesh.triangles.size(), 4U);
  EXPECT_EQ(mesh.triangles[2], (Triangle{0, 1, 1}));
  EXPECT_EQ(mesh.triangles[3], (Triangle{3, 3, 3}));
  // Also where a vertex is missing.
  EXPECT_THAT(read("mesh.off", vertices + "4 0 1 9 3\n2 0 1\n1 3\n").triangles,
              ElementsAre(Triangle{0, 1, 9}, Triangle{0, 9, 3}, Triangle{0, 1, 1}, Triangle{3, 3, 3}));
}

TEST(ReadRawMesh, AcceptsAMeshWithoutTriangles) {
  EXPECT_TRUE(read("mesh.off", "OFF 1 0 0\n0 0 0\n").triangles.empty());
}

TEST(ReadRawMesh, KnowsThatStlHasNoIndices) {
  const std::string facet =
      "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  const RawMesh mesh = read("mesh.stl", "solid a\n" + facet + facet + "endsolid a\n");
  EXPECT_FALSE(mesh.has_indices);
  EXPECT_EQ(mesh.positions.size(), 6U);
  EXPECT_EQ(mesh.triangles.size(), 2U);
}

TEST(ReadRawMesh, DamagedFilesAreInputErrors) {
  const auto expect_error = [](const std::string& name, const std::string& content) {
    try {
      read(name, content);
      FAIL() << "accepted: " << content;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
    }
  };
  expect_error("empty.ply", "");
  expect_error("words.txt", "no mesh");
  expect_error("short.off", "OFF 4 1 0\n0 0 0\n");
  EXPECT_THROW(read_raw_mesh("/not/there.ply"), InputError);
}

}  // namespace
}  // namespace particle_surface_tracker
