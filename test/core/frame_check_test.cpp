#include "particle_surface_tracker/core/frame_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

TEST(CheckFrame, AGoodMeshIsReportedAsSuch) {
  FrameReport report;
  check_frame(test::make_sphere(Vec3d::Zero(), 1.0, 3), report);
  EXPECT_EQ(report.self_intersecting_triangles, 0.0);
  EXPECT_THAT(report.warnings, IsEmpty());
  check_frame(TriangleMesh(), report);
  EXPECT_EQ(report.self_intersecting_triangles, 0.0);
}

TEST(CheckFrame, ReportsTheShareOfSelfIntersections) {
  // A thin bar through a cube: eight of its triangles and two of the cube's cross.
  FrameReport report;
  check_frame(test::joined({test::make_box({-1, -1, -1}, {1, 1, 1}), test::make_box({0.4, -0.5, -2}, {0.6, -0.3, 2})}),
              report);
  EXPECT_EQ(report.self_intersecting_triangles, 10.0 / 24.0);
  EXPECT_THAT(report.warnings, IsEmpty());
}

TEST(CheckFrame, WarnsOfWrongNesting) {
  FrameReport report;
  report.warnings = {"earlier"};
  check_frame(test::joined({test::make_box({-4, -4, -4}, {4, 4, 4}), test::make_box({-1, -1, -1}, {1, 1, 1})}), report);
  EXPECT_THAT(report.warnings, ElementsAre("earlier", AllOf(HasSubstr("1 components are solids inside a solid"),
                                                            HasSubstr("component 1 at (-1, -1, -1)"))));
}

TEST(CheckFrame, ABrokenMeshIsATrackingError) {
  TriangleMesh mesh = test::make_box({0, 0, 0}, {1, 1, 1});
  std::vector<Triangle> triangles = mesh.triangles();
  triangles.pop_back();
  mesh.set_triangles(triangles);
  FrameReport report;
  try {
    check_frame(mesh, report);
    FAIL() << "an open box was accepted";
  } catch (const TrackingError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("3 edges are open"), HasSubstr("vertex 1 at (1, 0, 0)")));
  }
  EXPECT_FALSE(report.self_intersecting_triangles.has_value());
}

}  // namespace
}  // namespace particle_surface_tracker
