#include "particle_surface_tracker/io/mesh_writer.h"

#include <cmath>
#include <csignal>
#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Bits instead of values, so that −0 and 0 differ.
std::vector<std::uint32_t> bits_of(const std::vector<Vec3f>& positions) {
  std::vector<std::uint32_t> bits(3 * positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) std::memcpy(&bits[3 * v], positions[v].data(), sizeof(float[3]));
  return bits;
}

/// A closed mesh whose coordinates take all 24 bits, with colours and texture coordinates.
TriangleMesh decorated_torus() {
  TriangleMesh mesh = test::make_torus({0.1, 100.0 / 3.0, -7e-3}, 1.0, 0.3, 20, 10);
  const std::size_t color = mesh.attributes().add(TriangleMesh::color_name, 4, {1, 1, 1, 1});
  const std::size_t texcoord = mesh.attributes().add(TriangleMesh::texcoord_name, 2, {0, 0});
  for (std::int32_t v = 0; v < static_cast<std::int32_t>(mesh.vertex_count()); ++v) {
    for (std::int32_t k = 0; k < 4; ++k) {
      mesh.attributes()[color].values[static_cast<std::size_t>(4 * v + k)] =
          static_cast<float>(0.5 + 0.5 * test::hash_noise(1, v, k, 0, 0));
    }
    for (std::int32_t k = 0; k < 2; ++k) {
      mesh.attributes()[texcoord].values[static_cast<std::size_t>(2 * v + k)] =
          static_cast<float>(test::hash_noise(2, v, k, 0, 0));
    }
  }
  return mesh;
}

const std::vector<float>& values_of(const TriangleMesh& mesh, const char* name) {
  return mesh.attributes()[mesh.attributes().find(name)].values;
}

TEST(WritePly, ComesBackBitForBit) {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = decorated_torus();
  write_ply((folder / "mesh.ply"), mesh);
  const LoadedMesh loaded = read_initial_mesh((folder / "mesh.ply"));
  EXPECT_THAT(loaded.warnings, IsEmpty());
  EXPECT_EQ(bits_of(loaded.mesh.positions()), bits_of(mesh.positions()));
  EXPECT_EQ(loaded.mesh.triangles(), mesh.triangles());
  EXPECT_EQ(values_of(loaded.mesh, TriangleMesh::texcoord_name), values_of(mesh, TriangleMesh::texcoord_name));
  const std::vector<float>& colors = values_of(loaded.mesh, TriangleMesh::color_name);
  ASSERT_EQ(colors.size(), 4 * mesh.vertex_count());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    EXPECT_NEAR(colors[i], values_of(mesh, TriangleMesh::color_name)[i], 0.5 / 255.0 + 1e-6);
  }
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(WritePly, WritesTheseBytes) {
  const test::TemporaryFolder folder;
  TriangleMesh mesh({{1, 2, 3}, {0, 0, 0}, {-1, 0.5, 0}}, {{0, 1, 2}});
  mesh.delta()[0] = -0.25F;
  const std::size_t stretch = mesh.attributes().add("stretch", 2, {1, 2});
  mesh.attributes()[stretch].values[1] = 8.0F;
  const std::size_t color = mesh.attributes().add(TriangleMesh::color_name, 4, {0, 0, 0, 1});
  mesh.attributes()[color].values = {1.5F, -3.0F, 0.5F, std::nanf(""), 0, 0, 0, 1, 0, 0, 0, 1};
  write_ply((folder / "mesh.ply"), mesh);

  const std::string content = content_of((folder / "mesh.ply"));
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\nproperty float delta\nproperty uint id\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar alpha\n"
      "property float stretch_0\nproperty float stretch_1\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n";
  ASSERT_EQ(content.substr(0, header.size()), header);
  const std::string data = content.substr(header.size());
  ASSERT_EQ(data.size(), 3U * 32U + 13U);
  using namespace std::string_literals;
  EXPECT_EQ(data.substr(0, 16), "\x00\x00\x80\x3f\x00\x00\x00\x40\x00\x00\x40\x40\x00\x00\x80\xbe"s);
  EXPECT_EQ(data.substr(16, 4), "\x00\x00\x00\x00"s);
  EXPECT_EQ(data.substr(20, 4), "\xff\x00\x80\x00"s);
  EXPECT_EQ(data.substr(24, 8), "\x00\x00\x80\x3f\x00\x00\x00\x41"s);
  EXPECT_EQ(data.substr(32 + 16, 4), "\x01\x00\x00\x00"s);
  EXPECT_EQ(data.substr(96), "\x03\x00\x00\x00\x00\x01\x00\x00\x00\x02\x00\x00\x00"s);
}

TEST(WritePly, ReplacesAFile) {
  const test::TemporaryFolder folder;
  folder.write("mesh.ply", "old");
  write_ply((folder / "mesh.ply"), decorated_torus());
  EXPECT_EQ(content_of((folder / "mesh.ply")).substr(0, 4), "ply\n");
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(WriteObj, ComesBackBitForBit) {
  const test::TemporaryFolder folder;
  const TriangleMesh mesh = decorated_torus();
  write_obj((folder / "mesh.obj"), mesh);
  const LoadedMesh loaded = read_initial_mesh((folder / "mesh.obj"));
  EXPECT_THAT(loaded.warnings, IsEmpty());
  EXPECT_EQ(bits_of(loaded.mesh.positions()), bits_of(mesh.positions()));
  EXPECT_EQ(loaded.mesh.triangles(), mesh.triangles());
  EXPECT_EQ(values_of(loaded.mesh, TriangleMesh::texcoord_name), values_of(mesh, TriangleMesh::texcoord_name));
  for (std::size_t i = 0; i < 4 * mesh.vertex_count(); ++i) {
    if (i % 4 == 3) continue;
    EXPECT_EQ(values_of(loaded.mesh, TriangleMesh::color_name)[i], values_of(mesh, TriangleMesh::color_name)[i]);
  }
}

TEST(WriteFormats, FloatExtremesComeBack) {
  using Limits = std::numeric_limits<float>;
  const test::TemporaryFolder folder;
  TriangleMesh mesh = test::make_box({0, 0, 0}, {1, 1, 1});
  mesh.positions()[0] = Vec3f(-0.0F, Limits::denorm_min(), -Limits::min());
  mesh.positions()[1].x() = Limits::max();
  mesh.positions()[2] = Vec3f(1.0F + Limits::epsilon(), 16777217.0F, 0.1F);
  mesh.positions()[7].z() = std::nextafter(Limits::max(), 0.0F);
  write_ply((folder / "mesh.ply"), mesh);
  write_obj((folder / "mesh.obj"), mesh);
  EXPECT_EQ(bits_of(read_initial_mesh((folder / "mesh.ply")).mesh.positions()), bits_of(mesh.positions()));
  EXPECT_EQ(bits_of(read_initial_mesh((folder / "mesh.obj")).mesh.positions()), bits_of(mesh.positions()));
}

/// Writing to `path` must fail with an error that names the path and the reason.
void expect_output_error(const std::string& path, const std::string& reason) {
  for (const auto write : {&write_ply, &write_obj}) {
    try {
      write(path, decorated_torus());
      ADD_FAILURE() << path << " was written";
    } catch (const OutputError& error) {
      EXPECT_THAT(error.what(), AllOf(HasSubstr(path), HasSubstr(reason)));
    }
  }
}

TEST(WriteFailure, MissingFolder) {
  const test::TemporaryFolder folder;
  expect_output_error((folder / "missing/mesh.ply"), std::strerror(ENOENT));
}

TEST(WriteFailure, PathBelowAFile) {
  const test::TemporaryFolder folder;
  folder.write("file", "content");
  expect_output_error((folder / "file/mesh.ply"), std::strerror(ENOTDIR));
}

TEST(WriteFailure, PathIsAFolder) {
  const test::TemporaryFolder folder;
  mkdir((folder / "mesh.ply").c_str(), 0777);
  expect_output_error((folder / "mesh.ply"), std::strerror(EISDIR));
  EXPECT_EQ(folder.entry_count(), 1U);
}

TEST(WriteFailure, DeviceIsNotReplaced) {
  expect_output_error("/dev/full", "not a regular file");
  struct stat status = {};
  ASSERT_EQ(stat("/dev/full", &status), 0);
  EXPECT_TRUE(S_ISCHR(status.st_mode));
}

TEST(WriteFailure, ReadOnlyFolder) {
  if (geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const test::TemporaryFolder folder;
  chmod((folder / "").c_str(), 0555);
  expect_output_error((folder / "mesh.ply"), std::strerror(EACCES));
  chmod((folder / "").c_str(), 0755);
}

TEST(WriteFailure, NoRoomLeavesTheOldFileAndNothingElse) {
  const test::TemporaryFolder folder;
  folder.write("mesh.ply", "old");
  struct rlimit before = {};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto old_handler = std::signal(SIGXFSZ, SIG_IGN);
  struct rlimit small = before;
  small.rlim_cur = 2000;
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
  expect_output_error((folder / "mesh.ply"), std::strerror(EFBIG));
  ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old_handler);
  EXPECT_EQ(content_of((folder / "mesh.ply")), "old");
  EXPECT_EQ(folder.entry_count(), 1U);
}

}  // namespace
}  // namespace particle_surface_tracker
