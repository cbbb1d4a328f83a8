#include "bag_parts.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <ros/serialization.h>

#include "bag_messages.h"
#include "cloud_message.h"
#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

namespace fs = std::filesystem;

void require_file(const std::string& path, const std::string& bag) {
  std::error_code ignored;
  if (fs::is_regular_file(path, ignored)) return;
  throw InputError(fmt::format(
      "cannot go on with bag '{}': '{}' is not there. A run that went on later may have completed the bag", bag, path));
}

TrackedMesh mesh_in(std::vector<std::uint8_t> bytes) {
  try {
    TrackedMesh mesh;
    ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
    ros::serialization::deserialize(stream, mesh);
    return mesh;
  } catch (const std::exception& error) {
    throw InputError(fmt::format("a mesh in it is damaged: {}", error.what()));
  }
}

}  // namespace

BagParts::BagParts(std::string path, std::string particle_topic, const BagProgress& from)
    : path_(std::move(path)), folder_(path_ + ".parts"), particle_topic_(std::move(particle_topic)), progress_(from) {
  if (progress_.has_whole) require_file(path_, path_);
  for (std::uint64_t n = 0; n < progress_.parts; ++n) require_file(part(n), path_);
  std::error_code error;
  fs::create_directories(folder_, error);
  if (error) throw OutputError(fmt::format("cannot write bag '{}': folder '{}': {}", path_, folder_, error.message()));
  remove_other_parts();
  // A bag that cannot be written is found out now.
  in_work_ = std::make_unique<TrackingBagWriter>(part(progress_.parts), particle_topic_);
}

void BagParts::remove_other_parts() const {
  std::set<fs::path> kept;
  for (std::uint64_t n = 0; n < progress_.parts; ++n) kept.insert(part(n));
  std::vector<fs::path> others;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_)) {
    const bool is_part = entry.path().filename().string().rfind("part_", 0) == 0;
    if (is_part && kept.count(entry.path()) == 0) others.push_back(entry.path());
  }
  std::error_code ignored;
  for (const fs::path& other : others) fs::remove(other, ignored);
}

std::string BagParts::part(std::uint64_t number) const {
  return (fs::path(folder_) / fmt::format("part_{:06}.bag", number)).string();
}

void BagParts::write(const sensor_msgs::PointCloud2ConstPtr& particles, const TrackedMesh& mesh) {
  if (in_work_ == nullptr) in_work_ = std::make_unique<TrackingBagWriter>(part(progress_.parts), particle_topic_);
  in_work_->write(particles, mesh);
}

BagProgress BagParts::end_part() {
  if (in_work_ == nullptr) return progress_;
  in_work_->close();
  in_work_.reset();
  // One without a frame has left no file.
  if (fs::exists(part(progress_.parts))) ++progress_.parts;
  return progress_;
}

BagProgress BagParts::join() {
  end_part();
  if (progress_.parts == 0) return progress_;
  TrackingBagWriter whole(path_, particle_topic_);
  if (progress_.has_whole) copy(path_, whole);
  for (std::uint64_t n = 0; n < progress_.parts; ++n) copy(part(n), whole);
  whole.close();
  progress_ = {/*has_whole*/ true, /*parts*/ 0};
  return progress_;
}

// In the order in which they were written, which is not that of their stamps where the input has some that go back.
void BagParts::copy(const std::string& from, TrackingBagWriter& to) const {
  try {
    BagMessages bag(from);
    std::vector<BagMessage> messages = bag.index().messages;
    std::sort(messages.begin(), messages.end(), [](const BagMessage& a, const BagMessage& b) {
      return std::tie(a.chunk, a.position) < std::tie(b.chunk, b.position);
    });
    if (messages.size() % 2 != 0 || !bag.index().damage.empty()) throw InputError("it is not complete");
    for (std::size_t n = 0; n < messages.size(); n += 2) {
      std::vector<std::uint8_t> particles = bag.read(messages[n]);
      to.write(read_cloud_message(particles), mesh_in(bag.read(messages[n + 1])));
    }
  } catch (const InputError& error) {
    throw InputError(fmt::format("cannot read '{}': {}", from, error.what()));
  }
}

void BagParts::remove_parts() {
  std::error_code ignored;
  fs::remove_all(folder_, ignored);
}

}  // namespace particle_surface_tracker
