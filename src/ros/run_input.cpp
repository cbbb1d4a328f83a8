#include "run_input.h"

#include <fmt/format.h>

#include "particle_surface_tracker/io/byte_stream.h"

namespace particle_surface_tracker {
namespace {

/// Name of the section of a checkpoint.
constexpr const char* kSection = "track_bag_input";

const char* text_of(InputSequence::Verdict verdict) {
  switch (verdict) {
    case InputSequence::Verdict::kRepeated:
      return "its stamp is that of the frame before";
    case InputSequence::Verdict::kLate:
      return "its stamp is below that of the frame before";
    case InputSequence::Verdict::kWentBack:
      return "its stamp goes back: does the bag hold more than one recording?";
    case InputSequence::Verdict::kOtherFrameId:
      return "its frame_id is another than before";
    case InputSequence::Verdict::kFirst:
    case InputSequence::Verdict::kNext:
      break;
  }
  return "";
}

}  // namespace

std::string RunInput::judge(const std_msgs::Header& header, FrameReport& report) {
  const InputSequence::Judgement judgement = sequence_.judge(header);
  report.missing_frames = judgement.missing;
  if (judgement.missing != 0) {
    report.warnings.push_back(
        fmt::format("{} missing before it",
                    judgement.missing == 1 ? "1 frame is" : fmt::format("{} frames are", judgement.missing)));
  }
  return text_of(judgement.verdict);
}

void RunInput::save(Checkpoint& checkpoint) const {
  ByteWriter bytes;
  sequence_.put(bytes);
  checkpoint.sections[kSection] = bytes.bytes();
}

void RunInput::load(const Checkpoint& checkpoint) {
  const auto section = checkpoint.sections.find(kSection);
  if (section == checkpoint.sections.end()) return;
  ByteReader reader(section->second);
  sequence_ = InputSequence::take(reader);
  reader.expect_end();
}

}  // namespace particle_surface_tracker
