#include "frame_ahead.h"

#include <utility>

#include "particle_surface_tracker/ros/particle_conversion.h"
#include "particle_surface_tracker/tracker/make_implicit_surface.h"

namespace particle_surface_tracker {

FrameAhead::FrameAhead(sensor_msgs::PointCloud2ConstPtr cloud, const Parameters& parameters)
    : cloud_(std::move(cloud)), prepared_(std::async(std::launch::async, [cloud = cloud_, parameters] {
        PreparedFrame prepared;
        prepared.particles = to_particle_frame(*cloud);
        if (prepared.particles.empty()) return prepared;
        FrameReport report;
        prepared.surface = make_implicit_surface(prepared.particles, parameters, &report);
        prepared.times = std::move(report.times);
        return prepared;
      })) {}

}  // namespace particle_surface_tracker
