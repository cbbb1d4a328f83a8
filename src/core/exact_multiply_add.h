#pragma once

#include <cstdint>

#include <emmintrin.h>

namespace particle_surface_tracker {

/// c + a b rounded once, lane by lane, as processors with fused multiply-add do it; for those without.
///
/// The product of two floats is exact in double precision. The sum is rounded to odd there: if it is not exact, its
/// last bit says so, and rounding it again to single precision gives what rounding once would have (Boldo and Melquiond
/// 2008, "Emulation of a FMA and correctly rounded sums: proved algorithms using rounding to odd").
inline __m128 exact_multiply_add(const __m128& a, const __m128& b, const __m128& c) {
  using Doubles = double __attribute__((vector_size(16)));
  using Words = std::int64_t __attribute__((vector_size(16)));
  const auto sum_of_two = [](const Doubles& product, const Doubles& addend) -> __m128d {
    const Doubles sum = product + addend;
    const Doubles back = sum - product;
    const Doubles error = (product - (sum - back)) + (addend - back);
    // Not a number where the sum is none or infinite: then no comparison holds, and it stays.
    const Words is_inexact = (error < 0.0) | (error > 0.0);
    const Words is_even = (Words(sum) & 1) == 0;
    const Words is_short = (error > 0.0) == (sum > 0.0);
    const Words step = (is_short & 1) | (~is_short & -1);
    return Doubles(Words(sum) + (step & is_inexact & is_even));
  };
  const auto upper = [](const __m128& v) { return _mm_cvtps_pd(_mm_movehl_ps(v, v)); };
  const __m128d low = sum_of_two(_mm_cvtps_pd(a) * _mm_cvtps_pd(b), _mm_cvtps_pd(c));
  const __m128d high = sum_of_two(upper(a) * upper(b), upper(c));
  return _mm_movelh_ps(_mm_cvtpd_ps(low), _mm_cvtpd_ps(high));
}

}  // namespace particle_surface_tracker
