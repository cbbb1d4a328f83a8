#include "cloud_message.h"

#include <cstring>

#include <ros/serialization.h>
#include <boost/make_shared.hpp>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

// Steps over the parts of a message without storing them.
class LengthCheck {
 public:
  explicit LengthCheck(const std::vector<std::uint8_t>& bytes) : bytes_(bytes) {}

  void skip(std::uint64_t count) {
    if (count > bytes_.size() - position_) throw InputError("the message is damaged: a length in it is too large");
    position_ += count;
  }

  std::uint32_t length() {
    std::uint32_t value = 0;
    skip(sizeof value);
    std::memcpy(&value, bytes_.data() + position_ - sizeof value, sizeof value);
    return value;
  }

  bool at_end() const { return position_ == bytes_.size(); }

 private:
  const std::vector<std::uint8_t>& bytes_;
  std::uint64_t position_ = 0;
};

void check_lengths(const std::vector<std::uint8_t>& bytes) {
  LengthCheck check(bytes);
  check.skip(4 + 8);           // header.seq, header.stamp
  check.skip(check.length());  // header.frame_id
  check.skip(4 + 4);           // height, width
  for (std::uint32_t field = check.length(); field > 0; --field) {
    check.skip(check.length());  // name
    check.skip(4 + 1 + 4);       // offset, datatype, count
  }
  check.skip(1 + 4 + 4);       // is_bigendian, point_step, row_step
  check.skip(check.length());  // data
  check.skip(1);               // is_dense
  if (!check.at_end()) throw InputError("the message is damaged: it does not end where its lengths say");
}

}  // namespace

sensor_msgs::PointCloud2ConstPtr read_cloud_message(std::vector<std::uint8_t>& bytes) {
  check_lengths(bytes);
  const auto cloud = boost::make_shared<sensor_msgs::PointCloud2>();
  ros::serialization::IStream stream(bytes.data(), static_cast<std::uint32_t>(bytes.size()));
  ros::serialization::deserialize(stream, *cloud);
  return cloud;
}

}  // namespace particle_surface_tracker
