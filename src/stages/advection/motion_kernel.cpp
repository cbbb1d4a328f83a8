#include "motion_kernel.h"

#include <algorithm>
#include <cstring>

#include <immintrin.h>

#include "core/exact_multiply_add.h"
#include "core/per_instruction_set.h"

namespace particle_surface_tracker {

namespace {

#define PST_KERNEL_BODY "stages/advection/motion_kernel_body.inc"
#include "core/kernel_variants.inc"

}  // namespace

const MotionKernel& active_motion_kernel() {
  static constexpr PerInstructionSet<MotionKernel> kernels = {
      {baseline::gather, baseline::refer, baseline::sum, baseline::fit},
      {avx2::gather, avx2::refer, avx2::sum, avx2::fit},
      {avx512::gather, avx512::refer, avx512::sum, avx512::fit}};
  return kernels.active();
}

}  // namespace particle_surface_tracker
