#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace particle_surface_tracker {

/// The largest k in [lower, upper] for which holds(k), where holds(lower) is known, and holds(k) means that it holds
/// for all below. Asks once or twice where `guess` is right, and about twice the logarithm of the error elsewhere.
template <typename Holds>
std::int32_t last_true(std::int32_t lower, std::int32_t upper, double guess, Holds&& holds) {
  if (lower == upper) return lower;
  const auto clamped = [&](double value) {
    if (!(value > lower)) return lower;
    return value < upper ? static_cast<std::int32_t>(std::floor(value)) : upper;
  };
  std::int64_t stride = 1;
  std::int32_t middle = clamped(guess);
  if (middle == lower || holds(middle)) {
    lower = middle;
    while (lower < upper) {
      middle = static_cast<std::int32_t>(std::min<std::int64_t>(lower + stride, upper));
      if (!holds(middle)) {
        upper = middle - 1;
        break;
      }
      lower = middle;
      stride *= 2;
    }
  } else {
    upper = middle - 1;
    while (lower < upper) {
      middle = static_cast<std::int32_t>(std::max<std::int64_t>(upper - stride + 1, lower + 1));
      if (holds(middle)) {
        lower = middle;
        break;
      }
      upper = middle - 1;
      stride *= 2;
    }
  }
  while (lower < upper) {
    middle = static_cast<std::int32_t>(lower + (static_cast<std::int64_t>(upper) - lower + 1) / 2);
    if (holds(middle)) {
      lower = middle;
    } else {
      upper = middle - 1;
    }
  }
  return lower;
}

}  // namespace particle_surface_tracker
