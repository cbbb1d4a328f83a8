#include "particle_surface_tracker/io/vdb_sequence.h"

#include <openvdb/io/File.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/particle_grid.h"
#include "particle_surface_tracker/stages/implicit_function.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

constexpr double kSpacing = 0.1;

ImplicitSurface ball() {
  const ParticleFrame frame = test::fill_with_particles({-1, -1, -1}, {1, 1, 1}, kSpacing, 0.0, 1,
                                                        [](const Vec3d& x) { return x.norm() < 0.8; });
  Parameters parameters;
  parameters.particle_spacing = kSpacing;
  return evaluate_implicit_function(ParticleGrid(frame.positions, implicit_function_cell_size(parameters)), parameters);
}

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

openvdb::FloatGrid::Ptr grid_of(const std::string& path) {
  openvdb::io::File file(path);
  file.open();
  return openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("phi"));
}

TEST(VdbSequence, HoldsPhiAsALevelSet) {
  const test::TemporaryFolder folder;
  const ImplicitSurface surface = ball();
  const VdbSequence sequence(folder / "new/deep");
  sequence.write(surface, 42);
  const auto grid = grid_of(folder / "new/deep/frame_000042.vdb");
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->getGridClass(), openvdb::GRID_LEVEL_SET);
  EXPECT_EQ(grid->activeVoxelCount(), surface.field->activeVoxelCount());
  for (auto value = surface.field->cbeginValueOn(); value; ++value) {
    ASSERT_EQ(grid->tree().getValue(value.getCoord()), *value);
  }
  const auto at = [&grid](double x) {
    return grid->tree().getValue(openvdb::Coord::round(grid->worldToIndex({x, 0.0, 0.0})));
  };
  EXPECT_LT(at(0.0), 0.0F);
  EXPECT_LT(at(0.6), 0.0F);
  EXPECT_GT(at(1.2), 0.0F);
}

TEST(VdbSequence, TheSameSurfaceGivesTheSameBytes) {
  const test::TemporaryFolder folder;
  write_vdb(folder / "a.vdb", ball());
  write_vdb(folder / "b.vdb", ball());
  EXPECT_EQ(content_of(folder / "a.vdb"), content_of(folder / "b.vdb"));
  ImplicitSurface other = ball();
  other.dx *= 2;
  write_vdb(folder / "c.vdb", other);
  const auto id_in = [&folder](const char* name) { return content_of(folder / name).substr(21, 36); };
  EXPECT_NE(id_in("a.vdb"), id_in("c.vdb"));
}

TEST(VdbSequence, FilesThatCannotBeWrittenAreErrors) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(VdbSequence(folder / "file"), OutputError);
  EXPECT_THROW(write_vdb(folder / "none/a.vdb", ball()), OutputError);
}

}  // namespace
}  // namespace particle_surface_tracker
