#include "leaf_values.h"

#include <emmintrin.h>

#include "particle_surface_tracker/core/signed_distance_field.h"

namespace particle_surface_tracker {

namespace {

/// What rounding leaves of the squared distance of a node next to the isosurface [cells²]. No distance becomes 0, which
/// would have lost its sign.
constexpr float kSmallestSquared = 1e-8f;

/// All bits of lane n where bit n of the lowest four is set.
__m128 lanes_of(std::uint64_t bits) {
  const __m128i lane = _mm_setr_epi32(1, 2, 4, 8);
  const __m128i in_all = _mm_set1_epi32(static_cast<int>(bits & 15));
  return _mm_castsi128_ps(_mm_cmpeq_epi32(_mm_and_si128(in_all, lane), lane));
}

template <typename Test>
LeafWords nodes_where(const float* values, Test&& test) {
  LeafWords nodes{};
  const auto test_four = [&](int n) { return _mm_castps_si128(test(_mm_loadu_ps(values + n))); };
  for (int n = 0; n < 512; n += 16) {
    const __m128i low = _mm_packs_epi32(test_four(n), test_four(n + 4));
    const __m128i high = _mm_packs_epi32(test_four(n + 8), test_four(n + 12));
    const auto found = static_cast<std::uint32_t>(_mm_movemask_epi8(_mm_packs_epi16(low, high)));
    nodes[n >> 6] |= std::uint64_t{found} << (n & 63);
  }
  return nodes;
}

}  // namespace

LeafWords nodes_at_most(const float* values, float limit) {
  const __m128 limits = _mm_set1_ps(limit);
  return nodes_where(values, [&](const __m128& four) { return _mm_cmple_ps(four, limits); });
}

LeafWords nodes_at_least_zero(const float* values) {
  return nodes_where(values, [](const __m128& four) { return _mm_cmpge_ps(four, _mm_setzero_ps()); });
}

void sign_values(const float* squared, const LeafWords& inside, const LeafWords& outside, float dx, float* values) {
  const __m128 smallest = _mm_set1_ps(kSmallestSquared);
  const __m128 absent = _mm_set1_ps(SignedDistanceField::absent);
  const __m128 sign_bit = _mm_set1_ps(-0.0f);
  const __m128 unit = _mm_set1_ps(dx);
  for (int n = 0; n < 512; n += 4) {
    const std::uint64_t negative = inside[n >> 6] >> (n & 63);
    const __m128 is_there = lanes_of(negative | outside[n >> 6] >> (n & 63));
    const __m128 sign = _mm_and_ps(lanes_of(negative), sign_bit);
    const __m128 distance = _mm_mul_ps(_mm_sqrt_ps(_mm_max_ps(_mm_loadu_ps(squared + n), smallest)), unit);
    _mm_storeu_ps(values + n,
                  _mm_or_ps(_mm_and_ps(is_there, _mm_or_ps(distance, sign)), _mm_andnot_ps(is_there, absent)));
  }
}

}  // namespace particle_surface_tracker
