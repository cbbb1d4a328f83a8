// c + a b rounded once by plain instructions, against the C library's.

#include "core/exact_multiply_add.h"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace particle_surface_tracker {

namespace {

std::uint32_t bits_of(float value) {
  std::uint32_t bits;
  std::memcpy(&bits, &value, sizeof(bits));
  return bits;
}

float multiply_add(float a, float b, float c) {
  return _mm_cvtss_f32(exact_multiply_add(_mm_set1_ps(a), _mm_set1_ps(b), _mm_set1_ps(c)));
}

void expect_same_as_library(float a, float b, float c) {
  const float expected = std::fma(a, b, c);
  const float result = multiply_add(a, b, c);
  if (std::isnan(expected)) {
    EXPECT_TRUE(std::isnan(result)) << a << " * " << b << " + " << c;
  } else {
    EXPECT_EQ(bits_of(result), bits_of(expected)) << a << " * " << b << " + " << c;
  }
}

TEST(ExactMultiplyAdd, RoundsOnce) {
  // 1 + 2⁻²⁴ is halfway between two floats; the product's tail decides, and is lost where the sum is rounded twice.
  const float a = 1.0f + 0x1p-12f;
  expect_same_as_library(a, a, -1.0f);
  expect_same_as_library(0x1p-12f, 0x1p-12f, 1.0f);
  expect_same_as_library(0x1.000002p-12f, 0x1p-12f, 1.0f);
  expect_same_as_library(0x1.000002p-12f, -0x1.fffffep-13f, 1.0f);
  // In double precision 1 + 2⁻²⁴ + 2⁻⁷⁸ is rounded to the halfway case.
  expect_same_as_library(0x1p-39f, 0x1p-39f, 1.0f + 0x1p-23f);
  expect_same_as_library(0x1.8p-24f, 0x1.555556p-1f, 1.0f);
}

TEST(ExactMultiplyAdd, TakesEveryPairOfSpecialNumbers) {
  const float infinity = std::numeric_limits<float>::infinity();
  const std::vector<float> numbers = {0.0f,       -0.0f,      1.0f,
                                      -1.0f,      1e30f,      -1e30f,
                                      infinity,   -infinity,  std::numeric_limits<float>::quiet_NaN(),
                                      0x1p-149f,  -0x1p-149f, std::numeric_limits<float>::min(),
                                      0x1p-126f,  1.5f,       std::numeric_limits<float>::max(),
                                      -0x1.8p-75f};
  for (const float a : numbers) {
    for (const float b : numbers) {
      for (const float c : numbers) expect_same_as_library(a, b, c);
    }
  }
}

TEST(ExactMultiplyAdd, AgreesOnRandomNumbers) {
  std::mt19937 random(20171);
  RecordProperty("seed", 20171);
  std::uniform_int_distribution<std::uint32_t> any_bits;
  std::uniform_real_distribution<float> near_one(-2.0f, 2.0f);
  std::uniform_int_distribution<int> exponent(-30, 30);
  for (int n = 0; n < 300000; ++n) {
    const float a = near_one(random);
    const float b = near_one(random);
    expect_same_as_library(a, b, std::ldexp(near_one(random), exponent(random)));
    // Sums that nearly cancel.
    expect_same_as_library(a, b, -std::fma(a, b, std::ldexp(near_one(random), -24)));
    float any[3];
    for (float& value : any) {
      const std::uint32_t bits = any_bits(random);
      std::memcpy(&value, &bits, sizeof(value));
    }
    expect_same_as_library(any[0], any[1], any[2]);
  }
}

TEST(ExactMultiplyAdd, KeepsLanesApart) {
  const __m128 result =
      exact_multiply_add(_mm_setr_ps(1, 2, 3, 4), _mm_setr_ps(5, 6, 7, 8), _mm_setr_ps(9, 10, 11, 12));
  alignas(16) float lanes[4];
  _mm_store_ps(lanes, result);
  EXPECT_EQ(lanes[0], 14.0f);
  EXPECT_EQ(lanes[1], 22.0f);
  EXPECT_EQ(lanes[2], 32.0f);
  EXPECT_EQ(lanes[3], 44.0f);
}

}  // namespace

}  // namespace particle_surface_tracker
