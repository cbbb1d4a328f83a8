#include "cell_kernel.h"

#include <algorithm>
#include <cstring>

#include <immintrin.h>

#include "core/exact_multiply_add.h"
#include "core/per_instruction_set.h"

namespace particle_surface_tracker {

namespace {

/// Larger than any squared distance around a leaf.
constexpr float kFar = 1e30f;

/// Whole numbers are cut off numbers that are positive: std::floor() is a function call on plain x86-64.
constexpr int kUp = 64;

constexpr int kCodeMask = (1 << kCodeBits) - 1;
constexpr std::int32_t kCodeStride[3] = {1 << 2 * kCodeBits, 1 << kCodeBits, 1};
constexpr std::int32_t kFirstCode = kCodeOffset * (kCodeStride[0] + kCodeStride[1] + kCodeStride[2]);

alignas(64) constexpr float kIota[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

#define PST_KERNEL_BODY "stages/distance_field/cell_kernel_body.inc"
#include "core/kernel_variants.inc"

}  // namespace

CellKernel active_cell_kernel() {
  static constexpr PerInstructionSet<CellKernel> kernels = {baseline::lower_cell, avx2::lower_cell, avx512::lower_cell};
  return kernels.active();
}

}  // namespace particle_surface_tracker
