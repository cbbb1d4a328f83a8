#include "particle_surface_tracker/ros/particle_bag.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <boost/make_shared.hpp>

#include "bag_messages.h"
#include "cloud_message.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

using CloudTraits = ros::message_traits::DataType<sensor_msgs::PointCloud2>;
using CloudSum = ros::message_traits::MD5Sum<sensor_msgs::PointCloud2>;

std::string list_of_topics(const BagIndex& index) {
  std::set<std::string> topics;
  for (const auto& [id, connection] : index.connections) {
    topics.insert(fmt::format("{} ({})", connection.topic, connection.type));
  }
  return topics.empty() ? "none" : fmt::format("{}", fmt::join(topics, ", "));
}

std::set<std::uint32_t> connections_of(const BagIndex& index, const std::string& path, const std::string& topic) {
  std::set<std::uint32_t> found;
  for (const auto& [id, connection] : index.connections) {
    if (connection.topic != topic) continue;
    if (connection.type != CloudTraits::value()) {
      throw InputError(fmt::format("bag '{}': topic {} has messages of type {}, wanted {}", path, topic,
                                   connection.type, CloudTraits::value()));
    }
    if (connection.md5sum != CloudSum::value()) {
      throw InputError(fmt::format("bag '{}': topic {} has messages of another version of {} (sum {}, wanted {})", path,
                                   topic, connection.type, connection.md5sum, CloudSum::value()));
    }
    found.insert(id);
  }
  return found;
}

}  // namespace

struct ParticleBag::Contents {
  explicit Contents(const std::string& path) : messages(path) {}

  BagMessages messages;
  std::vector<BagMessage> frames;
};

ParticleBag::ParticleBag(const std::string& path, const std::string& topic) {
  try {
    contents_ = std::make_unique<Contents>(path);
  } catch (const InputError& error) {
    throw InputError(fmt::format("bag '{}': {}", path, error.what()));
  }
  const BagIndex& index = contents_->messages.index();
  const std::set<std::uint32_t> connections = connections_of(index, path, topic);
  std::vector<BagMessage>& frames = contents_->frames;
  for (const BagMessage& message : index.messages) {
    if (connections.count(message.connection) != 0) frames.push_back(message);
  }
  if (frames.empty()) {
    const std::string damage = index.damage.empty() ? "" : "; " + index.damage.front();
    throw InputError(fmt::format("bag '{}' holds no messages of topic {}; it has: {}{}", path, topic,
                                 list_of_topics(index), damage));
  }
  std::stable_sort(frames.begin(), frames.end(),
                   [](const BagMessage& a, const BagMessage& b) { return a.time_ns < b.time_ns; });
}

ParticleBag::~ParticleBag() = default;

std::size_t ParticleBag::size() const {
  return contents_->frames.size();
}

const std::vector<std::string>& ParticleBag::damage() const {
  return contents_->messages.index().damage;
}

sensor_msgs::PointCloud2ConstPtr ParticleBag::read(std::size_t frame) {
  std::vector<std::uint8_t> bytes = contents_->messages.read(contents_->frames.at(frame));
  return read_cloud_message(bytes);
}

}  // namespace particle_surface_tracker
