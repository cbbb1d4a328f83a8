#include "triangle_shape.h"

#include <cstring>

#include <immintrin.h>

#include "core/exact_multiply_add.h"
#include "core/per_instruction_set.h"

namespace particle_surface_tracker {

namespace {

/// Smallest sine of the angle between two sides of a triangle whose normal means something.
constexpr float kSmallestSine = 1e-4f;

alignas(64) constexpr std::int32_t kIota[16] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};

#define PST_KERNEL_BODY "stages/distance_field/triangle_shape_body.inc"
#include "core/kernel_variants.inc"

}  // namespace

const TriangleKernel& active_triangle_kernel() {
  static constexpr PerInstructionSet<TriangleKernel> kernels = {{baseline::make_shapes, baseline::make_normals},
                                                                {avx2::make_shapes, avx2::make_normals},
                                                                {avx512::make_shapes, avx512::make_normals}};
  return kernels.active();
}

}  // namespace particle_surface_tracker
