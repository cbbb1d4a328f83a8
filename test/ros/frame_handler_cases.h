#pragma once

#include <gtest/gtest.h>

#include "particle_surface_tracker/ros/frame_handler.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {

/// Spacing of the particles [m].
inline constexpr double r = 0.2;

// A ball of liquid of radius 1 that moves by r / 8 along x in every frame.
inline sensor_msgs::PointCloud2 ball_cloud(int n) {
  ParticleFrame frame =
      fill_with_particles(Vec3d(-1, -1, -1), Vec3d(1, 1, 1), r, 0.0, 0, [](const Vec3d& x) { return x.norm() < 0.95; });
  for (Vec3f& position : frame.positions) position.x() += static_cast<float>(n * r / 8);
  frame.stamp_ns = 1000000000 + n;
  return to_point_cloud(frame, "tank");
}

inline FrameHandlerOptions ball_options() {
  FrameHandlerOptions options;
  options.parameters.particle_spacing = r;
  options.mesh = make_sphere(Vec3d::Zero(), 1.0, 3);
  return options;
}

inline void expect_same_messages(const FrameHandler& a, const FrameHandler& b) {
  const TrackedMesh x = a.message({true, true});
  const TrackedMesh y = b.message({true, true});
  EXPECT_EQ(x.header.stamp, y.header.stamp);
  EXPECT_EQ(x.header.frame_id, y.header.frame_id);
  EXPECT_EQ(x.vertices, y.vertices);
  EXPECT_EQ(x.triangles, y.triangles);
  EXPECT_EQ(x.normals, y.normals);
  EXPECT_EQ(x.velocities, y.velocities);
  EXPECT_EQ(x.delta, y.delta);
  EXPECT_EQ(x.ids, y.ids);
  EXPECT_EQ(x.topology_version, y.topology_version);
}

}  // namespace particle_surface_tracker::test
