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
  std::string start_of(const std::string& name) const {
    std::ifstream file(folder_.path() / name, std::ios::binary);
    return std::string(std::istreambuf_iterator<char>(file), {}).substr(0, 3);
  }

  test::TemporaryFolder folder_;
  TriangleMesh mesh_ = test::make_box(Vec3d(0, 0, 0), Vec3d(1, 1, 1));
};

TEST_F(MeshSequences, FilesAreNamedAfterTheFrame) {
  const MeshSequence ply(folder_ / "new/deep", MeshFormat::kPly);
  ply.write(mesh_, 0);
  ply.write(mesh_, 42);
  ply.write(mesh_, 1234567);
  EXPECT_EQ(start_of("new/deep/frame_000000.ply"), "ply");
  EXPECT_EQ(start_of("new/deep/frame_000042.ply"), "ply");
  EXPECT_EQ(start_of("new/deep/frame_1234567.ply"), "ply");
  const MeshSequence obj(folder_.path().string(), MeshFormat::kObj);
  obj.write(mesh_, 7);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "frame_000007.obj"));
  const MeshSequence vtp(folder_.path().string(), MeshFormat::kVtp);
  vtp.write(mesh_, 7);
  EXPECT_EQ(start_of("frame_000007.vtp"), "<?x");
  const MeshSequence glb(folder_.path().string(), MeshFormat::kGlb);
  glb.write(mesh_, 7);
  EXPECT_EQ(start_of("frame_000007.glb"), "glT");
}

TEST_F(MeshSequences, TryingTheFolderLeavesNothingBehind) {
  const MeshSequence sequence(folder_.path().string(), MeshFormat::kPly);
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
