#include "particle_surface_tracker/io/report_writer.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "particle_surface_tracker/core/error.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

using Json = nlohmann::ordered_json;

FrameReport example() {
  FrameReport report;
  report.frame = 12;
  report.stamp_ns = 1709210000123456789;
  report.particles = 1000;
  report.particles_born = 3;
  report.particles_gone = 4;
  report.vertices = 500;
  report.triangles = 996;
  report.components = 2;
  report.genus = 1;
  report.volume = 0.1;
  report.implicit_volume = 0.11;
  report.area = 2.5;
  report.max_abs_delta = 1e-3;
  report.smallest_angle = 12.5;
  report.missing_frames = 8;
  report.topology.splits = 9;
  report.topology.merges = 10;
  report.topology.gone = 11;
  report.flagged_vertices = 5;
  report.flagged_cells = 6;
  report.unreached_vertices = 7;
  report.original_vertices_alive = 499;
  report.times = {{"implicit surface", 0.25}, {"advection", 0.125}};
  report.total_time = 0.5;
  report.cpu_seconds = 0.75;
  report.peak_rss_bytes = 5000000000;
  report.warnings = {"a \"quoted\"\nwarning"};
  return report;
}

TEST(ReportWriter, TheShareOfSelfIntersectionsIsThereIfTheMeshWasChecked) {
  FrameReport report = example();
  EXPECT_FALSE(Json::parse(report_line(report)).contains("self_intersecting_triangles"));
  report.self_intersecting_triangles = 0.25;
  EXPECT_EQ(Json::parse(report_line(report))["self_intersecting_triangles"], 0.25);
}

TEST(ReportWriter, LineHoldsEverythingInOrder) {
  const std::string line = report_line(example());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const Json json = Json::parse(line);
  std::vector<std::string> names;
  for (const auto& item : json.items()) names.push_back(item.key());
  EXPECT_EQ(names, (std::vector<std::string>{"frame",
                                             "stamp",
                                             "missing_frames",
                                             "particles",
                                             "vertices",
                                             "triangles",
                                             "components",
                                             "genus",
                                             "volume",
                                             "implicit_volume",
                                             "area",
                                             "max_abs_delta",
                                             "smallest_angle",
                                             "flagged_vertices",
                                             "original_vertices_alive",
                                             "times",
                                             "cpu_seconds",
                                             "cpu_times",
                                             "peak_rss_bytes",
                                             "particles_born",
                                             "particles_gone",
                                             "flagged_cells",
                                             "unreached_vertices",
                                             "topology",
                                             "upkeep",
                                             "warnings"}));
  EXPECT_EQ(json["frame"], 12);
  EXPECT_EQ(json["particles"], 1000);
  EXPECT_EQ(json["vertices"], 500);
  EXPECT_EQ(json["triangles"], 996);
  EXPECT_EQ(json["components"], 2);
  EXPECT_EQ(json["genus"], 1);
  EXPECT_EQ(json["volume"].get<double>(), 0.1);
  EXPECT_EQ(json["implicit_volume"].get<double>(), 0.11);
  EXPECT_EQ(json["area"].get<double>(), 2.5);
  EXPECT_EQ(json["max_abs_delta"].get<double>(), 1e-3);
  EXPECT_EQ(json["smallest_angle"].get<double>(), 12.5);
  EXPECT_EQ(json["missing_frames"], 8);
  EXPECT_EQ(json["topology"]["splits"], 9);
  EXPECT_EQ(json["topology"]["merges"], 10);
  EXPECT_EQ(json["topology"]["gone"], 11);
  EXPECT_EQ(json["flagged_vertices"], 5);
  EXPECT_EQ(json["original_vertices_alive"], 499);
  EXPECT_EQ(json["times"].dump(), R"({"implicit surface":0.25,"advection":0.125,"total":0.5})");
  EXPECT_EQ(json["cpu_seconds"].get<double>(), 0.75);
  EXPECT_EQ(json["peak_rss_bytes"], 5000000000);
  EXPECT_EQ(json["particles_born"], 3);
  EXPECT_EQ(json["particles_gone"], 4);
  EXPECT_EQ(json["flagged_cells"], 6);
  EXPECT_EQ(json["unreached_vertices"], 7);
  EXPECT_EQ(json["warnings"][0], "a \"quoted\"\nwarning");
}

// The first cell of a row names one field or several.
TEST(ReportWriter, ThePageTellsEveryField) {
  std::ifstream page(PST_REPORT_PAGE);
  std::string cells;
  for (std::string line; std::getline(page, line);) {
    if (line.rfind("| `", 0) == 0) cells += line.substr(0, line.find('|', 1));
  }
  FrameReport report = example();
  report.self_intersecting_triangles = 0.25;
  const Json json = Json::parse(report_line(report));
  const auto expect_told = [&cells](const Json& object) {
    for (const auto& item : object.items()) {
      EXPECT_NE(cells.find('`' + item.key() + '`'), std::string::npos) << item.key() << " is not in " PST_REPORT_PAGE;
    }
  };
  expect_told(json);
  expect_told(json["topology"]);
  expect_told(json["upkeep"]);
}

TEST(ReportWriter, StampIsExactToTheNanosecond) {
  FrameReport report = example();
  EXPECT_EQ(report_line(report).rfind("{\"frame\":12,\"stamp\":1709210000.123456789,\"missing_frames\"", 0), 0u);
  report.stamp_ns = 5;
  EXPECT_NE(report_line(report).find("\"stamp\":0.000000005,"), std::string::npos);
  report.stamp_ns = -1500000000;
  EXPECT_NE(report_line(report).find("\"stamp\":-1.500000000,"), std::string::npos);
}

TEST(ReportWriter, NumbersThatAreNotFiniteAreNull) {
  FrameReport report = example();
  report.volume = std::numeric_limits<double>::quiet_NaN();
  report.area = std::numeric_limits<double>::infinity();
  const Json json = Json::parse(report_line(report));
  EXPECT_TRUE(json["volume"].is_null());
  EXPECT_TRUE(json["area"].is_null());
}

TEST(ReportWriter, TextThatIsNotUnicodeIsStillJson) {
  FrameReport report = example();
  report.warnings = {"bad \xff byte"};
  EXPECT_NO_THROW(Json::parse(report_line(report)));
  EXPECT_EQ(Json::parse(report_error_line(3, "bad \xff byte"))["frame"], 3);
}

TEST(ReportWriter, EveryLineIsInTheFileAtOnce) {
  const test::TemporaryFolder folder;
  const auto content = [&folder] {
    std::ifstream file(folder / "a.jsonl");
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  ReportWriter writer(folder.write("a.jsonl", "old text\n"));
  writer.write(example());
  EXPECT_EQ(content(), report_line(example()) + "\n");
  writer.write_error(13, "broken");
  EXPECT_EQ(content(), report_line(example()) + "\n{\"frame\":13,\"error\":\"broken\"}\n");
  EXPECT_THROW(ReportWriter(folder / "missing/a.jsonl"), OutputError);
  EXPECT_THROW(ReportWriter(folder.path().string()), OutputError);
}

TEST(ReportWriter, AFullDiskIsAnError) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "there is no /dev/full here";
  ReportWriter writer("/dev/full");
  EXPECT_THROW(writer.write(example()), OutputError);
}

}  // namespace
}  // namespace particle_surface_tracker
