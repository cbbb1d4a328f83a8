#include "particle_surface_tracker/io/mesh_sequence.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

class MeshSequences : public testing::Test {
 protected:
  std::string content_of(const std::string& name) const {
    std::ifstream file(folder_.path() / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }
  std::string start_of(const std::string& name) const { return content_of(name).substr(0, 3); }

  test::TemporaryFolder folder_;
  TriangleMesh mesh_ = test::make_box(Vec3d(0, 0, 0), Vec3d(1, 1, 1));
};

TEST_F(MeshSequences, FilesAreNamedAfterTheFrame) {
  MeshSequence ply(folder_ / "new/deep", MeshFormat::kPly);
  ply.write(mesh_, 0, 0);
  ply.write(mesh_, 42, 0);
  ply.write(mesh_, 1234567, 0);
  EXPECT_EQ(start_of("new/deep/frame_000000.ply"), "ply");
  EXPECT_EQ(start_of("new/deep/frame_000042.ply"), "ply");
  EXPECT_EQ(start_of("new/deep/frame_1234567.ply"), "ply");
  MeshSequence obj(folder_.path().string(), MeshFormat::kObj);
  obj.write(mesh_, 7, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "frame_000007.obj"));
  MeshSequence vtp(folder_.path().string(), MeshFormat::kVtp);
  vtp.write(mesh_, 7, 0);
  EXPECT_EQ(start_of("frame_000007.vtp"), "<?x");
  MeshSequence glb(folder_.path().string(), MeshFormat::kGlb);
  glb.write(mesh_, 7, 0);
  EXPECT_EQ(start_of("frame_000007.glb"), "glT");
}

TEST_F(MeshSequences, TheTimeSeriesIsWholeAfterEveryFrame) {
  MeshSequence sequence(folder_.path().string(), MeshFormat::kVtp);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "frames.pvd")) << "no frame, no series";
  sequence.write(mesh_, 7, 1000000000001);
  EXPECT_EQ(content_of("frames.pvd"),
            "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
            "<DataSet timestep=\"1000.000000001\" part=\"0\" file=\"frame_000007.vtp\"/>\n"
            "</Collection>\n</VTKFile>\n");
  sequence.write(mesh_, 9, 1000500000000);
  EXPECT_NE(content_of("frames.pvd").find("\"1000.500000000\" part=\"0\" file=\"frame_000009.vtp\""),
            std::string::npos);
}

TEST_F(MeshSequences, ATimeSeriesGoesOn) {
  const std::string whole = folder_ / "whole", resumed = folder_ / "resumed";
  MeshSequence left_alone(whole, MeshFormat::kVtp), killed(resumed, MeshFormat::kVtp);
  for (int n = 8; n <= 12; ++n) left_alone.write(mesh_, n, n * 1000000000LL);
  for (int n = 8; n <= 10; ++n) killed.write(mesh_, n, n * 1000000000LL);
  MeshSequence goes_on(resumed, MeshFormat::kVtp, 9);  // Frame 9 and 10 come once more.
  for (int n = 9; n <= 12; ++n) goes_on.write(mesh_, n, n * 1000000000LL);
  EXPECT_EQ(content_of("resumed/frames.pvd"), content_of("whole/frames.pvd"));
}

TEST_F(MeshSequences, ATimeSeriesThatLacksWhatWasBeforeDoesNotGoOn) {
  EXPECT_THROW(MeshSequence(folder_.path().string(), MeshFormat::kVtp, 9), InputError);
  MeshSequence(folder_.path().string(), MeshFormat::kVtp).write(mesh_, 9, 0);
  EXPECT_THROW(MeshSequence(folder_.path().string(), MeshFormat::kVtp, 9), InputError);
  EXPECT_NO_THROW(MeshSequence(folder_.path().string(), MeshFormat::kVtp, 10));
  folder_.write("frames.pvd", "no series <DataSet file=\"other.vtp\"/>\n<DataSet file=\"frame_1");
  EXPECT_THROW(MeshSequence(folder_.path().string(), MeshFormat::kVtp, 1), InputError);
  EXPECT_NO_THROW(MeshSequence(folder_.path().string(), MeshFormat::kPly, 9)) << "it needs none";
}

TEST_F(MeshSequences, FilesOfAnotherRunAreCounted) {
  MeshSequence older(folder_.path().string(), MeshFormat::kPly);
  for (int n = 0; n < 5; ++n) older.write(mesh_, n, 0);
  EXPECT_EQ(older.count_of_others(), 0u);
  for (const char* name :
       {"frame_000001.obj", "frame_1.ply", "frames.pvd", "cells_000001.ply", "frame_000007.ply.old"}) {
    folder_.write(name, "x");
  }
  MeshSequence newer(folder_.path().string(), MeshFormat::kPly);
  newer.write(mesh_, 3, 0);
  newer.write(mesh_, 1234567, 0);
  EXPECT_EQ(newer.count_of_others(), 4u);
}

TEST_F(MeshSequences, TryingTheFolderLeavesNothingBehind) {
  MeshSequence sequence(folder_.path().string(), MeshFormat::kPly);
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

TEST_F(MeshSequences, FolderThatCannotBeWrittenIsAnErrorAtOnce) {
  folder_.write("file", "x");
  EXPECT_THROW(MeshSequence(folder_ / "file", MeshFormat::kPly), OutputError);
  EXPECT_THROW(MeshSequence(folder_ / "file/below", MeshFormat::kPly), OutputError);
  // No user, not even root, can write here.
  EXPECT_THROW(MeshSequence("/proc/self/meshes", MeshFormat::kPly), OutputError);
  EXPECT_THROW(MeshSequence("/proc", MeshFormat::kObj), OutputError);
}

}  // namespace
}  // namespace particle_surface_tracker
