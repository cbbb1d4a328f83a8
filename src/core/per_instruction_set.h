#pragma once

#include "instruction_set.h"

namespace particle_surface_tracker {

/// One kernel as it is compiled for each set of instructions.
template <class Kernel>
struct PerInstructionSet {
  Kernel baseline;
  Kernel avx2;
  Kernel avx512;

  /// The one for the active set.
  const Kernel& active() const {
    switch (active_instruction_set()) {
      case InstructionSet::kAvx512:
        return avx512;
      case InstructionSet::kAvx2:
        return avx2;
      default:
        return baseline;
    }
  }
};

}  // namespace particle_surface_tracker
