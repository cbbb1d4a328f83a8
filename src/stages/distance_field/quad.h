#pragma once

#include <cstring>

#include <xmmintrin.h>

#include "particle_surface_tracker/core/types.h"

namespace particle_surface_tracker {

/// A point or a vector in one register, with a fourth coordinate of 0. Eigen's vectors of four are put together in
/// memory, where the processor waits for the parts.
using Quad = float __attribute__((vector_size(16)));

inline Quad load_quad(const Vec3f& v) {
  return Quad{v.x(), v.y(), v.z(), 0.0f};
}

inline Quad smaller(const Quad& a, const Quad& b) {
  return _mm_min_ps(a, b);
}

inline Quad larger(const Quad& a, const Quad& b) {
  return _mm_max_ps(a, b);
}

inline Quad cross(const Quad& a, const Quad& b) {
  const Quad a_yzx = __builtin_shufflevector(a, a, 1, 2, 0, 3);
  const Quad b_yzx = __builtin_shufflevector(b, b, 1, 2, 0, 3);
  const Quad zxy = a * b_yzx - a_yzx * b;
  return __builtin_shufflevector(zxy, zxy, 1, 2, 0, 3);
}

inline float dot(const Quad& a, const Quad& b) {
  const Quad products = a * b;
  return products[0] + products[1] + products[2];
}

inline bool is_zero(const Quad& a) {
  return _mm_movemask_ps(_mm_cmpneq_ps(a, Quad{})) == 0;
}

inline Vec3f to_vector(const Quad& a) {
  return {a[0], a[1], a[2]};
}

}  // namespace particle_surface_tracker
