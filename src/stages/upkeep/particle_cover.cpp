#include "particle_surface_tracker/stages/particle_cover.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include <openvdb/math/Proximity.h>
#include <Eigen/Geometry>

#include "stages/nodes/lattice_cell.h"
#include "stages/nodes/node_masks.h"
#include "triangle_crossing.h"

namespace particle_surface_tracker {

namespace {

/// Distance to which the surface is brought [r]: less than r, so that rounding does not matter.
constexpr double kCovered = 0.98;
/// Surface that is farther does not belong to the particle [r].
constexpr double kFarthest = 1.25;
/// Vertices of the first mesh are moved only if the surface is nearer [r]: it is their detail that gives way, for a
/// frame.
constexpr double kFarthestDetail = 1.15;
/// Triangles up to this many cells of r from a particle are looked at. Larger ones are none that re-meshing has made.
constexpr int kReach = 4;
/// Share of the closest place that must move for the surface there to follow.
constexpr double kLeastWeight = 0.3;

openvdb::Vec3d to_vdb(const Vec3d& v) {
  return {v.x(), v.y(), v.z()};
}

struct ClosestPlace {
  std::uint32_t triangle = 0;
  Vec3d weights = Vec3d::Zero();  ///< Of the corners.
  Vec3d offset = Vec3d::Zero();   ///< From the place to the particle [m].
};

class ParticleCover {
 public:
  ParticleCover(TriangleMesh& mesh, std::uint32_t first_new_id, const std::vector<Vec3f>& particles, double r)
      : mesh_(mesh), first_new_id_(first_new_id), r_(r) {
    NodeMasks cells;
    for (const Vec3f& particle : particles) {
      const Vec3d place = particle.cast<double>() / r;
      if (has_cell(place)) cells.insert(cell_of(place));
    }
    cells.dilate(kReach, kReach);
    for (std::uint32_t t = 0; t < mesh.triangle_count(); ++t) {
      const Vec3d corner = mesh.positions()[mesh.triangles()[t][0]].cast<double>() / r;
      if (has_cell(corner) && cells.contains(cell_of(corner))) near_.push_back(t);
    }
  }

  void approach(const Vec3d& particle) {
    const ClosestPlace closest = find_closest(particle);
    const double distance = closest.offset.norm();
    if (distance <= kCovered * r_ || distance > kFarthest * r_) return;
    const Triangle& corners = mesh_.triangles()[closest.triangle];
    std::vector<std::uint32_t> moving;
    double weight = 0.0;
    for (int k = 0; k < 3; ++k) {
      if (mesh_.ids()[corners[k]] < first_new_id_ && distance > kFarthestDetail * r_) continue;
      moving.push_back(corners[k]);
      weight += closest.weights[k];
    }
    if (weight < kLeastWeight) return;
    const Vec3d move = closest.offset * ((distance - kCovered * r_) / (distance * weight));
    move_vertices(moving, move.cast<float>());
  }

  std::vector<std::uint32_t> take_moved() {
    std::sort(moved_.begin(), moved_.end());
    moved_.erase(std::unique(moved_.begin(), moved_.end()), moved_.end());
    return std::move(moved_);
  }

 private:
  Corners corners_of(std::uint32_t triangle) const {
    return place_corners(mesh_.positions(), mesh_.triangles()[triangle]);
  }

  ClosestPlace find_closest(const Vec3d& particle) const {
    ClosestPlace closest;
    closest.offset = Vec3d::Constant(std::numeric_limits<double>::max() / 4.0);
    double squared_distance = std::numeric_limits<double>::max();
    for (const std::uint32_t t : near_) {
      const Corners c = corners_of(t);
      if ((c[0] - particle).cwiseAbs().maxCoeff() > kReach * r_) continue;
      openvdb::Vec3d weights;
      const openvdb::Vec3d place = openvdb::math::closestPointOnTriangleToPoint(
          to_vdb(c[0]), to_vdb(c[1]), to_vdb(c[2]), to_vdb(particle), weights);
      const Vec3d offset = particle - Vec3d(place.x(), place.y(), place.z());
      if (offset.squaredNorm() >= squared_distance) continue;
      squared_distance = offset.squaredNorm();
      closest = {t, {weights.x(), weights.y(), weights.z()}, offset};
    }
    return closest;
  }

  /// Moves vertices unless that would fold or cross something.
  void move_vertices(const std::vector<std::uint32_t>& vertices, const Vec3f& move) {
    std::vector<std::uint32_t> around;
    for (const std::uint32_t t : near_) {
      const Triangle& other = mesh_.triangles()[t];
      if (std::find_first_of(other.begin(), other.end(), vertices.begin(), vertices.end()) != other.end())
        around.push_back(t);
    }
    std::vector<Vec3d> normals;
    normals.reserve(around.size());
    for (const std::uint32_t t : around) normals.push_back(area_normal(corners_of(t)));
    std::vector<Vec3f> before;
    for (const std::uint32_t v : vertices) {
      before.push_back(mesh_.positions()[v]);
      mesh_.positions()[v] += move;
    }
    if (is_sound(around, normals)) {
      std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(moved_),
                   [&](std::uint32_t v) { return mesh_.ids()[v] >= first_new_id_; });
      return;
    }
    for (std::size_t n = 0; n < vertices.size(); ++n) mesh_.positions()[vertices[n]] = before[n];
  }

  bool is_sound(const std::vector<std::uint32_t>& changed, const std::vector<Vec3d>& normals_before) const {
    Eigen::AlignedBox3d box;
    for (std::size_t n = 0; n < changed.size(); ++n) {
      const Corners corners = corners_of(changed[n]);
      if (area_normal(corners).dot(normals_before[n]) <= 0.0) return false;
      for (const Vec3d& corner : corners) box.extend(corner);
    }
    for (const std::uint32_t other : near_) {
      const Corners corners = corners_of(other);
      Eigen::AlignedBox3d other_box;
      for (const Vec3d& corner : corners) other_box.extend(corner);
      if (!box.intersects(other_box)) continue;
      const PlacedTriangle placed = place_triangle(mesh_.triangles()[other], corners);
      for (const std::uint32_t t : changed) {
        if (triangles_cross(place_triangle(mesh_.triangles()[t], corners_of(t)), placed)) return false;
      }
    }
    return true;
  }

  TriangleMesh& mesh_;
  std::uint32_t first_new_id_;
  double r_;
  std::vector<std::uint32_t> near_;   // triangles
  std::vector<std::uint32_t> moved_;  // without those of the first mesh, which keep δ
};

}  // namespace

std::vector<std::uint32_t> cover_particles(TriangleMesh& mesh, std::uint32_t first_new_id,
                                           const std::vector<Vec3f>& particles, double r) {
  if (particles.empty()) return {};
  ParticleCover cover(mesh, first_new_id, particles, r);
  for (const Vec3f& particle : particles) cover.approach(particle.cast<double>());
  return cover.take_moved();
}

}  // namespace particle_surface_tracker
