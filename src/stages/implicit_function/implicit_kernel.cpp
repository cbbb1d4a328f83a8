#include "implicit_kernel.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <immintrin.h>

#include "core/exact_multiply_add.h"
#include "core/per_instruction_set.h"

namespace particle_surface_tracker::implicit {

namespace {

using Quad = float __attribute__((vector_size(16)));

/// Points that the differences are kept of at a time: they stay in the innermost cache.
constexpr std::size_t kChunk = 256;

/// Its square is still a number in double precision, and infinite in single.
constexpr float kFarAway = 1e30f;

/// 2 cos(⅔ arccos w) on [0, 1] as a polynomial in w, lowest power first: interpolated at the 11 Chebyshev nodes, off by
/// at most 2e-10. The trigonometric functions of the C library differ between processors in the last bit; this does
/// not.
constexpr int kTrisectionDegree = 10;
constexpr double kTrisection[kTrisectionDegree + 1] = {
    1.00000000016,    1.154700499,     -0.222220619501,   0.106890885732,   -0.0656260625956,  0.0446398189772,
    -0.0305599763071, 0.0187562614456, -0.00897058916069, 0.00280497478988, -0.000415192631243};

#define PST_KERNEL_BODY "stages/implicit_function/implicit_kernel_body.inc"
#include "core/kernel_variants.inc"

}  // namespace

void Points::reserve(std::size_t count) {
  const std::size_t padded = count + kSumLanes;
  if (x.size() >= padded) return;
  x.resize(padded);
  y.resize(padded);
  z.resize(padded);
}

const Kernel& active_kernel() {
  static constexpr PerInstructionSet<Kernel> kernels = {
      {baseline::localize, baseline::select_near, baseline::select_in, baseline::accumulate, baseline::finish},
      {avx2::localize, avx2::select_near, avx2::select_in, avx2::accumulate, avx2::finish},
      {avx512::localize, avx512::select_near, avx512::select_in, avx512::accumulate, avx512::finish}};
  return kernels.active();
}

}  // namespace particle_surface_tracker::implicit
