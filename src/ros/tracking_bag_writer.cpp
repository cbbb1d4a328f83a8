#include "particle_surface_tracker/ros/tracking_bag_writer.h"

#include <algorithm>
#include <filesystem>
#include <utility>

#include <fmt/format.h>
#include <rosbag/bag.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

[[noreturn]] void fail(const std::string& path, const std::string& reason) {
  throw OutputError(fmt::format("cannot write bag '{}': {}", path, reason));
}

// A bag takes no message of time 0, which is what a simulation may begin with.
ros::Time record_time(const std_msgs::Header& header) {
  return std::max(header.stamp, ros::TIME_MIN);
}

}  // namespace

struct TrackingBagWriter::Bag {
  rosbag::Bag file;
  bool has_frames = false;
};

TrackingBagWriter::TrackingBagWriter(std::string path, std::string particle_topic)
    : path_(std::move(path)),
      temporary_path_(path_ + ".part"),
      particle_topic_(std::move(particle_topic)),
      bag_(std::make_unique<Bag>()) {
  if (std::filesystem::is_directory(path_)) fail(path_, "it is a folder");
  try {
    bag_->file.open(temporary_path_, rosbag::bagmode::Write);
  } catch (const rosbag::BagException& error) {
    abandon();
    std::error_code ignored;
    std::filesystem::remove(temporary_path_, ignored);
    fail(path_, error.what());
  }
}

TrackingBagWriter::~TrackingBagWriter() {
  try {
    close();
  } catch (const OutputError&) {
    // Whoever wants to know calls close().
  }
}

template <class Message>
void TrackingBagWriter::append(const std::string& topic, const std_msgs::Header& header, const Message& message) {
  try {
    bag_->file.write(topic, record_time(header), message);
  } catch (const rosbag::BagException& error) {
    abandon();
    fail(path_, fmt::format("{}; what was written is in '{}'", error.what(), temporary_path_));
  }
}

void TrackingBagWriter::write(const sensor_msgs::PointCloud2ConstPtr& particles) {
  append(particle_topic_, particles->header, particles);
  bag_->has_frames = true;
}

void TrackingBagWriter::write(const sensor_msgs::PointCloud2ConstPtr& particles, const TrackedMesh& mesh) {
  write(particles);
  append(mesh_topic, mesh.header, mesh);
}

void TrackingBagWriter::abandon() {
  static_cast<void>(bag_.release());
}

void TrackingBagWriter::close() {
  if (!bag_) return;
  const bool has_frames = bag_->has_frames;
  try {
    bag_->file.close();
  } catch (const rosbag::BagException& failure) {
    abandon();
    fail(path_, fmt::format("{}; what was written is in '{}'", failure.what(), temporary_path_));
  }
  bag_.reset();
  std::error_code error;
  if (has_frames) {
    std::filesystem::rename(temporary_path_, path_, error);
    if (error) fail(path_, error.message());
  } else {
    std::filesystem::remove(temporary_path_, error);
  }
}

}  // namespace particle_surface_tracker
