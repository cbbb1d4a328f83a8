#include "particle_surface_tracker/io/mesh_reader.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

LoadedMesh load(const std::string& name, const std::string& content) {
  const test::TemporaryFolder folder;
  return read_initial_mesh(folder.write(name, content));
}

template <typename Error>
std::string error_of(const std::string& name, const std::string& content) {
  try {
    load(name, content);
  } catch (const Error& error) {
    return error.what();
  }
  ADD_FAILURE() << name << " was accepted";
  return "";
}

double volume_of(const TriangleMesh& mesh) {
  return measure_mesh(mesh.positions(), mesh.triangles()).volume;
}

const std::vector<float>& values_of(const TriangleMesh& mesh, const char* name) {
  return mesh.attributes()[mesh.attributes().find(name)].values;
}

constexpr const char* kTetrahedronObj =
    "# a comment\nmtllib none.mtl\no thing\n"
    "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
    "f 2 4 3\nf 2/1/1 3//2 5\nusemtl other\nf -3 -2 -1\nf 2 5 4\n";

constexpr const char* kCubeOff =
    "OFF\n# comment\n8 6 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\n"
    "4 0 3 2 1\n4 4 5 6 7 255 0 0\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n";

constexpr const char* kTetrahedronPly =
    "ply\nformat ascii 1.0\ncomment of no meaning\nelement vertex 4\n"
    "property double x\nproperty float y\nproperty float z\nproperty float delta\nproperty uint id\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty float u\nproperty float v\n"
    "element face 4\nproperty uchar flag\nproperty list uchar int vertex_index\n"
    "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n"
    "0 0 0 0.5 7 255 0 0 0 0\n1 0 0 -0.5 8 0 255 0 1 0\n0 1 0 0.5 9 0 0 51 0 1\n0 0 1 0.5 10 255 255 255 1 0.5\n"
    "1 3 0 2 1\n0 3 0 1 3\n0 3 1 2 3\n0 3 2 0 3\n0 1\n";

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

TEST(ReadPly, ReadsAsciiWithColoursTextureAndUnknownProperties) {
  const LoadedMesh loaded = load("mesh.ply", kTetrahedronPly);
  EXPECT_THAT(loaded.warnings, IsEmpty());
  EXPECT_THAT(loaded.mesh.positions(), ElementsAre(Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)));
  EXPECT_THAT(loaded.mesh.triangles(),
              ElementsAre(Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}));
  EXPECT_THAT(values_of(loaded.mesh, TriangleMesh::color_name),
              ElementsAre(1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0.2F, 1, 1, 1, 1, 1));
  EXPECT_THAT(values_of(loaded.mesh, TriangleMesh::texcoord_name), ElementsAre(0, 0, 1, 0, 0, 1, 1, 0.5F));
  EXPECT_THAT(loaded.mesh.ids(), ElementsAre(0, 1, 2, 3));
  EXPECT_THAT(loaded.mesh.delta(), ElementsAre(0, 0, 0, 0));
}

TEST(ReadPly, ReadsBigEndian) {
  std::string content =
      "ply\nformat binary_big_endian 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 4\nproperty list uchar ushort vertex_indices\nend_header\n";
  const std::string zero(4, '\0'), one("\x3f\x80\x00\x00", 4);
  content += zero + zero + zero + one + zero + zero + zero + one + zero + zero + zero + one;
  for (const char* face : {"021", "013", "123", "203"}) {
    content += '\3';
    for (const char* digit = face; *digit != 0; ++digit) content += {'\0', static_cast<char>(*digit - '0')};
  }
  EXPECT_EQ(load("mesh.ply", content).mesh.positions(), load("mesh.ply", kTetrahedronPly).mesh.positions());
}

TEST(ReadPly, EveryTruncationIsAnInputError) {
  const test::TemporaryFolder folder;
  write_ply((folder / "whole.ply"), test::make_box({0, 0, 0}, {1, 1, 1}));
  std::ifstream file((folder / "whole.ply"), std::ios::binary);
  const std::string binary{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t size = 0; size < binary.size(); ++size) {
    EXPECT_THROW(read_initial_mesh(folder.write("cut.ply", binary.substr(0, size))), InputError) << size;
  }
  const std::string ascii = kTetrahedronPly;
  // Without the last line end the file is still whole.
  for (std::size_t size = 0; size + 2 < ascii.size(); ++size) {
    EXPECT_THROW(read_initial_mesh(folder.write("cut.ply", ascii.substr(0, size))), InputError) << size;
  }
}

TEST(ReadPly, DamagedHeadersAreInputErrors) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string content = kTetrahedronPly;
    return content.replace(content.find(from), from.size(), to);
  };
  EXPECT_THAT(error_of<InputError>("a.ply", with("vertex 4", "vertex 4000000000")), HasSubstr("ends early"));
  EXPECT_THAT(error_of<InputError>("a.ply", with("vertex 4", "vertex -4")), HasSubstr("-4"));
  EXPECT_THAT(error_of<InputError>("a.ply", with("ascii", "roman")), HasSubstr("roman"));
  EXPECT_THAT(error_of<InputError>("a.ply", with("property double x", "property quad x")), HasSubstr("quad"));
  EXPECT_THAT(error_of<InputError>("a.ply", with("property double x", "property double w")), HasSubstr("x, y or z"));
  EXPECT_THAT(error_of<InputError>("a.ply", with("3 0 2 1", "3 0 2 4")), HasSubstr("face 0"));
  EXPECT_THAT(error_of<InputError>("a.ply", with("3 0 2 1", "3 0 2 -1")), HasSubstr("face 0"));
  EXPECT_THAT(error_of<InputError>("a.ply", with("0.5 7", "half 7")), HasSubstr("'half'"));
}

TEST(ReadObj, ReadsIndicesOfAllKindsInTheOrderOfTheFile) {
  const LoadedMesh loaded = load("mesh.obj", std::string("vt 0.5 0.25\n") + kTetrahedronObj);
  EXPECT_THAT(loaded.mesh.positions(), ElementsAre(Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)));
  EXPECT_THAT(loaded.mesh.triangles(),
              ElementsAre(Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{0, 3, 2}));
  EXPECT_THAT(values_of(loaded.mesh, TriangleMesh::texcoord_name), ElementsAre(0.5F, 0.25F, 0, 0, 0, 0, 0, 0));
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("dropped 1 vertices"));
}

TEST(ReadObj, RoundsNumbersToTheNearestFloat) {
  const LoadedMesh loaded = load("mesh.obj",
                                 "v 1.17549435e-38 -3.40282347e+38 +7.0064923e-46\nv 1 0 0\nv 0 1 0\nv 0.1 1e-50 1E0\n"
                                 "f 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n");
  using Limits = std::numeric_limits<float>;
  EXPECT_EQ(loaded.mesh.positions()[0], Vec3f(Limits::min(), -Limits::max(), 0.0F));
  EXPECT_EQ(loaded.mesh.positions()[3], Vec3f(0.1F, 0.0F, 1.0F));
}

TEST(ReadObj, WarnsOfTextureSeams) {
  const LoadedMesh loaded = load("mesh.obj",
                                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 1 1\nvt 0.5 0.5\n"
                                 "f 1/1 3/1 2/1\nf 1/2 2/1 4/3\nf 2/3 3/1 4/3\nf 3/1 1/1 4/3\n");
  ASSERT_EQ(loaded.warnings.size(), 1U);
  EXPECT_THAT(loaded.warnings[0], HasSubstr("2 vertices on texture seams"));
  EXPECT_THAT(values_of(loaded.mesh, TriangleMesh::texcoord_name), ElementsAre(0, 0, 0, 0, 0, 0, 0.5F, 0.5F));
}

TEST(ReadObj, BadFacesAreInputErrors) {
  EXPECT_THAT(error_of<InputError>("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
              AllOf(HasSubstr("line 4"), HasSubstr("vertex 9")));
  EXPECT_THAT(error_of<InputError>("a.obj", "v 0 0 0\nf 0 0 0\n"), HasSubstr("line 2"));
  EXPECT_THAT(error_of<InputError>("a.obj", "v 0 0\n"), HasSubstr("line 1"));
  EXPECT_THAT(error_of<InputError>("a.obj", "v 0 0 1e99\n"), HasSubstr("1e99"));
  EXPECT_THAT(error_of<InputError>("a.obj", "v 0 0 0\n"), HasSubstr("no triangles"));
}

TEST(ReadOff, CutsPolygonsIntoTriangles) {
  const LoadedMesh loaded = load("mesh.off", kCubeOff);
  EXPECT_THAT(loaded.warnings, IsEmpty());
  EXPECT_EQ(loaded.mesh.vertex_count(), 8U);
  EXPECT_EQ(loaded.mesh.triangle_count(), 12U);
  EXPECT_DOUBLE_EQ(volume_of(loaded.mesh), 1.0);
}

TEST(ReadOff, ReadsColours) {
  const LoadedMesh loaded = load("mesh.off",
                                 "COFF 4 4 6\n0 0 0 255 0 0 255\n1 0 0 0 51 0 255\n0 1 0 0.5 0.25 0 1\n0 0 1 0 0 0 0\n"
                                 "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n");
  EXPECT_THAT(values_of(loaded.mesh, TriangleMesh::color_name),
              ElementsAre(1, 0, 0, 1, 0, 0.2F, 0, 1, 0.5F, 0.25F, 0, 1, 0, 0, 0, 0));
}

TEST(ReadOff, EveryTruncationIsAnError) {
  const test::TemporaryFolder folder;
  const std::string whole = kCubeOff;
  for (std::size_t size = 0; size + 2 < whole.size(); ++size) {
    EXPECT_THROW(read_initial_mesh(folder.write("cut.off", whole.substr(0, size))), Error) << size;
  }
}

TEST(Triangulation, AConcavePolygonKeepsItsArea) {
  // A prism over an arrowhead: a fan around the wrong corner would leave the polygon.
  const LoadedMesh loaded = load("mesh.off",
                                 "OFF\n8 6 0\n2 0 0\n0 1 0\n-2 0 0\n0 3 0\n2 0 1\n0 1 1\n-2 0 1\n0 3 1\n"
                                 "4 0 1 2 3\n4 7 6 5 4\n4 0 4 5 1\n4 1 5 6 2\n4 2 6 7 3\n4 3 7 4 0\n");
  const MeshMeasures measures = measure_mesh(loaded.mesh.positions(), loaded.mesh.triangles());
  EXPECT_DOUBLE_EQ(measures.volume, 4.0);
  EXPECT_NEAR(measures.area, 2 * 4.0 + 2 * std::sqrt(5.0) + 2 * std::sqrt(13.0), 1e-12);
}

TEST(ReadStl, MergesCorners) {
  const TriangleMesh sphere = test::make_sphere({0.1, 0.2, 0.3}, 1.0, 3);
  const LoadedMesh loaded = load("mesh.stl", to_stl(sphere));
  EXPECT_EQ(loaded.mesh.vertex_count(), sphere.vertex_count());
  EXPECT_EQ(loaded.mesh.triangle_count(), sphere.triangle_count());
  EXPECT_NEAR(volume_of(loaded.mesh), volume_of(sphere), 1e-6);
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
  const LoadedMesh loaded = load("mesh.stl", content);
  EXPECT_EQ(loaded.mesh.vertex_count(), 8U);
  EXPECT_DOUBLE_EQ(volume_of(loaded.mesh), 2.0);
  EXPECT_THROW(load("mesh.stl", content.substr(0, content.size() - 30)), Error);
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
  const LoadedMesh loaded = load("mesh.obj", text);
  EXPECT_EQ(loaded.mesh.vertex_count(), 8U);
  EXPECT_DOUBLE_EQ(volume_of(loaded.mesh), 1.0);
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
  const LoadedMesh loaded = load("mesh.obj",
                                 "v 0 0 0\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                                 "f 1 4 3\nf 2 3 5\nf 3 4 5\nf 1 5 4\nf 1 3 2\n");
  EXPECT_EQ(loaded.mesh.vertex_count(), 4U);
  EXPECT_EQ(loaded.mesh.triangle_count(), 4U);
  EXPECT_THAT(loaded.warnings, ElementsAre(HasSubstr("merged 1 of 5"), HasSubstr("dropped 1 degenerate")));
}

TEST(ReadInitialMesh, TurnsAMeshThatIsInsideOut) {
  const test::TemporaryFolder folder;
  write_ply((folder / "mesh.ply"), test::turned(test::make_box({0, 0, 0}, {1, 1, 1})));
  const LoadedMesh loaded = read_initial_mesh((folder / "mesh.ply"));
  EXPECT_DOUBLE_EQ(volume_of(loaded.mesh), 1.0);
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
  EXPECT_THAT(error_of<InputError>("empty.ply", ""), HasSubstr("empty"));
  for (const char* name : {"a.ply", "a.obj", "a.off", "a.stl", "a.txt", "a"}) {
    EXPECT_THAT(error_of<InputError>(name, "This is a letter,\nnot a mesh.\n"), HasSubstr(name));
  }
  // OBJ is known by its extension alone; PLY and OFF by their content whatever the name.
  error_of<InputError>("mesh.ply", kTetrahedronObj);
  EXPECT_EQ(load("mesh.obj", kTetrahedronPly).mesh.vertex_count(), 4U);
  EXPECT_EQ(load("mesh", kCubeOff).mesh.vertex_count(), 8U);
  EXPECT_EQ(load("MESH.OBJ", std::string("vt 0 0\n") + kTetrahedronObj).mesh.vertex_count(), 4U);
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
