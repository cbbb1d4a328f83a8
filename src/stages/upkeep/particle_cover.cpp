#include "particle_surface_tracker/stages/particle_cover.h"

#include <algorithm>
#include <iterator>
#include <limits>

#include <openvdb/math/Proximity.h>
#include <Eigen/Geometry>

#include "stages/nodes/lattice_cell.h"
#include "stages/nodes/node_masks.h"
#include "triangle_crossing.h"
#include "triangle_overlap.h"

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
/// Vertices around the closest triangle that come along where it cannot move alone [edges].
constexpr int kMostRings = 2;
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

/// A triangle with corners that move.
struct Moving {
  std::uint32_t index;
  Corners before;
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
    const bool detail_may_move = distance <= kFarthestDetail * r_;
    const Triangle& corners = mesh_.triangles()[closest.triangle];
    std::vector<std::uint32_t> moving;
    double weight = 0.0;
    for (int k = 0; k < 3; ++k) {
      if (!may_move(corners[k], detail_may_move)) continue;
      moving.push_back(corners[k]);
      weight += closest.weights[k];
    }
    if (weight < kLeastWeight) return;
    const Vec3f move = (closest.offset * ((distance - kCovered * r_) / (distance * weight))).cast<float>();
    // Where the tip is pointed, its flanks turn unless they come along.
    for (int rings = 0; !move_vertices(moving, move) && rings < kMostRings; ++rings) {
      moving = with_neighbors(moving, detail_may_move);
    }
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

  bool may_move(std::uint32_t vertex, bool detail_may_move) const {
    return detail_may_move || mesh_.ids()[vertex] >= first_new_id_;
  }

  /// The triangles with a corner among some vertices.
  std::vector<std::uint32_t> triangles_at(const std::vector<std::uint32_t>& vertices) const {
    std::vector<std::uint32_t> found;
    for (const std::uint32_t t : near_) {
      const Triangle& corners = mesh_.triangles()[t];
      if (std::find_first_of(corners.begin(), corners.end(), vertices.begin(), vertices.end()) != corners.end())
        found.push_back(t);
    }
    return found;
  }

  /// Some vertices and those next to them that may move.
  std::vector<std::uint32_t> with_neighbors(const std::vector<std::uint32_t>& vertices, bool detail_may_move) const {
    std::vector<std::uint32_t> all = vertices;
    for (const std::uint32_t t : triangles_at(vertices)) {
      for (const std::uint32_t v : mesh_.triangles()[t]) {
        if (may_move(v, detail_may_move)) all.push_back(v);
      }
    }
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
  }

  /// Moves vertices unless that would fold or cross something, or pass over it.
  /// \return whether they have moved.
  bool move_vertices(const std::vector<std::uint32_t>& vertices, const Vec3f& move) {
    std::vector<Moving> around;
    for (const std::uint32_t t : triangles_at(vertices)) around.push_back({t, corners_of(t)});
    std::vector<Vec3f> before;
    for (const std::uint32_t v : vertices) {
      before.push_back(mesh_.positions()[v]);
      mesh_.positions()[v] += move;
    }
    if (is_sound(around, move.cast<double>())) {
      std::copy_if(vertices.begin(), vertices.end(), std::back_inserter(moved_),
                   [&](std::uint32_t v) { return mesh_.ids()[v] >= first_new_id_; });
      return true;
    }
    for (std::size_t n = 0; n < vertices.size(); ++n) mesh_.positions()[vertices[n]] = before[n];
    return false;
  }

  bool is_sound(const std::vector<Moving>& moving, const Vec3d& move) const {
    Eigen::AlignedBox3d box;
    std::vector<std::uint32_t> own;     // corners of what moves
    std::vector<PlacedTriangle> after;  // where it moves to
    for (const Moving& triangle : moving) {
      const Corners corners = corners_of(triangle.index);
      if (area_normal(corners).dot(area_normal(triangle.before)) <= 0.0) return false;
      for (const Vec3d& corner : corners) box.extend(corner);
      for (const Vec3d& corner : triangle.before) box.extend(corner);
      const Triangle& vertices = mesh_.triangles()[triangle.index];
      own.insert(own.end(), vertices.begin(), vertices.end());
      after.push_back(place_triangle(vertices, corners));
    }
    std::sort(own.begin(), own.end());
    for (const std::uint32_t other : near_) {
      const Triangle& vertices = mesh_.triangles()[other];
      const Corners corners = corners_of(other);
      Eigen::AlignedBox3d other_box;
      for (const Vec3d& corner : corners) other_box.extend(corner);
      if (!box.intersects(other_box)) continue;
      const PlacedTriangle placed = place_triangle(vertices, corners);
      const auto crosses = [&](const PlacedTriangle& triangle) { return triangles_cross(triangle, placed); };
      if (std::any_of(after.begin(), after.end(), crosses)) return false;
      for (std::size_t k = 0; k < 3; ++k) {
        if (!std::binary_search(own.begin(), own.end(), vertices[k]) && is_passed(corners[k], moving, move)) {
          return false;
        }
      }
    }
    return true;
  }

  /// Whether a triangle may pass over a place: what is small could be swallowed without crossing anything in the end.
  /// Seen from the triangle it is the place that moves.
  static bool is_passed(const Vec3d& place, const std::vector<Moving>& moving, const Vec3d& move) {
    const Corners way = {place, place - move, place - move};
    return std::any_of(moving.begin(), moving.end(),
                       [&](const Moving& triangle) { return triangles_touch(way, triangle.before); });
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
