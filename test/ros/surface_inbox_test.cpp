#include "ros/surface/surface_inbox.h"

#include <thread>

#include <gtest/gtest.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/ros/time_conversion.h"
#include "particle_surface_tracker/tracker/make_implicit_surface.h"
#include "ros/surface/surface_conversion.h"
#include "support/parameters.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double r = 0.1;

ParticleFrame frame_of(int n) {
  ParticleFrame frame = fill_with_particles(Vec3d::Constant(-0.3), Vec3d::Constant(0.3), r, 0.1, 1,
                                            [](const Vec3d& x) { return x.norm() < 0.3; });
  for (Vec3f& x : frame.positions) x.x() += 0.01F * static_cast<float>(n);
  frame.stamp_ns = 1000000000 + n * std::int64_t{10000000};
  return frame;
}

ParticleSurfaceConstPtr surface_of(int n) {
  std_msgs::Header header;
  header.stamp = to_ros_time(frame_of(n).stamp_ns);
  return boost::make_shared<ParticleSurface>(
      to_surface_message(header, *make_implicit_surface(frame_of(n), parameters_with_spacing(r)), frame_of(n),
                         parameters_with_spacing(r)));
}

struct Complaints {
  std::vector<std::string> texts;
  std::function<void(const std::string&)> note() {
    return [this](const std::string& text) { texts.push_back(text); };
  }
};

TEST(SurfaceInbox, SurfacesWaitForTheirFrameInAnyOrder) {
  Complaints complaints;
  SurfaceInbox inbox(10, seconds(20), complaints.note());
  for (const int n : {2, 0, 1}) inbox.receive(surface_of(n));
  for (const int n : {0, 1, 2}) {
    const auto surface = inbox.wait_for(frame_of(n), parameters_with_spacing(r));
    ASSERT_NE(surface, nullptr) << n;
    EXPECT_EQ(surface->triangulation.vertices,
              make_implicit_surface(frame_of(n), parameters_with_spacing(r))->triangulation.vertices);
  }
  EXPECT_EQ(inbox.taken(), 3u);
  EXPECT_EQ(inbox.missed(), 0u);
  EXPECT_TRUE(complaints.texts.empty());
}

TEST(SurfaceInbox, AFrameWaitsForItsSurface) {
  Complaints complaints;
  SurfaceInbox inbox(10, seconds(20), complaints.note());
  const ParticleSurfaceConstPtr late = surface_of(0);
  std::thread sender([&] {
    std::this_thread::sleep_for(milliseconds(50));
    inbox.receive(late);
  });
  EXPECT_NE(inbox.wait_for(frame_of(0), parameters_with_spacing(r)), nullptr);
  sender.join();
}

TEST(SurfaceInbox, WhatDoesNotComeOrFitIsMissedAndSaid) {
  Complaints complaints;
  SurfaceInbox inbox(10, milliseconds(10), complaints.note());
  EXPECT_EQ(inbox.wait_for(frame_of(0), parameters_with_spacing(r)), nullptr);
  inbox.receive(surface_of(1));
  ParticleFrame others = frame_of(1);
  others.positions[0].x() += 0.01F;
  EXPECT_EQ(inbox.wait_for(others, parameters_with_spacing(r)), nullptr);
  inbox.receive(surface_of(2));
  Parameters finer = parameters_with_spacing(r);
  finer.dx_phi = 0.4;
  EXPECT_EQ(inbox.wait_for(frame_of(2), finer), nullptr);
  inbox.receive(surface_of(1));
  inbox.receive(surface_of(3));
  EXPECT_NE(inbox.wait_for(frame_of(3), parameters_with_spacing(r)), nullptr)
      << "one that came too late is in the way of nobody";
  EXPECT_EQ(inbox.missed(), 3u);
  ASSERT_EQ(complaints.texts.size(), 3u);
  EXPECT_NE(complaints.texts[0].find("0.01 s"), std::string::npos) << complaints.texts[0];
  EXPECT_NE(complaints.texts[1].find("other particles"), std::string::npos);
  EXPECT_NE(complaints.texts[2].find("dx_phi"), std::string::npos);
}

TEST(SurfaceInbox, WhereTooManyWaitTheNewestGiveWayAndNobodyWaitsForThem) {
  Complaints complaints;
  SurfaceInbox inbox(2, seconds(60), complaints.note());
  for (const int n : {0, 3, 1, 2}) inbox.receive(surface_of(n));
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_NE(inbox.wait_for(frame_of(0), parameters_with_spacing(r)), nullptr);
  EXPECT_NE(inbox.wait_for(frame_of(1), parameters_with_spacing(r)), nullptr);
  EXPECT_EQ(inbox.wait_for(frame_of(2), parameters_with_spacing(r)), nullptr);
  EXPECT_EQ(inbox.wait_for(frame_of(3), parameters_with_spacing(r)), nullptr);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, seconds(30));
  inbox.receive(surface_of(4));
  EXPECT_NE(inbox.wait_for(frame_of(4), parameters_with_spacing(r)), nullptr);
}

TEST(SurfaceInbox, WhatIsNotExpectedIsTakenIfItIsThere) {
  Complaints complaints;
  SurfaceInbox inbox(2, std::chrono::hours(1), complaints.note());
  EXPECT_TRUE(inbox.receive(surface_of(1)));
  EXPECT_EQ(inbox.wait_for(frame_of(0), parameters_with_spacing(r), /*is_expected*/ false), nullptr);
  EXPECT_NE(inbox.wait_for(frame_of(1), parameters_with_spacing(r), /*is_expected*/ false), nullptr);
  // Had somebody waited, it would have been taken.
  EXPECT_TRUE(inbox.receive(surface_of(0)));
  EXPECT_FALSE(inbox.receive(surface_of(1)));
  EXPECT_TRUE(inbox.receive(surface_of(2)));
  EXPECT_EQ(inbox.missed(), 1u);
  EXPECT_TRUE(complaints.texts.empty());
}

TEST(SurfaceInbox, WhatComesLaterThanAWaitTakesIsTooLate) {
  Complaints complaints;
  SurfaceInbox inbox(2, milliseconds(10), complaints.note());
  EXPECT_EQ(inbox.wait_for(frame_of(0), parameters_with_spacing(r), /*is_expected*/ false), nullptr);
  const ParticleSurfaceConstPtr late = surface_of(0);
  std::this_thread::sleep_for(milliseconds(20));
  EXPECT_FALSE(inbox.receive(late));
}

TEST(SurfaceInbox, TheSurfaceOfAFirstFrameIsNotLateAsNobodyAsksForIt) {
  Complaints complaints;
  SurfaceInbox inbox(2, milliseconds(0), complaints.note());
  EXPECT_EQ(inbox.wait_for(frame_of(6), parameters_with_spacing(r), /*is_expected*/ false), nullptr);
  EXPECT_EQ(inbox.wait_for(frame_of(7), parameters_with_spacing(r), /*is_expected*/ false), nullptr);
  std::this_thread::sleep_for(milliseconds(1));
  EXPECT_TRUE(inbox.receive(surface_of(5)));
  EXPECT_FALSE(inbox.receive(surface_of(6)));
  // Time goes back to the second frame of another run.
  EXPECT_EQ(inbox.wait_for(frame_of(3), parameters_with_spacing(r), /*is_expected*/ false), nullptr);
  std::this_thread::sleep_for(milliseconds(1));
  EXPECT_TRUE(inbox.receive(surface_of(2)));
  EXPECT_FALSE(inbox.receive(surface_of(3)));
}

TEST(SurfaceInbox, ClosingEndsTheWaiting) {
  Complaints complaints;
  SurfaceInbox inbox(2, std::chrono::hours(1), complaints.note());
  std::thread closer([&] {
    std::this_thread::sleep_for(milliseconds(20));
    inbox.close();
  });
  EXPECT_EQ(inbox.wait_for(frame_of(0), parameters_with_spacing(r)), nullptr);
  closer.join();
}

}  // namespace
}  // namespace particle_surface_tracker::test
