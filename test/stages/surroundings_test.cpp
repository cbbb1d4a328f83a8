#include "stages/upkeep/surroundings.h"

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "stages/upkeep/editable_surface.h"
#include "stages/upkeep/half_edges.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

using Box = Eigen::AlignedBox3f;
using Indices = std::vector<std::uint32_t>;

constexpr double kCell = 0.05;

/// Small and large triangles, near each other and far away.
TriangleMesh some_bodies() {
  return test::joined({test::make_sphere({0, 0, 0}, 0.5, 4), test::make_sphere({0.9, 0.1, 0}, 0.3, 3),
                       test::make_box({-3, -3, -3}, {3, 3, 3}), test::make_sphere({40, 0, 0}, 0.5, 2)});
}

Box box_of(const EditableSurface& surface, std::uint32_t triangle) {
  Box box;
  for (const std::uint32_t v : surface.triangle(triangle)) box.extend(surface.stored_position(v));
  return box;
}

Box random_box(std::mt19937& random, double extent) {
  std::uniform_real_distribution<float> place(-1.2F, 1.2F), size(0.0F, static_cast<float>(extent));
  const Vec3f lower(place(random), place(random), place(random));
  return {lower, lower + Vec3f(size(random), size(random), size(random))};
}

Indices found_near(Surroundings& surroundings, const Box& box) {
  Indices found;
  surroundings.for_each_near(box, [&](const Surroundings::Entry& entry) { found.push_back(entry.triangle); });
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

Indices all_near(const EditableSurface& surface, const Box& box) {
  Indices all;
  for (std::uint32_t t = 0; t < surface.triangle_slots(); ++t) {
    if (box_of(surface, t).intersects(box)) all.push_back(t);
  }
  return all;
}

class SurroundingsOfBodies : public testing::Test {
 protected:
  TriangleMesh mesh_ = some_bodies();
  Indices twins_ = [this] {
    Indices twins;
    pair_half_edges(mesh_.vertex_count(), mesh_.triangles(), twins);
    return twins;
  }();
  EditableSurface surface_{mesh_, twins_};
};

TEST_F(SurroundingsOfBodies, FindAllThatIsNear) {
  Surroundings surroundings(surface_, kCell);
  std::mt19937 random(1);
  int with_triangles = 0;
  for (int n = 0; n < 2000; ++n) {
    const Box box = random_box(random, n % 5 == 0 ? 5.0 : 0.2);
    const Indices all = all_near(surface_, box);
    with_triangles += all.empty() ? 0 : 1;
    ASSERT_EQ(found_near(surroundings, box), all);
  }
  EXPECT_GT(with_triangles, 300);
}

TEST_F(SurroundingsOfBodies, KnowWhatHasMoved) {
  Surroundings surroundings(surface_, kCell);
  std::mt19937 random(2);
  const auto last = static_cast<std::uint32_t>(surface_.triangle_slots() - 1);
  for (const std::uint32_t triangle : {0U, 800U, 1500U, last}) {
    // One corner far away, then back, then a little aside.
    Vec3f& corner = mesh_.positions()[surface_.triangle(triangle)[0]];
    const Vec3f before = corner;
    for (const Vec3f& place : {Vec3f(1, 1, 1), before, Vec3f(before + Vec3f(0.01F, 0, 0))}) {
      corner = place;
      surface_.for_each_outgoing(surface_.triangle(triangle)[0], [&](std::uint32_t h) { surroundings.enter(h / 3); });
      for (int n = 0; n < 50; ++n) {
        const Box box = random_box(random, 0.5);
        const Indices found = found_near(surroundings, box), all = all_near(surface_, box);
        EXPECT_TRUE(std::includes(found.begin(), found.end(), all.begin(), all.end()));
      }
    }
  }
}

}  // namespace
}  // namespace particle_surface_tracker
