// Bags that were cut off, never closed, or had bits flipped: all that can be read is read, nothing is read wrongly
// without a word where the format can tell, and nothing ever crashes.

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/particle_bag.h"
#include "particle_surface_tracker/ros/particle_conversion.h"
#include "ros_test_support.h"

namespace particle_surface_tracker::test {
namespace {

constexpr int frames = 8;
constexpr std::uint32_t count = 100;

// Positions at which the chunk records of a bag begin.
std::vector<std::size_t> chunk_begins(const std::string& bytes) {
  std::vector<std::size_t> begins;
  for (std::size_t at = bytes.find("compression="); at != std::string::npos; at = bytes.find("compression=", at + 1)) {
    begins.push_back(at - 8);
  }
  return begins;
}

// Frames that are read and are right; every frame that cannot be read must say so.
struct Salvage {
  std::size_t size = 0;
  std::vector<int> good;
  bool said = false;  // That something is wrong.
};

Salvage salvage(const std::string& path) {
  Salvage result;
  ParticleBag bag(path, "/particles");
  result.size = bag.size();
  result.said = !bag.damage().empty();
  for (std::size_t frame = 0; frame < bag.size(); ++frame) {
    try {
      const auto cloud = bag.read(frame);
      for (int n = 0; n < frames; ++n) {
        if (is_numbered_frame(*cloud, n, count)) result.good.push_back(n);
      }
    } catch (const Error&) {
      result.said = true;
    }
  }
  return result;
}

std::vector<int> first_frames(std::size_t number) {
  std::vector<int> numbers;
  for (std::size_t n = 0; n < number; ++n) numbers.push_back(static_cast<int>(n));
  return numbers;
}

class DamagedBag : public testing::TestWithParam<rosbag::CompressionType> {
 protected:
  DamagedBag() : path_(folder_ / "a.bag") {
    write_numbered_bag(path_, frames, count, GetParam());
    bytes_ = read_file(path_);
    begins_ = chunk_begins(bytes_);
  }

  Salvage salvage_of(const std::string& bytes) {
    write_file(path_, bytes);
    return salvage(path_);
  }

  TemporaryFolder folder_;
  std::string path_;
  std::string bytes_;
  std::vector<std::size_t> begins_;
};

TEST_P(DamagedBag, CutAnywhereGivesTheFramesOfItsWholeChunks) {
  ASSERT_EQ(begins_.size(), static_cast<std::size_t>(frames));
  for (std::size_t chunk = 1; chunk < begins_.size(); ++chunk) {
    for (const int offset : {-1, 0, 1, 20, 60, 150, 400}) {
      const Salvage result = salvage_of(bytes_.substr(0, begins_[chunk] + static_cast<std::size_t>(offset)));
      EXPECT_EQ(result.good, first_frames(chunk)) << "chunk " << chunk << " offset " << offset;
      EXPECT_TRUE(result.said) << "chunk " << chunk << " offset " << offset;
    }
  }
}

TEST_P(DamagedBag, CutInTheIndexLosesNothing) {
  for (std::size_t cut = 1; cut < 400; cut += 37) {
    EXPECT_EQ(salvage_of(bytes_.substr(0, bytes_.size() - cut)).good, first_frames(frames)) << cut;
  }
}

TEST_P(DamagedBag, CutBeforeTheFirstChunkIsAnErrorThatSaysSo) {
  for (const std::size_t size : {std::size_t{13}, std::size_t{60}, std::size_t{3000}, begins_[0], begins_[0] + 100}) {
    EXPECT_THROW(salvage_of(bytes_.substr(0, size)), InputError) << size;
  }
}

TEST_P(DamagedBag, FlippedBitInAChunkCostsNoOtherFrame) {
  for (const std::size_t chunk : {std::size_t{1}, std::size_t{4}, std::size_t{7}}) {
    std::string bytes = bytes_;
    // In the middle of the chunk: within the points of the cloud.
    bytes[begins_[chunk] + 600] ^= 0x10;
    const Salvage result = salvage_of(bytes);
    EXPECT_EQ(result.size, static_cast<std::size_t>(frames));
    std::vector<int> others = first_frames(frames);
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(chunk));
    EXPECT_EQ(result.good, others) << chunk;
    // Without compression there is no checksum either.
    EXPECT_EQ(result.said, GetParam() != rosbag::compression::Uncompressed);
  }
}

TEST_P(DamagedBag, DamagedLengthOfAChunkCostsNoOtherFrame) {
  // The length of the data stands behind the header, whose length stands before it.
  for (const unsigned char value : {0x00, 0x7f, 0xff}) {
    std::string bytes = bytes_;
    const std::size_t header = static_cast<unsigned char>(bytes[begins_[3]]);
    bytes[begins_[3] + 4 + header + 3] = static_cast<char>(value == 0 ? 1 : value);
    const Salvage result = salvage_of(bytes);
    EXPECT_TRUE(result.said);
    for (const int n : {0, 1, 2, 4, 5, 6, 7}) {
      EXPECT_EQ(std::count(result.good.begin(), result.good.end(), n), 1) << n;
    }
  }
}

TEST_P(DamagedBag, RandomDamageNeverCrashes) {
  const unsigned seed = 20240229;
  SCOPED_TRACE(testing::Message() << "seed " << seed);
  std::mt19937 random(seed);
  std::size_t opened = 0;
  for (int round = 0; round < 400; ++round) {
    std::string bytes = bytes_;
    const int flips = 1 + static_cast<int>(random() % 20);
    // The first 4 kB are the bag header, almost all of it padding.
    for (int flip = 0; flip < flips; ++flip) {
      bytes[4000 + random() % (bytes.size() - 4000)] ^= static_cast<char>(1 << random() % 8);
    }
    if (round % 4 == 0) bytes.resize(4200 + random() % (bytes.size() - 4200));
    try {
      const Salvage result = salvage_of(bytes);
      ++opened;
      EXPECT_LE(result.good.size(), result.size);
    } catch (const InputError&) {
    }
  }
  EXPECT_GT(opened, 100u);
}

TEST_P(DamagedBag, BagThatIsStillBeingRecordedIsRead) {
  const std::string path = folder_ / "open.bag";
  std::string snapshot;
  {
    rosbag::Bag bag(path, rosbag::bagmode::Write);
    bag.setCompression(GetParam());
    bag.setChunkThreshold(1);
    for (int n = 0; n < frames; ++n) {
      const auto cloud = to_point_cloud(numbered_frame(n, count), "world");
      bag.write("/particles", cloud.header.stamp, cloud);
    }
    // The file as a crash of the recorder would leave it.
    snapshot = read_file(path);
    bag.close();
  }
  const Salvage result = salvage_of(snapshot);
  EXPECT_TRUE(result.said);
  EXPECT_GE(result.good.size(), static_cast<std::size_t>(frames - 3));
  EXPECT_EQ(result.good, first_frames(result.good.size()));
}

INSTANTIATE_TEST_SUITE_P(Compressions, DamagedBag,
                         testing::Values(rosbag::compression::Uncompressed, rosbag::compression::BZ2,
                                         rosbag::compression::LZ4));

}  // namespace
}  // namespace particle_surface_tracker::test
