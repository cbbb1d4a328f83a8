#pragma once

namespace particle_surface_tracker {

/// Sets of processor instructions that hot kernels are compiled for. All of them give the same bytes.
enum class InstructionSet { kBaseline, kAvx2, kAvx512 };

/// True where this processor can run the set.
bool is_supported(InstructionSet set);

/// The widest set that this processor can run, or the one that ForcedInstructionSet asks for.
InstructionSet active_instruction_set();

/// While it lives, all kernels begun by the process use one set: for tests that compare them.
class ForcedInstructionSet {
 public:
  /// \param set must be supported.
  explicit ForcedInstructionSet(InstructionSet set);
  ~ForcedInstructionSet();
  ForcedInstructionSet(const ForcedInstructionSet&) = delete;
  ForcedInstructionSet& operator=(const ForcedInstructionSet&) = delete;
};

}  // namespace particle_surface_tracker
