#include <algorithm>
#include <array>
#include <limits>
#include <utility>

#include <Eigen/Geometry>

#include "patch_places.h"

namespace particle_surface_tracker::remeshing {

namespace {

constexpr int kRounds = 8;
constexpr double kStep = 0.5;
/// A vertex moves no farther from where it was placed than that [cells].
constexpr double kFarthest = 0.4;
/// A triangle may turn by that much in one round (cosine).
constexpr double kLeastCosine = 0.5;

class Smoother {
 public:
  Smoother(double h, Patch& patch) : h_(h), patch_(patch) {
    places_.reserve(patch.vertices.size());
    for (const PatchVertex& vertex : patch.vertices) places_.push_back(vertex.position);
    start_ = places_;
  }

  void run() {
    for (int round = 0; round < kRounds; ++round) {
      std::vector<Vec3d> next = moved_places();
      take_back_turned(next);
      places_ = std::move(next);
    }
    for (std::size_t v = 0; v < places_.size(); ++v) patch_.vertices[v].position = places_[v];
    for_each_fan([&](std::size_t begin, std::size_t end) { center_fan(begin, end); });
  }

 private:
  bool may_move(std::size_t v) const { return patch_.vertices[v].kind != PatchVertex::Kind::kFront; }

  std::size_t local(std::uint32_t vertex) const { return vertex - patch_.first_vertex(); }

  /// Calls visit(a, b, c) for every triangle of the filling, with numbers of the patch's vertices.
  template <typename Visit>
  void for_each_triangle(Visit&& visit) const {
    for (std::size_t t = patch_.first_filling; t < patch_.triangles.size(); ++t) {
      const auto& [a, b, c] = patch_.triangles[t];
      visit(local(a), local(b), local(c));
    }
  }

  std::vector<Vec3d> moved_places() const {
    std::vector<Vec3d> normals(places_.size(), Vec3d::Zero());
    std::vector<Vec3d> sums(places_.size(), Vec3d::Zero());
    std::vector<double> weights(places_.size(), 0.0);
    for_each_triangle([&](std::size_t a, std::size_t b, std::size_t c) {
      const Vec3d normal = (places_[b] - places_[a]).cross(places_[c] - places_[a]);
      const double area = normal.norm();
      const Vec3d middle = (places_[a] + places_[b] + places_[c]) / 3.0;
      for (const std::size_t v : {a, b, c}) {
        normals[v] += normal;
        sums[v] += area * middle;
        weights[v] += area;
      }
    });
    std::vector<Vec3d> next = places_;
    for (std::size_t v = 0; v < places_.size(); ++v) {
      const double squared = normals[v].squaredNorm();
      if (!may_move(v) || !(squared > 0.0)) continue;
      Vec3d move = kStep * (sums[v] / weights[v] - places_[v]);
      move -= move.dot(normals[v]) / squared * normals[v];
      const Vec3d way = places_[v] + move - start_[v];
      const double length = way.norm();
      next[v] = start_[v] + (length > kFarthest * h_ ? kFarthest * h_ / length : 1.0) * way;
    }
    return next;
  }

  /// Leaves vertices where they are while a triangle of theirs would turn too far.
  void take_back_turned(std::vector<Vec3d>& next) const {
    bool again = true;
    while (again) {
      again = false;
      for_each_triangle([&](std::size_t a, std::size_t b, std::size_t c) {
        const Vec3d before = (places_[b] - places_[a]).cross(places_[c] - places_[a]);
        const Vec3d after = (next[b] - next[a]).cross(next[c] - next[a]);
        if (before.dot(after) >= kLeastCosine * before.norm() * after.norm() && after.squaredNorm() > 0.0) return;
        for (const std::size_t v : {a, b, c}) {
          if (next[v] == places_[v]) continue;
          next[v] = places_[v];
          again = true;
        }
      });
    }
  }

  /// Calls visit(begin, end) for the triangles around every centre: they begin with it and go once round its loop.
  template <typename Visit>
  void for_each_fan(Visit&& visit) const {
    for (std::size_t t = patch_.first_filling; t < patch_.triangles.size();) {
      const std::size_t begin = t;
      const std::uint32_t center = patch_.triangles[begin][0];
      while (t < patch_.triangles.size() && patch_.triangles[t][0] == center) ++t;
      if (patch_.vertex(center).kind == PatchVertex::Kind::kCenter) visit(begin, t);
    }
  }

  /// Moves the middle of a fan, in the plane of its loop, until it is on the inner side of every edge of the loop, if
  /// there is such a place nearby: the line along which the mesh was cut may wind.
  void center_fan(std::size_t begin, std::size_t end) {
    constexpr std::array<double, 3> margins{0.02, 0.005, 0.001};  // [cells]
    const auto at = [&](std::uint32_t vertex) -> const Vec3d& { return patch_.vertex(vertex).position; };
    Vec3d& center = patch_.vertex(patch_.triangles[begin][0]).position;
    const Vec3d& placed = start_[local(patch_.triangles[begin][0])];
    Vec3d normal = Vec3d::Zero();
    for (std::size_t t = begin; t < end; ++t) {
      normal += (at(patch_.triangles[t][1]) - center).cross(at(patch_.triangles[t][2]) - center);
    }
    normal.stableNormalize();
    std::vector<HalfPlane> inner_sides;
    for (std::size_t t = begin; t < end; ++t) {
      const Vec3d& from = at(patch_.triangles[t][1]);
      const Vec3d inwards = normal.cross(at(patch_.triangles[t][2]) - from).stableNormalized();
      inner_sides.push_back({inwards, inwards.dot(from)});
    }
    for (const double margin : margins) {
      const Vec3d moved = moved_inside(inner_sides, center, margin * h_);
      const bool is_near = (moved - placed).norm() <= kFarthest * h_;
      if (is_near && depth(inner_sides, moved).first > depth(inner_sides, center).first) center = moved;
      if (depth(inner_sides, center).first >= margin * h_) return;
    }
  }

  /// All places x with inwards · x ≥ begin.
  struct HalfPlane {
    Vec3d inwards;
    double begin;
  };

  /// How far a place is inside all half-planes, and which one is the nearest.
  static std::pair<double, const HalfPlane*> depth(const std::vector<HalfPlane>& inner_sides, const Vec3d& place) {
    std::pair<double, const HalfPlane*> least{std::numeric_limits<double>::infinity(), nullptr};
    for (const HalfPlane& side : inner_sides) {
      const double distance = side.inwards.dot(place) - side.begin;
      if (distance < least.first) least = {distance, &side};
    }
    return least;
  }

  /// Moves a place across the half-plane that it is farthest outside of, again and again.
  static Vec3d moved_inside(const std::vector<HalfPlane>& inner_sides, Vec3d place, double margin) {
    constexpr int kMoves = 64;
    for (int move = 0; move < kMoves; ++move) {
      const auto [distance, side] = depth(inner_sides, place);
      if (distance >= margin) break;
      place += (1.5 * margin - distance) * side->inwards;
    }
    return place;
  }

  double h_;
  Patch& patch_;
  std::vector<Vec3d> places_;
  std::vector<Vec3d> start_;
};

}  // namespace

void smooth_filling(double h, Patch& patch) {
  Smoother(h, patch).run();
}

}  // namespace particle_surface_tracker::remeshing
