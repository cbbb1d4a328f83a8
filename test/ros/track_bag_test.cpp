// The program track_bag itself: what it writes.

#include <filesystem>

#include <gtest/gtest.h>
#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>
#include <rosbag/view.h>

#include "particle_surface_tracker/io/mesh_reader.h"
#include "particle_surface_tracker/io/mesh_writer.h"
#include "ros_test_support.h"
#include "support/shapes.h"
#include "track_bag_run.h"

namespace particle_surface_tracker::test {
namespace {

TEST_F(TrackBag, TracksEveryFrameAndWritesEverything) {
  write_bag(4);
  const Outcome outcome = run_standard("--report @/report.jsonl --out-bag @/out.bag --surface @/surface --threads 1");
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("4 frames tracked"), std::string::npos) << outcome.out;
  const std::vector<std::string> names = {"frame_000000.ply", "frame_000001.ply", "frame_000002.ply",
                                          "frame_000003.ply"};
  EXPECT_EQ(files_in("out"), names);
  EXPECT_EQ(files_in("surface"), names);
  EXPECT_EQ(read_initial_mesh(folder_ / "out/frame_000000.ply").mesh.positions(),
            read_initial_mesh(folder_ / "ball.ply").mesh.positions());
  ASSERT_EQ(report().size(), 4u);
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_EQ(report()[n]["frame"], n);
    EXPECT_GT(report()[n]["times"]["total"].get<double>(), 0.0) << n;
    EXPECT_GT(report()[n]["peak_rss_bytes"].get<double>(), 1e6) << n;
  }
  EXPECT_EQ(report()[2]["stamp"].get<double>(), 1000.02);
  rosbag::Bag bag(folder_ / "out.bag");
  EXPECT_EQ(rosbag::View(bag, rosbag::TopicQuery("/particles")).size(), 4u);
  EXPECT_EQ(rosbag::View(bag, rosbag::TypeQuery("particle_surface_tracker/TrackedMesh")).size(), 4u);
}

TEST_F(TrackBag, ChecksEveryFrameIfAsked) {
  write_bag(3);
  // A second ball crosses the first.
  write_ply(folder_ / "ball.ply",
            joined({make_sphere(Vec3d::Zero(), 1.0, 3), make_sphere(Vec3d(0.05, 0.02, 0.01), 0.95, 3)}));
  const Outcome outcome = run_standard("--check --set topology=keep --report @/report.jsonl");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("checking"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("all 3 meshes are closed"), std::string::npos) << outcome.out;
  ASSERT_EQ(report().size(), 3u);
  for (const Json& line : report()) {
    EXPECT_GT(line["self_intersecting_triangles"], 0.0);
    EXPECT_LE(line["self_intersecting_triangles"], 1.0);
  }
}

TEST_F(TrackBag, WritesCellsOfTheFramesThatAreAskedForAndNothingElseChanges) {
  write_bag(4);
  // A second ball crosses the first, so that there is something to re-mesh.
  write_ply(folder_ / "ball.ply",
            joined({make_sphere(Vec3d::Zero(), 1.0, 3), make_sphere(Vec3d(0.05, 0.02, 0.01), 0.95, 3)}));
  ASSERT_EQ(run_standard("--quiet --debug-cells 1,3-7 --report @/report.jsonl").code, 0);
  std::vector<std::string> cells, meshes;
  for (const std::string& name : files_in("out")) (name.rfind("cells_", 0) == 0 ? cells : meshes).push_back(name);
  EXPECT_EQ(cells,
            (std::vector<std::string>{"cells_000001.vdb", "cells_000001.vtp", "cells_000003.vdb", "cells_000003.vtp"}));
  openvdb::initialize();
  openvdb::io::File file(folder_ / "out/cells_000001.vdb");
  file.open();
  EXPECT_EQ(file.readGrid("marked")->activeVoxelCount(), report()[1]["topology"]["remeshed_cells"]);
  EXPECT_GT(file.readGrid("tangled")->activeVoxelCount(), 0u);

  ASSERT_EQ(run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/plain --quiet").code, 0);
  EXPECT_EQ(files_in("plain"), meshes);
  for (const std::string& name : meshes) {
    EXPECT_EQ(read_file(folder_ / ("plain/" + name)), read_file(folder_ / ("out/" + name))) << name;
  }
  expect_error(run_standard("--debug-cells 1,x"), 1, {"--debug-cells 1,x", "'x'"});
  expect_error(run_standard("--debug-cells 5-3"), 1, {"--debug-cells", "3", "5"});
}

TEST_F(TrackBag, RangeOfFramesKeepsTheirNumbers) {
  write_bag(6);
  write_ply(folder_ / "ball.ply", make_sphere(Vec3d(2 * r / 16, 0, 0), 1.0, 3));
  ASSERT_EQ(run_standard("--first 2 --last 4 --format obj --quiet --report @/report.jsonl").code, 0);
  EXPECT_EQ(files_in("out"), (std::vector<std::string>{"frame_000002.obj", "frame_000003.obj", "frame_000004.obj"}));
  EXPECT_EQ(report().front()["frame"], 2);
}

TEST_F(TrackBag, FormatsForOtherProgramsHaveTheNamesOfTheFrames) {
  write_bag(4);
  ASSERT_EQ(run_standard("--first 1 --last 2 --format vtp").code, 0);
  EXPECT_EQ(files_in("out"), (std::vector<std::string>{"frame_000001.vtp", "frame_000002.vtp", "frames.pvd"}));
  const std::string series = read_file(folder_ / "out/frames.pvd");
  EXPECT_NE(series.find("timestep=\"1000.010000000\" part=\"0\" file=\"frame_000001.vtp\""), std::string::npos)
      << series;
  EXPECT_NE(series.find("timestep=\"1000.020000000\" part=\"0\" file=\"frame_000002.vtp\""), std::string::npos)
      << series;
  ASSERT_EQ(run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/glb --format glb --last 1").code, 0);
  EXPECT_EQ(files_in("glb"), (std::vector<std::string>{"frame_000000.glb", "frame_000001.glb"}));
  EXPECT_EQ(read_file(folder_ / "glb/frame_000001.glb").substr(0, 4), "glTF");
}

TEST_F(TrackBag, ImplicitMeshAndEstimatedSpacing) {
  write_bag(3);
  const Outcome outcome = run("--bag @/in.bag --mesh implicit --spacing auto --out @/out --format none");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("estimated"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("0.2 m"), std::string::npos) << outcome.out;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(TrackBag, FramesOfAnOlderRunInItsFolderAreWarnedOf) {
  write_bag(4);
  ASSERT_EQ(run_standard().code, 0);
  const Outcome again = run_standard();
  EXPECT_EQ(again.err, "");
  const Outcome shorter = run_standard("--last 1");
  EXPECT_EQ(shorter.code, 0);
  EXPECT_NE(shorter.err.find("warning: '" + (folder_ / "out")), std::string::npos) << shorter.err;
  EXPECT_NE(shorter.err.find("2 frames of another run"), std::string::npos) << shorter.err;
  EXPECT_EQ(run_standard("--last 1 --quiet").err, "");
  EXPECT_EQ(run_standard("--last 1 --format obj").err, "") << "others of another format";
}

TEST_F(TrackBag, EndsWithWhereItsResultIs) {
  write_bag(3);
  const std::string out = folder_ / "out", bag = folder_ / "out.bag", report = folder_ / "report.jsonl";
  const auto last_line = [](const std::string& text) { return text.substr(text.rfind('\n', text.size() - 2) + 1); };
  EXPECT_EQ(last_line(run_standard().out), "written: " + out + "\n");
  EXPECT_EQ(last_line(run_standard("--format none --out-bag @/out.bag --report @/report.jsonl").out),
            "written: " + bag + ", " + report + "\n");
  EXPECT_EQ(run_standard("--check --quiet").out, "");
}

TEST_F(TrackBag, ThreadsDoNotChangeTheMeshes) {
  write_bag(4);
  ASSERT_EQ(run_standard("--threads 1").code, 0);
  ASSERT_EQ(run("--bag @/in.bag --mesh @/ball.ply --spacing 0.2 --out @/out2 --threads 2").code, 0);
  for (const std::string& name : files_in("out")) {
    EXPECT_EQ(read_file(folder_ / ("out/" + name)), read_file(folder_ / ("out2/" + name))) << name;
  }
}

TEST_F(TrackBag, HelpAndVersion) {
  const Outcome help = run("--help");
  EXPECT_EQ(help.code, 0);
  for (const char* word : {"--bag", "--spacing", "[m]", "--refine-initial", "tau", "130 interrupted"}) {
    EXPECT_NE(help.out.find(word), std::string::npos) << word;
  }
  EXPECT_EQ(run("--version").code, 0);
  EXPECT_EQ(run("--version").out.rfind("track_bag ", 0), 0u);
}

}  // namespace
}  // namespace particle_surface_tracker::test
