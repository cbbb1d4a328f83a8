#include "squared_distances.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/core/signed_distance_field.h"

namespace particle_surface_tracker {

namespace {

/// Places in the array are whole numbers of 32 bits.
constexpr std::size_t kMostLeaves = std::numeric_limits<std::int32_t>::max() / SquaredDistances::leaf_size;

std::unique_ptr<float[]> make_values(std::size_t leaf_count) {
  if (leaf_count > kMostLeaves) {
    throw TrackingError(
        fmt::format("a distance field of {} leaves of 8 x 8 x 8 nodes is too large, at most {} can be; "
                    "make dx_phi larger",
                    leaf_count, kMostLeaves));
  }
  return std::unique_ptr<float[]>(new float[leaf_count * SquaredDistances::leaf_size]);
}

}  // namespace

SquaredDistances::SquaredDistances(std::size_t leaf_count) : values_(make_values(leaf_count)) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, leaf_count, 16), [&](const auto& range) {
    std::fill(leaf(range.begin()), leaf(range.end()), SignedDistanceField::absent);
  });
}

}  // namespace particle_surface_tracker
