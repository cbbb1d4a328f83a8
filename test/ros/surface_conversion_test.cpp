#include "ros/surface/surface_conversion.h"

#include <cmath>
#include <functional>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/tracker/make_implicit_surface.h"
#include "ros/surface/surface_identity.h"
#include "ros_test_support.h"
#include "support/parameters.h"
#include "support/shapes.h"

namespace particle_surface_tracker::test {
namespace {

constexpr double r = 0.1;

/// A ball around the origin, so that coordinates of all signs occur, and a drop far away.
ParticleFrame particles() {
  ParticleFrame frame = fill_with_particles(Vec3d::Constant(-1), Vec3d::Constant(1), r, 0.2, 1,
                                            [](const Vec3d& x) { return x.norm() < 0.6; });
  frame.positions.back() = Vec3f(40.0F, -30.0F, 20.0F);
  frame.stamp_ns = 5000000000;
  return frame;
}

ParticleSurface message() {
  std_msgs::Header header;
  header.stamp = ros::Time(5, 0);
  header.frame_id = "tank";
  return to_surface_message(header, *make_implicit_surface(particles(), parameters_with_spacing(r)), particles(),
                            parameters_with_spacing(r));
}

/// Whether two lattices have the same nodes with the same values, and the same everywhere else.
void expect_same(const openvdb::FloatGrid& a, const openvdb::FloatGrid& b) {
  EXPECT_EQ(a.background(), b.background());
  ASSERT_EQ(a.tree().leafCount(), b.tree().leafCount());
  auto other = b.tree().cbeginLeaf();
  for (auto leaf = a.tree().cbeginLeaf(); leaf; ++leaf, ++other) {
    ASSERT_EQ(leaf->origin(), other->origin());
    ASSERT_TRUE(leaf->getValueMask() == other->getValueMask());
    for (openvdb::Index n = 0; n < 512; ++n) ASSERT_EQ(leaf->getValue(n), other->getValue(n));
  }
}

TEST(SurfaceConversion, KeepsEveryBit) {
  const auto surface = make_implicit_surface(particles(), parameters_with_spacing(r));
  const ParticleSurface sent = message();
  EXPECT_EQ(sent.header.frame_id, "tank");
  EXPECT_EQ(sent.particles, particles().size());
  const auto back = to_surface(sent);
  EXPECT_EQ(back->dx, surface->dx);
  expect_same(*back->field, *surface->field);
  EXPECT_EQ(back->triangulation.vertices, surface->triangulation.vertices);
  EXPECT_EQ(back->triangulation.triangles, surface->triangulation.triangles);
  ASSERT_EQ(back->triangulation.cells.size(), surface->triangulation.cells.size());
  for (std::size_t n = 0; n < back->triangulation.cells.size(); ++n) {
    ASSERT_EQ(back->triangulation.cells[n].origin, surface->triangulation.cells[n].origin);
    ASSERT_EQ(back->triangulation.cells[n].first_triangle, surface->triangulation.cells[n].first_triangle);
  }
  EXPECT_NO_THROW(require_made_of(sent, particles(), parameters_with_spacing(r)));
}

TEST(SurfaceConversion, OtherParticlesAndParametersAreSaid) {
  ParticleFrame moved = particles();
  moved.positions[7].x() = std::nextafter(moved.positions[7].x(), 10.0F);
  EXPECT_NE(error_of<InputError>([&] {
              require_made_of(message(), moved, parameters_with_spacing(r));
            }).find("other particles"),
            std::string::npos);
  Parameters other = parameters_with_spacing(r);
  other.surface_radius = 1.03;
  const std::string text = error_of<InputError>([&] { require_made_of(message(), particles(), other); });
  EXPECT_NE(text.find("surface_radius=1.04"), std::string::npos) << text;
  EXPECT_NE(text.find("surface_radius=1.03"), std::string::npos) << text;
  other = parameters_with_spacing(r);
  other.tau = 0.1;
  EXPECT_NO_THROW(require_made_of(message(), particles(), other)) << "the surface does not depend on it";
}

// What the list of names leaves out must not matter, and what it has must.
TEST(SurfaceConversion, TheParametersNamedAreThoseThatTheSurfaceDependsOn) {
  const std::map<std::string, std::string> others = {{"particle_spacing", "0.11"}, {"dx_phi", "0.4"},
                                                     {"influence_radius", "3"},    {"surface_radius", "1.1"},
                                                     {"eigenvalue_low", "0.2"},    {"eigenvalue_high", "1.5"}};
  const ParticleSurface standard = message();
  for (const ParameterInfo& info : parameter_table()) {
    Parameters changed = parameters_with_spacing(r);
    const bool is_named = others.count(info.name) != 0;
    if (is_named) {
      set_parameter(changed, info.name, others.at(info.name));
    } else if (info.type == ParameterInfo::Type::kChoice) {
      set_parameter(changed, info.name, info.choices.front());
    } else {
      set_parameter(changed, info.name, fmt::format("{}", info.minimum));
    }
    const auto surface = make_implicit_surface(particles(), changed);
    const ParticleSurface result = to_surface_message(standard.header, *surface, particles(), changed);
    EXPECT_EQ(result.values == standard.values, !is_named) << info.name;
    EXPECT_EQ(result.parameters == standard.parameters, !is_named) << info.name;
  }
}

TEST(SurfaceConversion, DamagedMessagesAreRefused) {
  const std::vector<std::function<void(ParticleSurface&)>> damages = {
      [](ParticleSurface& m) { m.dx = 0.0; },
      [](ParticleSurface& m) { m.dx = std::numeric_limits<double>::quiet_NaN(); },
      [](ParticleSurface& m) { m.background = std::numeric_limits<float>::infinity(); },
      [](ParticleSurface& m) { m.block_origins.pop_back(); },
      [](ParticleSurface& m) { m.block_origins[0] += 1; },
      [](ParticleSurface& m) { std::copy_n(m.block_origins.begin(), 3, m.block_origins.begin() + 3); },
      [](ParticleSurface& m) { m.block_masks.pop_back(); },
      [](ParticleSurface& m) { m.block_masks[3] ^= 1U; },
      [](ParticleSurface& m) { m.values.push_back(0.0F); },
      [](ParticleSurface& m) { m.values[0] = std::numeric_limits<float>::quiet_NaN(); },
      [](ParticleSurface& m) { m.vertices.pop_back(); },
      [](ParticleSurface& m) { m.vertices[0] = std::numeric_limits<float>::quiet_NaN(); },
      [](ParticleSurface& m) { m.triangles.pop_back(); },
      [](ParticleSurface& m) { m.triangles[1] = static_cast<std::uint32_t>(m.vertices.size()); },
      [](ParticleSurface& m) { m.cell_origins.pop_back(); },
      [](ParticleSurface& m) { m.cell_triangles.back() += 1; },
      [](ParticleSurface& m) { m.cell_triangles[1] = 0xffffffffU; }};
  for (std::size_t n = 0; n < damages.size(); ++n) {
    ParticleSurface damaged = message();
    damages[n](damaged);
    EXPECT_THROW(to_surface(damaged), InputError) << n;
  }
}

}  // namespace
}  // namespace particle_surface_tracker::test
