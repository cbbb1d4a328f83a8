#include "particle_surface_tracker/core/vertex_components.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

TEST(VertexComponents, NumbersComponentsByTheirLowestVertex) {
  // Components {0, 3, 5}, {1, 2, 7} and {4, 6, 8, 9}, connected in an order that is not theirs.
  const std::vector<Triangle> triangles = {{9, 8, 6}, {5, 3, 0}, {7, 2, 1}, {8, 6, 4}};
  const std::vector<std::uint32_t> expected = {0, 1, 1, 0, 2, 0, 2, 1, 2, 2};
  const VertexComponents found = vertex_components(10, triangles);
  EXPECT_EQ(found.of_vertex, expected);
  EXPECT_EQ(found.count, 3U);
}

TEST(VertexComponents, AgreesWithFloodFillOnARandomGraph) {
  constexpr std::uint32_t kSeed = 20170, kVertices = 600;
  SCOPED_TRACE(kSeed);
  const auto pick = [](std::int32_t i, std::int32_t k) {
    return static_cast<std::uint32_t>((test::hash_noise(kSeed, i, k, 0, 0) + 1.0) / 2.0 * kVertices);
  };
  std::vector<Triangle> triangles;
  for (std::int32_t i = 0; i < 150; ++i) triangles.push_back({pick(i, 0), pick(i, 1), pick(i, 2)});

  std::vector<std::uint32_t> expected(kVertices);
  for (std::uint32_t v = 0; v < kVertices; ++v) expected[v] = v;
  for (bool changed = true; changed;) {
    changed = false;
    for (const Triangle& t : triangles) {
      const std::uint32_t lowest = std::min({expected[t[0]], expected[t[1]], expected[t[2]]});
      for (const std::uint32_t v : t) {
        changed |= expected[v] != lowest;
        expected[v] = lowest;
      }
    }
  }
  std::vector<std::uint32_t> lowest = expected;
  std::sort(lowest.begin(), lowest.end());
  lowest.erase(std::unique(lowest.begin(), lowest.end()), lowest.end());
  for (std::uint32_t& label : expected) {
    label = static_cast<std::uint32_t>(std::lower_bound(lowest.begin(), lowest.end(), label) - lowest.begin());
  }

  const VertexComponents found = vertex_components(kVertices, triangles);
  EXPECT_EQ(found.of_vertex, expected);
  EXPECT_EQ(found.count, lowest.size());
}

}  // namespace
}  // namespace particle_surface_tracker
