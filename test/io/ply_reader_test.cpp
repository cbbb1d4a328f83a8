#include <fstream>
#include <iterator>
#include <string>

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

TEST(ReadPly, ReadsAsciiWithColoursTextureAndUnknownProperties) {
  const LoadedMesh loaded = test::load("mesh.ply", test::kTetrahedronPly);
  EXPECT_THAT(loaded.warnings, IsEmpty());
  EXPECT_THAT(loaded.mesh.positions(), ElementsAre(Vec3f(0, 0, 0), Vec3f(1, 0, 0), Vec3f(0, 1, 0), Vec3f(0, 0, 1)));
  EXPECT_THAT(loaded.mesh.triangles(),
              ElementsAre(Triangle{0, 2, 1}, Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{2, 0, 3}));
  EXPECT_THAT(test::values_of(loaded.mesh, TriangleMesh::color_name),
              ElementsAre(1, 0, 0, 1, 0, 1, 0, 1, 0, 0, 0.2F, 1, 1, 1, 1, 1));
  EXPECT_THAT(test::values_of(loaded.mesh, TriangleMesh::texcoord_name), ElementsAre(0, 0, 1, 0, 0, 1, 1, 0.5F));
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
  EXPECT_EQ(test::load("mesh.ply", content).mesh.positions(),
            test::load("mesh.ply", test::kTetrahedronPly).mesh.positions());
}

TEST(ReadPly, EveryTruncationIsAnInputError) {
  const test::TemporaryFolder folder;
  write_ply((folder / "whole.ply"), test::make_box({0, 0, 0}, {1, 1, 1}));
  std::ifstream file((folder / "whole.ply"), std::ios::binary);
  const std::string binary{std::istreambuf_iterator<char>(file), {}};
  for (std::size_t size = 0; size < binary.size(); ++size) {
    EXPECT_THROW(read_initial_mesh(folder.write("cut.ply", binary.substr(0, size))), InputError) << size;
  }
  const std::string ascii = test::kTetrahedronPly;
  // Without the last line end the file is still whole.
  for (std::size_t size = 0; size + 2 < ascii.size(); ++size) {
    EXPECT_THROW(read_initial_mesh(folder.write("cut.ply", ascii.substr(0, size))), InputError) << size;
  }
}

TEST(ReadPly, DamagedHeadersAreInputErrors) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string content = test::kTetrahedronPly;
    return content.replace(content.find(from), from.size(), to);
  };
  EXPECT_THAT(test::error_of<InputError>("a.ply", with("vertex 4", "vertex 4000000000")), HasSubstr("ends early"));
  EXPECT_THAT(test::error_of<InputError>("a.ply", with("vertex 4", "vertex -4")), HasSubstr("-4"));
  EXPECT_THAT(test::error_of<InputError>("a.ply", with("ascii", "roman")), HasSubstr("roman"));
  EXPECT_THAT(test::error_of<InputError>("a.ply", with("property double x", "property quad x")), HasSubstr("quad"));
  EXPECT_THAT(test::error_of<InputError>("a.ply", with("property double x", "property double w")),
              HasSubstr("x, y or z"));
  EXPECT_THAT(test::error_of<InputError>("a.ply", with("3 0 2 1", "3 0 2 4")), HasSubstr("face 0"));
  EXPECT_THAT(test::error_of<InputError>("a.ply", with("3 0 2 1", "3 0 2 -1")), HasSubstr("face 0"));
  EXPECT_THAT(test::error_of<InputError>("a.ply", with("0.5 7", "half 7")), HasSubstr("'half'"));
}

}  // namespace
}  // namespace particle_surface_tracker
