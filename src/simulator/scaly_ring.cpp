#include "scaly_ring.h"

#include <algorithm>
#include <cmath>

#include "particle_surface_tracker/core/particle_grid.h"

namespace particle_surface_tracker::simulator {
namespace {

constexpr double kTurn = 6.283185307179586;

// Lengths in metres.
constexpr double kRingRadius = 0.5;
constexpr double kMeanTubeRadius = 0.195;
constexpr double kLobeHeight = 0.02;
constexpr double kScaleHeight = 0.013;
constexpr double kKeelHeight = 0.005;

constexpr int kLobes = 3;
constexpr int kLobeTwists = 2;

// Scales are diamonds; so many stand along the ring and around the tube, each kStepsPerScale quads long and wide.
constexpr int kScalesAlong = 40;
constexpr int kScalesAround = 16;
constexpr int kStepsPerScale = 8;
constexpr int kStepsAlong = kScalesAlong * kStepsPerScale;
constexpr int kStepsAround = kScalesAround * kStepsPerScale;

// Particles lie at least a tenth of their spacing below the surface. What is measured is the distance to points of the
// surface (see surface_points()), which this much more keeps the triangles between them out of reach.
constexpr double kClearanceInSpacings = 0.1;
constexpr double kPointAllowance = 0.003;

// Where a point is on its scale: both coordinates run from 0 to 1 along the diamond's sides, from its root at (0, 0) to
// its tip at (1, 1).
struct OnScale {
  double s, t;
  int column, row;  // Of the diamond lattice.
};

OnScale on_scale(double u, double v) {
  const double s = kScalesAlong * u + kScalesAround * v;
  const double t = kScalesAlong * u - kScalesAround * v;
  return {s - std::floor(s), t - std::floor(t), static_cast<int>(std::floor(s)), static_cast<int>(std::floor(t))};
}

// 0 on the sides of the unit interval, 1 in most of it.
double plateau(double x) {
  return 1.0 - std::pow(std::abs(2.0 * x - 1.0), 4);
}

double relief(double u, double v) {
  const OnScale p = on_scale(u, v);
  const double dome = plateau(p.s) * plateau(p.t);
  const double tilt = 0.3 + 0.7 * 0.5 * (p.s + p.t);
  const double keel = std::max(0.0, 1.0 - std::abs(p.s - p.t) / 0.3);
  return dome * (kScaleHeight * tilt + kKeelHeight * keel);
}

Vec3d on_ring(double u, double v, double tube_radius) {
  const double from_axis = kRingRadius + tube_radius * std::cos(kTurn * v);
  return {from_axis * std::cos(kTurn * u), from_axis * std::sin(kTurn * u), tube_radius * std::sin(kTurn * v)};
}

// The hue runs once around the ring, so that the twist of the flow shows; a spiral of golden scales and dark grooves
// show whether colours stay with their detail.
Vec3d color(double u, double v) {
  const Vec3d hue = Vec3d(0.62, 0.62, 0.62) + 0.33 * Vec3d(std::cos(kTurn * (u + 0.55)), std::cos(kTurn * (u + 0.22)),
                                                           std::cos(kTurn * (u - 0.08)));
  const OnScale p = on_scale(u, v);
  const bool golden = ((p.column - 3 * p.row) % 8 + 8) % 8 == 0;
  const Vec3d scale = golden ? Vec3d(1.0, 0.8, 0.2) : hue;
  const double groove = plateau(p.s) * plateau(p.t);
  return (0.4 + 0.6 * std::sqrt(groove)) * scale;
}

std::uint32_t vertex_at(int i, int j) {
  return static_cast<std::uint32_t>((i % kStepsAlong) * kStepsAround + j % kStepsAround);
}

std::vector<Triangle> triangles() {
  std::vector<Triangle> result;
  result.reserve(std::size_t{2} * kStepsAlong * kStepsAround);
  for (int i = 0; i < kStepsAlong; ++i) {
    for (int j = 0; j < kStepsAround; ++j) {
      const std::uint32_t a = vertex_at(i, j);
      const std::uint32_t b = vertex_at(i + 1, j);
      const std::uint32_t c = vertex_at(i + 1, j + 1);
      const std::uint32_t d = vertex_at(i, j + 1);
      const bool groove_from_a_to_c = (i - j) % kStepsPerScale == 0;
      if (groove_from_a_to_c) {
        result.push_back({a, b, c});
        result.push_back({a, c, d});
      } else {
        result.push_back({a, b, d});
        result.push_back({b, c, d});
      }
    }
  }
  return result;
}

// The vertices and the middles of the edges.
std::vector<Vec3f> surface_points(const TriangleMesh& mesh) {
  std::vector<Vec3f> points = mesh.positions();
  for (const Triangle& triangle : mesh.triangles()) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t a = triangle[corner];
      const std::uint32_t b = triangle[(corner + 1) % 3];
      if (a < b) points.push_back(0.5F * (mesh.positions()[a] + mesh.positions()[b]));
    }
  }
  return points;
}

}  // namespace

double ScalyRing::tube_radius(double u, double v) const {
  const double lobes = kLobeHeight * std::cos(kTurn * (kLobes * v + kLobeTwists * u));
  return kMeanTubeRadius + lobes + relief(u, v);
}

TriangleMesh ScalyRing::mesh() const {
  std::vector<Vec3f> positions;
  std::vector<float> colors;
  for (int i = 0; i < kStepsAlong; ++i) {
    for (int j = 0; j < kStepsAround; ++j) {
      const double u = static_cast<double>(i) / kStepsAlong;
      const double v = static_cast<double>(j) / kStepsAround;
      positions.push_back(on_ring(u, v, tube_radius(u, v)).cast<float>());
      const Vec3d rgb = color(u, v);
      for (const double channel : {rgb.x(), rgb.y(), rgb.z(), 1.0}) colors.push_back(static_cast<float>(channel));
    }
  }
  TriangleMesh mesh(std::move(positions), triangles());
  const std::size_t color_index = mesh.attributes().add(TriangleMesh::color_name, 4, {1.0F, 1.0F, 1.0F, 1.0F});
  mesh.attributes()[color_index].values = std::move(colors);
  return mesh;
}

ParticleFrame ScalyRing::fill(const TriangleMesh& mesh, double spacing) const {
  const std::vector<Vec3f> surface = surface_points(mesh);
  const ParticleGrid surface_grid(surface, spacing);
  const double clearance = kClearanceInSpacings * spacing + kPointAllowance;
  const int reach_xy = static_cast<int>(std::ceil(1.5 * kRingRadius / spacing));
  const int reach_z = static_cast<int>(std::ceil(0.5 * kRingRadius / spacing));
  std::vector<Vec3f> centers;
  for (int i = -reach_xy; i < reach_xy; ++i) {
    for (int j = -reach_xy; j < reach_xy; ++j) {
      for (int k = -reach_z; k < reach_z; ++k) {
        const Vec3d center = spacing * Vec3d(i + 0.5, j + 0.5, k + 0.5);
        const double from_center_line = std::hypot(center.x(), center.y()) - kRingRadius;
        const double u = std::atan2(center.y(), center.x()) / kTurn;
        const double v = std::atan2(center.z(), from_center_line) / kTurn;
        if (std::hypot(from_center_line, center.z()) >= tube_radius(u, v)) continue;
        const Vec3d nearest = surface[surface_grid.nearest(center)].cast<double>();
        if ((nearest - center).norm() < clearance) continue;
        centers.push_back(center.cast<float>());
      }
    }
  }
  std::vector<std::uint32_t> ids(centers.size());
  for (std::size_t id = 0; id < ids.size(); ++id) ids[id] = static_cast<std::uint32_t>(id);
  return make_particle_frame(0, std::move(centers), std::move(ids));
}

}  // namespace particle_surface_tracker::simulator
