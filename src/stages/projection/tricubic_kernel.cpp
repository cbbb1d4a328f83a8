#include "tricubic_kernel.h"

#include <cstring>

#include <immintrin.h>

#include "core/exact_multiply_add.h"
#include "core/per_instruction_set.h"

namespace particle_surface_tracker {

namespace {

/// No step of a search that goes on leads farther; whole numbers of 32 bits hold it [cells].
constexpr float kFarthestStep = 1e6f;

// Every lane does the same operations in the same order for all sets of instructions.
#define PST_KERNEL_BODY "stages/projection/tricubic_kernel_body.inc"
#include "core/kernel_variants.inc"

}  // namespace

TricubicKernel active_tricubic_kernel() {
  static constexpr PerInstructionSet<TricubicKernel> kernels = {baseline::evaluate, avx2::evaluate, avx512::evaluate};
  return kernels.active();
}

}  // namespace particle_surface_tracker
