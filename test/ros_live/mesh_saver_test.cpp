#include "ros/live/mesh_saver.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/ros/mesh_conversion.h"
#include "ros/ros_test_support.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {
namespace {

namespace fs = std::filesystem;

TrackedMesh ball() {
  return to_tracked_mesh({}, make_sphere(Vec3d::Zero(), 1.0, 2), 1);
}

class MeshSaver : public testing::Test {
 protected:
  MeshSaver() { fs::create_directory(folder_); }

  std::string refusal(const std::string& name) const {
    return error_of<ParameterError>([&] { save_mesh(folder_, name, ball()); });
  }

  TemporaryFolder around_;
  std::string folder_ = around_ / "meshes";
};

TEST_F(MeshSaver, WritesBothFormats) {
  for (const char* name : {"ball.ply", "a/b/ball.obj", "a/../other.ply"}) {
    const std::string path = save_mesh(folder_, name, ball());
    EXPECT_EQ(path, fs::weakly_canonical(fs::path(folder_) / name).string());
    EXPECT_EQ(read_initial_mesh(path).mesh.triangles(), to_triangle_mesh(ball()).triangles()) << name;
  }
}

TEST_F(MeshSaver, WritesInterpolatedFields) {
  TrackedMesh mesh = ball();
  mesh.interpolated.resize(2);
  mesh.interpolated[0].name = "temperature";
  mesh.interpolated[0].components = 1;
  mesh.interpolated[0].values.assign(mesh.ids.size(), 300.0f);
  mesh.interpolated[1] = mesh.interpolated[0];
  mesh.interpolated[1].name = "delta";  // The mesh has a δ of its own.
  mesh.normals.assign(3 * mesh.ids.size(), 1.0f);
  mesh.velocities.assign(3 * mesh.ids.size(), 2.0f);
  const std::string text = read_file(save_mesh(folder_, "ball.ply", mesh));
  EXPECT_NE(text.find("property float temperature"), std::string::npos);
  EXPECT_EQ(text.find("property float delta"), text.rfind("property float delta"));
  for (const char* name : {"particle_delta", "nx", "vertex_velocity_2"}) {
    EXPECT_NE(text.find(std::string("property float ") + name), std::string::npos) << name;
  }
}

TEST_F(MeshSaver, RefusesWhatIsNotBelowTheFolder) {
  for (const std::string name : {"../ball.ply", "a/../../ball.ply", "/tmp/ball.ply"}) {
    EXPECT_NE(refusal(name).find("is not below ~save_folder"), std::string::npos) << name;
  }
  // A name that begins like the folder's.
  fs::create_directory(folder_ + "_2");
  EXPECT_NE(refusal("../meshes_2/ball.ply").find("is not below"), std::string::npos);
  // Links that lead out of it.
  fs::create_directory_symlink(around_.path(), fs::path(folder_) / "link");
  EXPECT_NE(refusal("link/ball.ply").find("is not below"), std::string::npos);
  fs::create_symlink(around_.write("target.ply", "no mesh"), fs::path(folder_) / "link.ply");
  EXPECT_NE(refusal("link.ply").find("is not below"), std::string::npos);
  EXPECT_EQ(around_.entry_count(), 3u);
  EXPECT_EQ(read_file(around_ / "target.ply"), "no mesh");
}

TEST_F(MeshSaver, RefusesOtherNames) {
  EXPECT_NE(refusal("").find("empty"), std::string::npos);
  EXPECT_NE(refusal(".").find("is not below"), std::string::npos);
  EXPECT_NE(refusal("ball.stl").find(".ply or .obj"), std::string::npos);
  EXPECT_NE(refusal("ball").find(".ply or .obj"), std::string::npos);
  EXPECT_NE(refusal(std::string("a\0b.ply", 7)).find("zero byte"), std::string::npos);
}

TEST_F(MeshSaver, RefusesFoldersThatAreNone) {
  const auto refused = [](const std::string& folder) {
    return error_of<ParameterError>([&] { save_mesh(folder, "ball.ply", ball()); });
  };
  EXPECT_NE(refused("").find("~save_folder is not set"), std::string::npos);
  EXPECT_NE(refused("meshes").find("absolute"), std::string::npos);
  EXPECT_NE(refused(around_ / "none").find("is no folder"), std::string::npos);
}

TEST_F(MeshSaver, WhatCannotBeWrittenIsSaid) {
  fs::create_directories(fs::path(folder_) / "ball.ply");
  EXPECT_THROW(save_mesh(folder_, "ball.ply", ball()), OutputError);
}

}  // namespace
}  // namespace particle_surface_tracker::test
