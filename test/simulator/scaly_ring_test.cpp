#include "scaly_ring.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/mesh_measures.h"
#include "particle_surface_tracker/core/mesh_validation.h"

namespace particle_surface_tracker::simulator {
namespace {

TEST(ScalyRing, IsAClosedRing) {
  TriangleMesh mesh = ScalyRing().mesh();
  EXPECT_NO_THROW(check_closed_manifold(mesh));
  EXPECT_TRUE(orient_outward(mesh).empty());
  const MeshMeasures measures = measure_mesh(mesh.positions(), mesh.triangles());
  EXPECT_EQ(measures.components, 1U);
  EXPECT_EQ(measures.genus, 1);
  EXPECT_EQ(mesh.triangle_count(), 81920U);
}

TEST(ScalyRing, HasAColorPerVertex) {
  const TriangleMesh mesh = ScalyRing().mesh();
  const std::size_t color = mesh.attributes().find(TriangleMesh::color_name);
  ASSERT_NE(color, VertexAttributes::none);
  const std::vector<float>& values = mesh.attributes()[color].values;
  ASSERT_EQ(values.size(), 4 * mesh.vertex_count());
  EXPECT_GE(*std::min_element(values.begin(), values.end()), 0.0F);
  EXPECT_LE(*std::max_element(values.begin(), values.end()), 1.0F);
}

TEST(ScalyRing, ParticlesFillIt) {
  const TriangleMesh mesh = ScalyRing().mesh();
  const double volume = measure_mesh(mesh.positions(), mesh.triangles()).volume;
  for (const double spacing : {0.02, 0.03, 0.05}) {
    const ParticleFrame particles = ScalyRing().fill(mesh, spacing);
    EXPECT_NEAR(estimate_particle_spacing(particles), spacing, 1e-6);
    const double filled = static_cast<double>(particles.size()) * std::pow(spacing, 3) / volume;
    EXPECT_GT(filled, 0.85);
    EXPECT_LT(filled, 1.0);
  }
}

// Points all over a triangle, corners included.
std::vector<Vec3f> samples(const TriangleMesh& mesh, const Triangle& triangle) {
  const int parts = 4;
  std::vector<Vec3f> result;
  for (int a = 0; a <= parts; ++a) {
    for (int b = 0; a + b <= parts; ++b) {
      const float s = static_cast<float>(a) / parts;
      const float t = static_cast<float>(b) / parts;
      const std::vector<Vec3f>& p = mesh.positions();
      result.emplace_back(s * p[triangle[0]] + t * p[triangle[1]] + (1.0F - s - t) * p[triangle[2]]);
    }
  }
  return result;
}

TEST(ScalyRing, ParticlesLieBelowItsSurface) {
  const TriangleMesh mesh = ScalyRing().mesh();
  const float spacing = 0.05F;
  const ParticleFrame particles = ScalyRing().fill(mesh, spacing);
  float nearest = std::numeric_limits<float>::max();
  for (const Triangle& triangle : mesh.triangles()) {
    const std::vector<Vec3f> points = samples(mesh, triangle);
    for (const Vec3f& center : particles.positions) {
      if ((points[0] - center).squaredNorm() > spacing * spacing) continue;
      for (const Vec3f& point : points) nearest = std::min(nearest, (point - center).squaredNorm());
    }
  }
  EXPECT_GT(std::sqrt(nearest), 0.1F * spacing);
  EXPECT_LT(std::sqrt(nearest), 0.3F * spacing);
}

}  // namespace
}  // namespace particle_surface_tracker::simulator
