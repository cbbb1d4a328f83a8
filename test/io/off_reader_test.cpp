#include <cmath>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_reader_support.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_measures.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(ReadOff, CutsPolygonsIntoTriangles) {
  const LoadedMesh loaded = test::load("mesh.off", test::kCubeOff);
  EXPECT_THAT(loaded.warnings, IsEmpty());
  EXPECT_EQ(loaded.mesh.vertex_count(), 8U);
  EXPECT_EQ(loaded.mesh.triangle_count(), 12U);
  EXPECT_DOUBLE_EQ(test::volume_of(loaded.mesh), 1.0);
}

TEST(ReadOff, ReadsColours) {
  const LoadedMesh loaded =
      test::load("mesh.off",
                 "COFF 4 4 6\n0 0 0 255 0 0 255\n1 0 0 0 51 0 255\n0 1 0 0.5 0.25 0 1\n0 0 1 0 0 0 0\n"
                 "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  EXPECT_THAT(test::values_of(loaded.mesh, TriangleMesh::color_name),
              ElementsAre(1, 0, 0, 1, 0, 0.2F, 0, 1, 0.5F, 0.25F, 0, 1, 0, 0, 0, 0));
}

TEST(ReadOff, EveryTruncationIsAnError) {
  const test::TemporaryFolder folder;
  const std::string whole = test::kCubeOff;
  for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
    EXPECT_THROW(read_initial_mesh(folder.write("cut.off", whole.substr(0, size))), Error) << size;
  }
}

TEST(Triangulation, AConcavePolygonKeepsItsArea) {
  // A prism over an arrowhead: a fan around the wrong corner would leave the polygon.
  const LoadedMesh loaded = test::load("mesh.off",
                                       "OFF\n8 6 0\n2 0 0\n0 1 0\n-2 0 0\n0 3 0\n2 0 1\n0 1 1\n-2 0 1\n0 3 1\n"
                                       "4 0 1 2 3\n4 7 6 5 4\n4 0 4 5 1\n4 1 5 6 2\n4 2 6 7 3\n4 3 7 4 0\n");
  const MeshMeasures measures = measure_mesh(loaded.mesh.positions(), loaded.mesh.triangles());
  EXPECT_DOUBLE_EQ(measures.volume, 4.0);
  EXPECT_NEAR(measures.area, 2 * 4.0 + 2 * std::sqrt(5.0) + 2 * std::sqrt(13.0), 1e-12);
}

}  // namespace
}  // namespace particle_surface_tracker
