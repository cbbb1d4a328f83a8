// A run that is killed and goes on, again and again, ends with the bytes of one that was left alone.

#include <chrono>
#include <filesystem>
#include <random>
#include <utility>

#include <gtest/gtest.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>

#include "killed_run.h"
#include "particle_surface_tracker/ros/particle_bag.h"
#include "ros_test_support.h"

namespace particle_surface_tracker::test {
namespace {

namespace fs = std::filesystem;
using std::chrono::microseconds;

/// Names of the files that differ.
std::string differences(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
  std::string names;
  for (const auto& [name, bytes] : a) {
    const auto other = b.find(name);
    if (other == b.end() || other->second != bytes) names.append(name).append(" ");
  }
  for (const auto& [name, bytes] : b) {
    if (a.count(name) == 0) names.append(name).append(" ");
  }
  return names;
}

/// Whatever a killed run has left is whole: meshes are those of the end, lines are lines, bags are bags.
void expect_whole(const std::map<std::string, std::string>& left, const std::map<std::string, std::string>& wanted,
                  const std::string& folder) {
  for (const auto& [name, bytes] : left) {
    if (name == "report.jsonl") {
      EXPECT_EQ(wanted.at(name).rfind(bytes, 0), 0u) << bytes;
    } else if (name == "out/frames.pvd") {
      const std::string listed = bytes.substr(0, bytes.rfind("</Collection>"));
      EXPECT_EQ(wanted.at(name).rfind(listed, 0), 0u) << bytes;
      EXPECT_EQ(bytes.substr(listed.size()), "</Collection>\n</VTKFile>\n");
    } else if (name.find(".parts/") != std::string::npos) {
      rosbag::Bag bag(std::string(folder).append("/").append(name));
      EXPECT_GT(rosbag::View(bag).size(), 0u) << name;
    } else {
      EXPECT_EQ(bytes, wanted.at(name)) << name;
    }
  }
}

using Clock = std::chrono::steady_clock;

/// A moment in a run that began with a checkpoint, or will have one soon: drawn when the checkpoint is there.
class RandomMoment {
 public:
  /// \param checkpoint file.
  /// \param longest time from the checkpoint to the end of a run.
  RandomMoment(std::string checkpoint, microseconds longest, std::mt19937& random)
      : checkpoint_(std::move(checkpoint)), longest_(longest), random_(random) {}

  bool has_come() {
    if (drawn_) return Clock::now() > moment_;
    if (!fs::exists(checkpoint_)) return false;
    drawn_ = true;
    begin_ = Clock::now();
    moment_ = begin_ + microseconds(std::uniform_int_distribution<std::int64_t>(0, longest_.count())(random_));
    return false;
  }

  /// For how long there has been a checkpoint.
  microseconds since_checkpoint() const {
    return drawn_ ? std::chrono::duration_cast<microseconds>(Clock::now() - begin_) : microseconds(0);
  }

 private:
  std::string checkpoint_;
  microseconds longest_;
  std::mt19937& random_;
  bool drawn_ = false;
  Clock::time_point begin_;
  Clock::time_point moment_;
};

constexpr int kKilledRuns = 20;
constexpr int kMostKills = 3;  // Of one run; then it may go on to its end.

TEST(KillAndResume, TwentyRunsAtRandomMoments) {
  const KilledRun runs;
  const auto begin = Clock::now();
  ASSERT_EQ(runs.run("left_alone", {}), 0) << runs.output("left_alone");
  auto longest = std::chrono::duration_cast<microseconds>(Clock::now() - begin);
  const auto wanted = runs.files("left_alone");
  ASSERT_EQ(wanted.size(), 2u * (KilledRun::frames - 1) + 2u);

  const unsigned seed = std::random_device()();
  std::cout << "seed " << seed << '\n';
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> interval(1, 5);
  int killed_runs = 0;
  int kills = 0;
  for (int n = 0; killed_runs < kKilledRuns; ++n) {
    ASSERT_LT(n, 10 * kKilledRuns) << "only " << killed_runs << " could be killed";
    const std::string name = "killed_" + std::to_string(n);
    const std::string checkpoint = runs.path(name) + "/run.checkpoint";
    const std::string every = std::to_string(interval(random));
    int killed = 0;
    for (int code = -1; code != 0;) {
      std::vector<std::string> arguments = {"--checkpoint", "@/run.checkpoint", "--checkpoint-every", every};
      if (killed > 0) arguments.insert(arguments.end(), {"--resume", "@/run.checkpoint"});
      RandomMoment moment(checkpoint, longest, random);
      code = runs.run(name, arguments, [&] { return killed < kMostKills && moment.has_come(); });
      ASSERT_TRUE(code == 0 || code == -1) << runs.output(name);
      if (code == 0) {
        // One that has come to its end first does not count, and tells how long the next ones take.
        if (killed == 0) longest = moment.since_checkpoint();
        break;
      }
      ++killed;
      ASSERT_TRUE(fs::exists(checkpoint));
      expect_whole(runs.files(name), wanted, runs.path(name));
    }
    if (killed > 0) {
      EXPECT_NE(runs.output(name).find("going on with frame"), std::string::npos) << runs.output(name);
      ++killed_runs;
      kills += killed;
    }
    ASSERT_EQ(differences(runs.files(name), wanted), "") << "run " << n;
    ASSERT_FALSE(fs::exists(runs.path(name) + "/out.bag.parts"));
    fs::remove_all(runs.path(name));
  }
  std::cout << killed_runs << " runs killed, " << kills << " kills, gone on after each\n";
}

TEST(KillAndResume, WithoutCheckpointsTheBagSoFarCanBeReadAndTheRunBeginsAgain) {
  const KilledRun runs;
  const std::string part = runs.path("killed") + "/out.bag.part";
  // What is in a whole chunk is in the file; the first is complete in the middle of the run.
  constexpr std::uintmax_t more_than_a_chunk = 800000;
  const auto has_a_chunk = [&] {
    std::error_code gone;
    const std::uintmax_t size = fs::file_size(part, gone);
    return !gone && size > more_than_a_chunk;
  };
  int code = 0;  // A busy machine may kill too late.
  for (int n = 0; n < 10 && code == 0; ++n) {
    fs::remove_all(runs.path("killed"));
    code = runs.run("killed", {}, has_a_chunk);
  }
  ASSERT_EQ(code, -1) << "the bag is too small for this test";
  EXPECT_FALSE(fs::exists(runs.path("killed") + "/out.bag"));
  {
    ParticleBag bag(part, "/particles");
    EXPECT_GT(bag.size(), 1u);
    EXPECT_NO_THROW(bag.read(0));
  }
  ASSERT_EQ(runs.run("killed", {}), 0) << runs.output("killed");
  ASSERT_EQ(runs.run("left_alone", {}), 0);
  EXPECT_EQ(differences(runs.files("killed"), runs.files("left_alone")), "");
}

class Resume : public testing::Test {
 protected:
  // Tracks the first seven frames, with checkpoints after the fifth and the last.
  void SetUp() override {
    ASSERT_EQ(runs_.run("a", {"--last", "6", "--checkpoint", "@/c", "--checkpoint-every", "5"}), 0);
  }

  void expect_refusal(int code, std::vector<std::string> arguments, const std::string& word) {
    arguments.insert(arguments.begin(), {"--resume", "@/c"});
    EXPECT_EQ(runs_.run("a", arguments), code) << word;
    EXPECT_NE(runs_.output("a").find(word), std::string::npos) << runs_.output("a");
  }

  KilledRun runs_;
};

TEST_F(Resume, AFinishedRunCanBeExtended) {
  ASSERT_EQ(runs_.run("a", {"--resume", "@/c", "--last", "9"}), 0) << runs_.output("a");
  EXPECT_NE(runs_.output("a").find("going on with frame 7"), std::string::npos) << runs_.output("a");
  ASSERT_EQ(runs_.run("a", {"--resume", "@/c"}), 0) << runs_.output("a");
  ASSERT_EQ(runs_.run("a", {"--resume", "@/c"}), 0) << "with nothing left to do: " << runs_.output("a");
  ASSERT_EQ(runs_.run("b", {}), 0);
  EXPECT_EQ(differences(runs_.files("a"), runs_.files("b")), "");
}

TEST_F(Resume, ATimeSeriesGoesOnBehindAKill) {
  ASSERT_EQ(runs_.run("b", {"--format", "vtp"}), 0);
  const auto wanted = runs_.files("b");
  ASSERT_EQ(wanted.count("out/frames.pvd"), 1u);
  // Killed behind a checkpoint: the series has frames that come once more. A busy machine may kill too late.
  const std::string later = runs_.path("c") + "/out/frame_000008.vtp";
  const std::vector<std::string> arguments = {"--format", "vtp", "--checkpoint", "@/c", "--checkpoint-every", "7"};
  int code = 0;
  for (int n = 0; n < 10 && code == 0; ++n) {
    fs::remove_all(runs_.path("c"));
    code = runs_.run("c", arguments, [&] { return fs::exists(later); });
  }
  ASSERT_EQ(code, -1) << "the bag is too small for this test";
  expect_whole(runs_.files("c"), wanted, runs_.path("c"));
  ASSERT_EQ(runs_.run("c", {"--format", "vtp", "--resume", "@/c"}), 0) << runs_.output("c");
  EXPECT_NE(runs_.output("c").find("going on with frame"), std::string::npos) << runs_.output("c");
  EXPECT_EQ(differences(runs_.files("c"), wanted), "");
  // A run that began without one would lack the frames before.
  expect_refusal(2, {"--format", "vtp"}, "frames.pvd");
}

TEST_F(Resume, TheSpacingOfARunThatEstimatedItIsThatOfTheCheckpoint) {
  ASSERT_EQ(runs_.run("a", {"--resume", "@/c", "--spacing", "auto"}), 0) << runs_.output("a");
  ASSERT_EQ(runs_.run("b", {}), 0);
  EXPECT_EQ(differences(runs_.files("a"), runs_.files("b")), "");
}

TEST_F(Resume, WhatDoesNotFitIsSaid) {
  expect_refusal(1, {"--set", "tau=0.4", "--set", "epsilon=0.5"}, "tau is 0.5 there and 0.4 here");
  expect_refusal(1, {"--set", "tau=0.4", "--set", "epsilon=0.5"}, "epsilon is 0.35 there and 0.5 here");
  expect_refusal(1, {"--spacing", "0.21"}, "particle_spacing is 0.2 there and 0.21 here");
  expect_refusal(1, {"--first", "1"}, "began with frame 0");
  expect_refusal(1, {"--interpolate", "velocity,rgb"}, "'velocity,rgb', but the run of the checkpoint had ''");
  expect_refusal(1, {"--last", "3"}, "goes on with frame 7");
  expect_refusal(2, {"--report", "@/other.jsonl"}, "other.jsonl");
  expect_refusal(2, {"--out-bag", "@/other.bag"}, "other.bag");
  write_numbered_bag(runs_.path("other.bag"), 16, 50);
  expect_refusal(2, {"--bag", runs_.path("other.bag")}, "frame 6");
  // None of this has harmed what there was.
  ASSERT_EQ(runs_.run("a", {"--resume", "@/c"}), 0) << runs_.output("a");
  ASSERT_EQ(runs_.run("b", {}), 0);
  EXPECT_EQ(differences(runs_.files("a"), runs_.files("b")), "");
}

TEST_F(Resume, WhatIsNoCheckpointIsSaid) {
  write_file(runs_.path("a") + "/c", "nothing");
  expect_refusal(2, {}, "no checkpoint");
  fs::remove(runs_.path("a") + "/c");
  expect_refusal(2, {}, "No such file");
  EXPECT_EQ(runs_.run("a", {"--checkpoint-every", "3"}), 1);
  EXPECT_EQ(runs_.run("a", {"--checkpoint", "@/c", "--checkpoint-every", "0"}), 1);
  EXPECT_EQ(runs_.run("a", {"--checkpoint", "@/missing/c"}), 4) << runs_.output("a");
}

TEST_F(Resume, APipelineChangesNoByte) {
  ASSERT_EQ(runs_.run("b", {}), 0);
  ASSERT_EQ(runs_.run("c", {"--pipeline"}), 0);
  EXPECT_EQ(differences(runs_.files("c"), runs_.files("b")), "");
  ASSERT_EQ(runs_.run("a", {"--resume", "@/c", "--pipeline"}), 0) << runs_.output("a");
  EXPECT_EQ(differences(runs_.files("a"), runs_.files("b")), "");
}

}  // namespace
}  // namespace particle_surface_tracker::test
