#include <string>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mesh_reader_support.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string to_stl(const TriangleMesh& mesh) {
  std::string text = "solid shape\n";
  for (const Triangle& t : mesh.triangles()) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : t) {
      const Vec3f& p = mesh.positions()[v];
      text += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
    }
    text += "endloop\nendfacet\n";
  }
  return text + "endsolid shape\n";
}

TEST(ReadStl, MergesCorners) {
  const TriangleMesh sphere = test::make_sphere({0.1, 0.2, 0.3}, 1.0, 3);
  const LoadedMesh loaded = test::load("mesh.stl", to_stl(sphere));
  EXPECT_EQ(loaded.mesh.vertex_count(), sphere.vertex_count());
  EXPECT_EQ(loaded.mesh.triangle_count(), sphere.triangle_count());
  EXPECT_NEAR(test::volume_of(loaded.mesh), test::volume_of(sphere), 1e-6);
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("merged"));
}

TEST(ReadStl, ReadsBinary) {
  const TriangleMesh box = test::make_box({-1, 0, 0}, {1, 1, 1});
  std::string content(80, ' ');
  const auto append = [&content](const auto& value) {
    content.append(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  append(static_cast<std::uint32_t>(box.triangle_count()));
  for (const Triangle& t : box.triangles()) {
    content.append(12, '\0');
    for (const std::uint32_t v : t) {
      for (const float coordinate : box.positions()[v]) append(coordinate);
    }
    content.append(2, '\0');
  }
  const LoadedMesh loaded = test::load("mesh.stl", content);
  EXPECT_EQ(loaded.mesh.vertex_count(), 8U);
  EXPECT_DOUBLE_EQ(test::volume_of(loaded.mesh), 2.0);
  EXPECT_THROW(test::load("mesh.stl", content.substr(0, content.size() - 30)), Error);
}

TEST(Merging, MinusZeroIsZero) {
  TriangleMesh box = test::make_box({0, 0, 0}, {1, 1, 1});
  std::string text;
  std::size_t corners = 0;
  for (const Triangle& t : box.triangles()) {
    for (const std::uint32_t v : t) {
      const Vec3f& p = box.positions()[v];
      text += fmt::format("v {} {} {}\n", p.x(), p.y(),
                          p.z() == 0.0F && corners % 2 == 1 ? "-0" : fmt::format("{}", p.z()));
      ++corners;
    }
    text += "f -3 -2 -1\n";
  }
  const LoadedMesh loaded = test::load("mesh.obj", text);
  EXPECT_EQ(loaded.mesh.vertex_count(), 8U);
  EXPECT_DOUBLE_EQ(test::volume_of(loaded.mesh), 1.0);
}

TEST(Merging, PartsThatTouchInAPointStayApart) {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = test::joined({test::make_box({0, 0, 0}, {1, 1, 1}), test::make_box({1, 1, 1}, {2, 2, 2})});
  write_obj((folder / "mesh.obj"), mesh);
  const LoadedMesh loaded = read_initial_mesh((folder / "mesh.obj"));
  EXPECT_EQ(loaded.mesh.vertex_count(), 16U);
  EXPECT_THAT(loaded.warnings, IsEmpty());
}

TEST(Merging, DropsTrianglesThatBecomeDegenerate) {
  // A tetrahedron whose first corner is doubled, with a sliver of no area between the two.
  const LoadedMesh loaded = test::load("mesh.obj",
                                       "v 0 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                       "f 1 4 3\nf 2 3 5\nf 3 4 5\nf 1 5 4\nf 1 3 2\n");
  EXPECT_EQ(loaded.mesh.vertex_count(), 4U);
  EXPECT_EQ(loaded.mesh.triangle_count(), 4U);
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("merged 1 of 5"), HasSubstr("dropped 1 degenerate")));
}

}  // namespace
}  // namespace particle_surface_tracker
