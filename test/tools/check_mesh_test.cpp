// Runs the program check_mesh itself: exit codes, text, JSON.

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "particle_surface_tracker/io/mesh_writer.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker::test {
namespace {

using Json = nlohmann::json;

struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
};

class CheckMesh : public testing::Test {
 protected:
  CheckMesh() {
    write_ply((folder_ / "good.ply"), make_sphere(Vec3d::Zero(), 1.0, 3));
    write_ply((folder_ / "hollow.ply"),
              joined({make_sphere(Vec3d::Zero(), 1.0, 2), turned(make_sphere(Vec3d::Zero(), 0.5, 1))}));
    // Of 2 · 128 triangles, those near the circle where the spheres cross.
    write_ply((folder_ / "crossing.ply"),
              joined({make_sphere(Vec3d::Zero(), 1.0, 2), make_sphere({1.5, 0.1, 0.2}, 1.0, 2)}));
    TriangleMesh open = make_box({0, 0, 0}, {1, 1, 1});
    std::vector<Triangle> triangles = open.triangles();
    triangles.pop_back();
    open.set_triangles(triangles);
    write_ply((folder_ / "open.ply"), open);
    folder_.write("damaged.ply", "ply\nnot really");
  }

  // Runs with these arguments; @ stands for the folder.
  Outcome run(const std::string& arguments) {
    std::string command = "'" PST_CHECK_MESH "' " + arguments + " >@/stdout 2>@/stderr";
    for (std::size_t at = command.find('@'); at != std::string::npos; at = command.find('@')) {
      command.replace(at, 1, (folder_ / ""));
    }
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, content_of("stdout"), content_of("stderr")};
  }

  std::string content_of(const std::string& name) const {
    std::ifstream file((folder_ / name));
    return {std::istreambuf_iterator<char>(file), {}};
  }

  static std::vector<Json> objects_in(const std::string& text) {
    std::istringstream lines(text);
    std::vector<Json> objects;
    for (std::string line; std::getline(lines, line);) objects.push_back(Json::parse(line));
    return objects;
  }

  static void expect_words(const std::string& text, const std::vector<std::string>& words) {
    for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
  }

  TemporaryFolder folder_;
};

TEST_F(CheckMesh, GoodMeshesAreOk) {
  const Outcome outcome = run("@/good.ply @/hollow.ply");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  EXPECT_EQ(outcome.err, "");
  expect_words(outcome.out, {"good.ply: ok", "258 vertices, 512 triangles, 1 components, genus 0", "hollow.ply: ok",
                             "component 1: 32 triangles", "cavity", "winding number around it 1"});
}

TEST_F(CheckMesh, DefectsAreSaidWithTheirPlaces) {
  const Outcome outcome = run("@/good.ply @/open.ply");
  EXPECT_EQ(outcome.code, 3);
  expect_words(outcome.out, {"good.ply: ok", "open.ply: DEFECTS", "3 edges are open",
                             "between vertex 1 at (1, 0, 0) and vertex 5 at (1, 0, 1)"});
}

TEST_F(CheckMesh, ToleratesAShareOfSelfIntersections) {
  EXPECT_EQ(run("@/crossing.ply").code, 3);
  const double share = objects_in(run("--json @/crossing.ply").out).at(0)["mesh"]["self_intersecting_share"];
  EXPECT_GT(share, 0.05);
  EXPECT_LT(share, 0.5);
  EXPECT_EQ(run("--max-self-intersections " + std::to_string(share + 1e-3) + " @/crossing.ply").code, 0);
  EXPECT_EQ(run("--max-self-intersections " + std::to_string(share - 1e-3) + " @/crossing.ply").code, 3);
  EXPECT_EQ(run("--max-self-intersections 1 @/open.ply").code, 3);
}

TEST_F(CheckMesh, JsonHasEveryKindOfDefect) {
  const Outcome outcome = run("--json @/open.ply @/hollow.ply @/damaged.ply");
  EXPECT_EQ(outcome.code, 2);
  const std::vector<Json> objects = objects_in(outcome.out);
  ASSERT_EQ(objects.size(), 3U);
  EXPECT_EQ(objects[0]["sound"], false);
  const Json& defects = objects[0]["mesh"]["defects"];
  EXPECT_EQ(defects.size(), 15U);
  EXPECT_EQ(defects["open_edges"]["count"], 3);
  EXPECT_EQ(defects["open_edges"]["places"][0], Json::parse(R"({"index": 1, "position": [1, 0, 0], "other": 5,
                                                                "other_position": [1, 0, 1]})"));
  EXPECT_EQ(defects["solids_in_solids"]["count"], 0);
  EXPECT_FALSE(objects[0].contains("welded"));
  EXPECT_EQ(objects[1]["sound"], true);
  ASSERT_EQ(objects[1]["mesh"]["components"].size(), 2U);
  EXPECT_LT(objects[1]["mesh"]["components"][1]["volume"], 0.0);
  EXPECT_EQ(objects[1]["mesh"]["components"][1]["winding_around"], 1);
  EXPECT_TRUE(objects[2].contains("error"));
}

TEST_F(CheckMesh, JoinsVerticesOfTheSamePosition) {
  // Two boxes that touch in a corner: manifold as written, and not when a reader joins vertices.
  write_ply((folder_ / "corner.ply"), joined({make_box({0, 0, 0}, {1, 1, 1}), make_box({1, 1, 1}, {2, 2, 2})}));
  const Outcome outcome = run("--max-self-intersections 1 @/corner.ply");
  EXPECT_EQ(outcome.code, 3);
  expect_words(outcome.out, {"with 1 vertices joined", "1 vertices are non-manifold", "vertex 7 at (1, 1, 1)"});
  EXPECT_EQ(objects_in(run("--json @/corner.ply").out).at(0)["welded"]["defects"]["non_manifold_vertices"]["count"], 1);
}

TEST_F(CheckMesh, StlIsJoinedBeforeItIsChecked) {
  std::string text = "solid box\n";
  const TriangleMesh box = make_box({0, 0, 0}, {1, 1, 1});
  for (const Triangle& t : box.triangles()) {
    text += "facet normal 0 0 0\nouter loop\n";
    for (const std::uint32_t v : t) {
      std::ostringstream vertex;
      vertex << "vertex " << box.positions()[v].transpose() << "\n";
      text += vertex.str();
    }
    text += "endloop\nendfacet\n";
  }
  folder_.write("box.stl", text + "endsolid box\n");
  const Outcome outcome = run("@/box.stl");
  EXPECT_EQ(outcome.code, 0) << outcome.out << outcome.err;
  expect_words(outcome.out, {"box.stl: ok", "no indices"});
}

TEST_F(CheckMesh, FilesThatCannotBeRead) {
  const Outcome damaged = run("@/damaged.ply @/open.ply");
  EXPECT_EQ(damaged.code, 2);
  expect_words(damaged.err, {"check_mesh: ", "damaged.ply"});
  expect_words(damaged.out, {"open.ply: DEFECTS"});
  EXPECT_EQ(run("@/missing.ply").code, 2);
  EXPECT_EQ(run("@").code, 2);
}

TEST_F(CheckMesh, AFileWithoutTrianglesIsADefect) {
  folder_.write("points.off", "OFF 1 0 0\n0 0 0\n");
  const Outcome outcome = run("@/points.off");
  EXPECT_EQ(outcome.code, 3);
  expect_words(outcome.out, {"it has no triangles"});
}

TEST_F(CheckMesh, UsageErrors) {
  EXPECT_EQ(run("").code, 1);
  EXPECT_EQ(run("--nonsense @/good.ply").code, 1);
  EXPECT_EQ(run("--max-self-intersections 2 @/good.ply").code, 1);
  EXPECT_EQ(run("--max-self-intersections nan @/good.ply").code, 1);
  EXPECT_EQ(run("--help").code, 0);
  EXPECT_EQ(run("--version").out.rfind("check_mesh ", 0), 0U);
}

}  // namespace
}  // namespace particle_surface_tracker::test
