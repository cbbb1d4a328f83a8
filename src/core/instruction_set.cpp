#include "instruction_set.h"

#include <atomic>

namespace particle_surface_tracker {

namespace {

InstructionSet widest_supported() {
  if (is_supported(InstructionSet::kAvx512)) return InstructionSet::kAvx512;
  return is_supported(InstructionSet::kAvx2) ? InstructionSet::kAvx2 : InstructionSet::kBaseline;
}

std::atomic<InstructionSet>& active() {
  static std::atomic<InstructionSet> set{widest_supported()};
  return set;
}

}  // namespace

bool is_supported(InstructionSet set) {
  switch (set) {
    case InstructionSet::kAvx512:
      return __builtin_cpu_supports("avx512f") != 0;
    case InstructionSet::kAvx2:
      return __builtin_cpu_supports("avx2") != 0 && __builtin_cpu_supports("fma") != 0;
    default:
      return true;
  }
}

InstructionSet active_instruction_set() {
  return active();
}

ForcedInstructionSet::ForcedInstructionSet(InstructionSet set) {
  active() = set;
}

ForcedInstructionSet::~ForcedInstructionSet() {
  active() = widest_supported();
}

}  // namespace particle_surface_tracker
