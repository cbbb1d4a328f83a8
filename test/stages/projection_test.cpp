#include "particle_surface_tracker/stages/projection.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/instruction_set.h"
#include "stages/projection/field_stencil.h"
#include "stages/projection/tricubic_kernel.h"
#include "support/fields.h"
#include "support/shapes.h"

namespace particle_surface_tracker {
namespace {

constexpr double r = 0.1;
constexpr double dx = 0.05;
constexpr double radius = 0.6;

Parameters parameters(ProjectionMethod method = ProjectionMethod::kTwoStep) {
  Parameters p;
  p.particle_spacing = r;
  p.projection = method;
  return p;
}

/// φ of a ball of radius 0.6 around the origin.
const SignedDistanceField& ball() {
  static const SignedDistanceField field = test::make_field(Vec3d::Constant(-1.0), Vec3d::Constant(1.0), dx, 0.35,
                                                            [](const Vec3d& x) { return x.norm() - radius; });
  return field;
}

Projection project_one(const Vec3f& x, float delta, ProjectionMethod method = ProjectionMethod::kTwoStep) {
  return project({x}, {delta}, ball(), parameters(method));
}

/// φ and ∇φ at one position by the kernel.
struct Sample {
  float value;
  Vec3d gradient;
};

Sample sample(const SignedDistanceField& field, const Vec3d& position, int lane) {
  const Vec3d lattice = position / dx;
  const openvdb::Coord cell(static_cast<int>(std::floor(lattice.x())), static_cast<int>(std::floor(lattice.y())),
                            static_cast<int>(std::floor(lattice.z())));
  TricubicBatch batch{};
  FieldStencil(FieldLeaves(field)).load(cell, &batch.nodes[0][lane], TricubicBatch::lanes);
  for (int axis = 0; axis < 3; ++axis) batch.place[axis][lane] = static_cast<float>(lattice[axis] - cell[axis]);
  active_tricubic_kernel()(batch, StepLength{1.0f, 1.0f, 0.0f});
  return {batch.value[lane], Vec3d(batch.gradient[0][lane], batch.gradient[1][lane], batch.gradient[2][lane]) / dx};
}

TEST(TricubicKernel, IsExactForQuadraticFunctions) {
  const auto function = [](const Vec3d& p) {
    return 0.1 + 0.3 * p.x() - 0.2 * p.y() + 0.5 * p.z() + p.x() * p.y() - 2 * p.y() * p.z() + p.z() * p.z();
  };
  const SignedDistanceField field = test::make_field(Vec3d::Constant(-1), Vec3d::Constant(1), dx, 100.0, function);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-0.9, 0.9);
  for (int n = 0; n < 1000; ++n) {
    const Vec3d p(uniform(random), uniform(random), uniform(random));
    const Sample result = sample(field, p, n % TricubicBatch::lanes);
    EXPECT_NEAR(result.value, function(p), 2e-6);
    EXPECT_NEAR(result.gradient.x(), 0.3 + p.y(), 1e-4);
    EXPECT_NEAR(result.gradient.y(), -0.2 + p.x() - 2 * p.z(), 1e-4);
    EXPECT_NEAR(result.gradient.z(), 0.5 - 2 * p.y() + 2 * p.z(), 1e-4);
  }
}

TEST(TricubicKernel, InterpolatesTheNodes) {
  for (auto node = ball().phi->cbeginValueOn(); node; ++node) {
    if (std::abs(*node) > 0.2f) continue;
    const openvdb::Coord c = node.getCoord();
    const Vec3d just_inside = (Vec3d(c.x(), c.y(), c.z()) + Vec3d::Constant(1e-9)) * dx;
    EXPECT_NEAR(sample(ball(), just_inside, 3).value, *node, 1e-6f);
  }
}

TEST(TricubicKernel, StepsAreLongNextToTheSurfaceOnly) {
  const SignedDistanceField plane = test::make_field(Vec3d::Constant(-1), Vec3d::Constant(1), dx, 100.0,
                                                     [](const Vec3d& p) { return p.x() - 0.25 * dx; });
  const auto inverse = static_cast<float>(1.0 / dx);
  const StepLength step_length = {0.35f * inverse, 0.8f * inverse, static_cast<float>(0.1 * dx)};
  TricubicBatch batch{};
  const FieldLeaves leaves(plane);
  for (int l = 0; l < TricubicBatch::lanes; ++l) {
    FieldStencil(leaves).load(openvdb::Coord(0), &batch.nodes[0][l], TricubicBatch::lanes);
    batch.place[0][l] = static_cast<float>(l) / TricubicBatch::lanes;
  }
  active_tricubic_kernel()(batch, step_length);
  for (int l = 0; l < TricubicBatch::lanes; ++l) {
    const float distance = batch.place[0][l] - 0.25f;
    const float step = (std::abs(distance) < 0.1f ? 0.8f : 0.35f) * distance;
    EXPECT_NEAR(batch.next[0][l], batch.place[0][l] - step, 1e-5f) << l;
    EXPECT_EQ(batch.cells[0][l], 0) << l;
  }
}

TEST(TricubicKernel, APlaceIsWithinItsCellAfterAStepThatLeavesIt) {
  const SignedDistanceField plane = test::make_field(Vec3d::Constant(-1), Vec3d::Constant(1), dx, 100.0,
                                                     [](const Vec3d& p) { return p.x() - 0.5 * dx; });
  const FieldLeaves leaves(plane);
  TricubicBatch batch{};
  for (int l = 0; l < TricubicBatch::lanes; ++l) {
    FieldStencil(leaves).load(openvdb::Coord(0), &batch.nodes[0][l], TricubicBatch::lanes);
    batch.place[0][l] = (static_cast<float>(l) + 0.25f) / TricubicBatch::lanes;
  }
  const auto far = static_cast<float>(8.0 / dx);
  active_tricubic_kernel()(batch, {far, far, 0.0f});
  for (int l = 0; l < TricubicBatch::lanes; ++l) {
    const float next = batch.place[0][l] - 8.0f * (batch.place[0][l] - 0.5f);
    EXPECT_EQ(batch.cells[0][l], static_cast<int>(std::floor(next))) << l;
    EXPECT_NEAR(batch.next[0][l], next - std::floor(next), 1e-4f) << l;
  }
}

TEST(TricubicKernel, StepsAreTheSameForEveryInstructionSet) {
  const TriangleMesh start = test::make_sphere(Vec3d(0.01, 0.02, 0.03), 0.66, 4);
  const std::vector<float> delta(start.vertex_count(), 0.03f);
  std::vector<Vec3f> expected;
  for (const InstructionSet set : {InstructionSet::kBaseline, InstructionSet::kAvx2, InstructionSet::kAvx512}) {
    if (!is_supported(set)) continue;
    const ForcedInstructionSet forced(set);
    const std::vector<Vec3f> positions = project(start.positions(), delta, ball(), parameters()).positions;
    if (expected.empty()) expected = positions;
    EXPECT_EQ(positions, expected);
  }
}

TEST(Projection, RefusesWhereANodeIsAbsent) {
  EXPECT_EQ(project_one({1e30f, 0, 0}, 0.0f).status[0], ProjectionStatus::kAbsent);
  // Along a radius the answer changes from found to absent once, and only the band's last cells refuse.
  bool last = true;
  for (float x = 0.6f; x < 1.2f; x += 0.003f) {
    const bool known = project_one({x, 0.01f, 0.01f}, 0.0f).status[0] == ProjectionStatus::kFound;
    EXPECT_FALSE(known && !last) << x;
    EXPECT_TRUE(known || x > radius + 0.35 - 4 * dx) << x;
    last = known;
  }
  EXPECT_FALSE(last);
}

TEST(Projection, OfAVertexDoesNotDependOnWhichOthersThereAre) {
  const std::vector<Vec3f> vertices = test::make_sphere(Vec3d(0.01, 0.02, 0.03), 0.68, 2).positions();
  const Projection together = project(vertices, std::vector<float>(vertices.size(), 0.02f), ball(), parameters());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    EXPECT_EQ(project_one(vertices[v], 0.02f).positions[0], together.positions[v]);
  }
}

TEST(Projection, PutsVerticesAtDeltaAlongTheRadius) {
  const TriangleMesh start = test::make_sphere(Vec3d::Zero(), 0.66, 3);
  for (const float delta : {-0.08f, -0.02f, 0.0f, 0.02f, 0.08f}) {
    const Projection result =
        project(start.positions(), std::vector<float>(start.vertex_count(), delta), ball(), parameters());
    for (std::size_t v = 0; v < start.vertex_count(); ++v) {
      ASSERT_EQ(result.status[v], ProjectionStatus::kFound);
      const Vec3d x = start.positions()[v].cast<double>();
      const Vec3d expected = x.normalized() * (radius + delta);
      EXPECT_LT((result.positions[v].cast<double>() - expected).norm(), 0.01 * dx) << delta;
      EXPECT_NEAR(result.distances[v], 0.06, 0.01 * dx);
    }
  }
}

TEST(Projection, AVertexInsideStaysInsideAndOneThatChangedSideGoesBack) {
  const Projection inside = project_one({0.55f, 0.01f, 0.02f}, -0.04f);
  EXPECT_NEAR(inside.positions[0].norm(), radius - 0.04, 0.01 * dx);
  EXPECT_LT(inside.distances[0], 0.0f);
  const Projection strayed_in = project_one({0.55f, 0.01f, 0.02f}, 0.04f);
  EXPECT_NEAR(strayed_in.positions[0].norm(), radius + 0.04, 0.01 * dx);
  const Projection strayed_out = project_one({0.65f, 0.01f, 0.02f}, -0.04f);
  EXPECT_NEAR(strayed_out.positions[0].norm(), radius - 0.04, 0.01 * dx);
}

TEST(Projection, AVertexOnTheIsosurfaceHasADirection) {
  const Projection result = project_one({0.6f, 0.0f, 0.0f}, 0.05f);
  EXPECT_EQ(result.status[0], ProjectionStatus::kFound);
  EXPECT_NEAR(result.positions[0].x(), 0.65, 0.01 * dx);
  EXPECT_NEAR(result.positions[0].y(), 0.0, 0.01 * dx);
}

TEST(Projection, NothingJumpsWhereTheVertexCrossesTheIsosurface) {
  // The direction is blended, so that a vertex a hair to the other side lands a hair away.
  Vec3f last = project_one({0.55f, 0.05f, 0.1f}, 0.05f).positions[0];
  for (float x = 0.55f; x < 0.66f; x += 1e-4f) {
    const Vec3f now = project_one({x, 0.05f, 0.1f}, 0.05f).positions[0];
    EXPECT_LT((now - last).norm(), 1e-3f) << x;
    last = now;
  }
}

TEST(Projection, AtRestIsTheIdentity) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::vector<Vec3f> vertices;
  for (int n = 0; n < 5000; ++n) {
    const Vec3f direction = Vec3f(uniform(random), uniform(random), uniform(random)).normalized();
    vertices.push_back(direction * (0.6f + 0.15f * uniform(random)));
  }
  for (const ProjectionMethod method : {ProjectionMethod::kTwoStep, ProjectionMethod::kOneStep}) {
    std::vector<ProjectionStatus> status;
    const std::vector<float> delta = measure_delta(vertices, ball(), parameters(method), status);
    for (const ProjectionStatus s : status) ASSERT_EQ(s, ProjectionStatus::kFound);
    for (std::size_t v = 0; v < vertices.size(); ++v) EXPECT_NEAR(delta[v], vertices[v].norm() - 0.6f, 0.01 * dx);
    EXPECT_EQ(project(vertices, delta, ball(), parameters(method)).positions, vertices);
  }
}

TEST(Projection, OneStepIsEquationOne) {
  const Projection result = project_one({0.66f, 0.0f, 0.0f}, 0.02f, ProjectionMethod::kOneStep);
  EXPECT_NEAR(result.positions[0].x(), radius + 0.02, 0.02 * dx);
}

TEST(Projection, TwoStepsAreMorePreciseThanOneNextToAnExtremumOfPhi) {
  // Inside a thin slab φ has a crease: a single step from beside the crease trusts an underestimated value.
  const double half = 0.06;
  const SignedDistanceField slab = test::make_field(Vec3d::Constant(-0.6), Vec3d::Constant(0.6), dx, 0.35,
                                                    [&](const Vec3d& x) { return std::abs(x.z() - 0.012) - half; });
  const std::vector<Vec3f> vertices = {{0.01f, 0.02f, 0.022f}};
  const double surface = 0.012 + half;
  const auto error = [&](ProjectionMethod method) {
    return std::abs(project(vertices, {0.0f}, slab, parameters(method)).positions[0].z() - surface);
  };
  EXPECT_LT(error(ProjectionMethod::kTwoStep), 0.03 * dx);
  EXPECT_GT(error(ProjectionMethod::kOneStep), 2.0 * error(ProjectionMethod::kTwoStep));
}

TEST(Projection, OutOfReachAndWithoutDirectionAreToldApart) {
  EXPECT_EQ(project_one({5, 5, 5}, 0.0f).status[0], ProjectionStatus::kAbsent);
  EXPECT_EQ(project_one({5, 5, 5}, 0.0f).positions[0], Vec3f(5, 5, 5));
  const SignedDistanceField slab = test::make_field(Vec3d::Constant(-0.6), Vec3d::Constant(0.6), dx, 0.35,
                                                    [](const Vec3d& x) { return std::abs(x.z()) - 0.1; });
  const Projection middle = project({{0.01f, 0.02f, 0.0f}}, {0.0f}, slab, parameters());
  EXPECT_EQ(middle.status[0], ProjectionStatus::kNotFound);
  EXPECT_EQ(middle.positions[0], Vec3f(0.01f, 0.02f, 0.0f));
}

TEST(Projection, StepsAreBounded) {
  Parameters few = parameters();
  few.projection_max_steps = 2;
  EXPECT_EQ(project({{0.7f, 0, 0}}, {0.0f}, ball(), few).status[0], ProjectionStatus::kNotFound);
  few.projection_max_steps = 20;
  EXPECT_EQ(project({{0.7f, 0, 0}}, {0.0f}, ball(), few).status[0], ProjectionStatus::kFound);
}

}  // namespace
}  // namespace particle_surface_tracker
