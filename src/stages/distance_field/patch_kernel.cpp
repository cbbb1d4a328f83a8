#include "patch_kernel.h"

#include <cstring>

#include <immintrin.h>

#include "core/per_instruction_set.h"

namespace particle_surface_tracker {

namespace {

using Quad = float __attribute__((vector_size(16)));

/// Nodes of a patch, and the place of each in it.
constexpr int kPatchNodes = Patch::width * Patch::width;
alignas(64) constexpr float kRow[kPatchNodes] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};
alignas(64) constexpr float kColumn[kPatchNodes] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};

/// Larger than any squared distance in a block.
constexpr float kFar = 1e30f;

#define PST_KERNEL_TARGET
#define PST_KERNEL_LANES 4
namespace baseline {
#include "patch_kernel_body.inc"
}
#undef PST_KERNEL_TARGET
#undef PST_KERNEL_LANES

#define PST_KERNEL_TARGET __attribute__((target("avx2")))
#define PST_KERNEL_LANES 8
namespace avx2 {
#include "patch_kernel_body.inc"
}
#undef PST_KERNEL_TARGET
#undef PST_KERNEL_LANES

}  // namespace

PatchKernel active_patch_kernel() {
  static constexpr PerInstructionSet<PatchKernel> kernels = {baseline::lower_patches, avx2::lower_patches,
                                                             avx2::lower_patches};
  return kernels.active();
}

}  // namespace particle_surface_tracker
