#include "operations.h"

#include <algorithm>
#include <array>

#include "butterfly.h"
#include "guards.h"
#include "vertex_rank.h"

namespace particle_surface_tracker {

namespace {

/// An operation moves the surface by at most this part of the local size, on average over its triangles.
constexpr double kMaxMeanMove = 0.05;
/// A butterfly position farther from the midpoint than this part of the edge is no smooth continuation: an edge that
/// spans 60° of a circle has it at 0.13.
constexpr double kMaxOffset = 0.2;
/// A flip must improve the smallest angle's sine by this factor.
constexpr double kFlipGain = 1.2;
constexpr std::uint32_t kLeastValence = 3;
/// Cells in which triangles are looked up [sizes]: nearly all triangles are smaller, so that nearly all searches look
/// at one lattice. Half as large and half as large again are slower, by a tenth of upkeep and a little.
constexpr double kSmallestCell = 2.0;

}  // namespace

Operations::Operations(EditableSurface& surface, const BirthRecords& births, const Tolerances& tolerances, double size)
    : surface_(surface), births_(births), tolerances_(tolerances), size_(size) {}

Vec3f Operations::split_position(std::uint32_t half_edge) const {
  return is_on_ridge(half_edge) ? edge_midpoint(surface_, half_edge).cast<float>() : smooth_position(half_edge);
}

std::uint32_t Operations::split(std::uint32_t half_edge, Vec3f position) {
  if (!may_split_at(half_edge, position)) {
    position = edge_midpoint(surface_, half_edge).cast<float>();
    plan_split(surface_, half_edge, position, patch_);
    if (!has_no_degenerate_triangle(patch_)) return kNone;
  }
  const std::uint32_t vertex = surface_.split(half_edge, position);
  enter_around(vertex);
  return vertex;
}

std::uint32_t Operations::collapse(std::uint32_t half_edge) {
  if (!meets_link_condition(surface_, half_edge, indices_)) return kNone;
  const std::uint32_t twin = surface_.twin(half_edge);
  const auto& ids = surface_.mesh().ids();
  // The older vertex is at the end, where it stays.
  const std::uint32_t onto_older = ids[surface_.end(half_edge)] < ids[surface_.start(half_edge)] ? half_edge : twin;
  const std::uint32_t onto_younger = surface_.twin(onto_older);
  const int older_rank = vertex_rank(surface_, surface_.end(onto_older));
  const int younger_rank = vertex_rank(surface_, surface_.end(onto_younger));

  const Vec3f& older_position = surface_.stored_position(surface_.end(onto_older));
  const Vec3f& younger_position = surface_.stored_position(surface_.end(onto_younger));
  // By value: a collapse may move what a reference would be to.
  // NOLINTNEXTLINE(performance-unnecessary-value-param)
  const auto collapse_to = [this](std::uint32_t onto, const Vec3f position) {
    if (!may_collapse_to(onto, position)) return false;
    const std::uint32_t kept = surface_.end(onto);
    surface_.collapse(onto, position);
    enter_around(kept);
    return true;
  };
  const std::uint32_t older = surface_.end(onto_older), younger = surface_.end(onto_younger);
  if (older_rank == 1 && younger_rank == 1 && collapse_to(onto_older, smooth_position(onto_older))) return older;
  if (older_rank >= younger_rank && collapse_to(onto_older, older_position)) return older;
  if (younger_rank >= older_rank && collapse_to(onto_younger, younger_position)) return younger;
  // Around needles and folds the ranks say little: before the edge is left as it is, any place will do that the guards
  // agree with.
  if (older_rank + younger_rank > 2 && collapse_to(onto_older, smooth_position(onto_older))) return older;
  if (older_rank < younger_rank && collapse_to(onto_older, older_position)) return older;
  if (younger_rank < older_rank && collapse_to(onto_younger, younger_position)) return younger;
  return kNone;
}

bool Operations::flip(std::uint32_t half_edge) {
  if (!may_flip(half_edge)) return false;
  const std::uint32_t twin = surface_.twin(half_edge);
  surface_.flip(half_edge);
  if (surroundings_) {
    surroundings_->enter(half_edge / 3);
    surroundings_->enter(twin / 3);
  }
  return true;
}

bool Operations::is_on_ridge(std::uint32_t half_edge) const {
  return vertex_rank(surface_, surface_.start(half_edge)) > 1 || vertex_rank(surface_, surface_.end(half_edge)) > 1;
}

Vec3f Operations::smooth_position(std::uint32_t half_edge) const {
  const Vec3d middle = edge_midpoint(surface_, half_edge);
  const Vec3d smooth = butterfly_position(surface_, half_edge);
  const double length =
      (surface_.position(surface_.end(half_edge)) - surface_.position(surface_.start(half_edge))).norm();
  return ((smooth - middle).norm() <= kMaxOffset * length ? smooth : middle).cast<float>();
}

bool Operations::may_split_at(std::uint32_t half_edge, const Vec3f& position) {
  plan_split(surface_, half_edge, position, patch_);
  return has_no_degenerate_triangle(patch_) && keeps_normals(patch_) &&
         keeps_volume(surface_, patch_, volume_limit(half_edge)) &&
         keeps_folds(surface_, patch_, tolerances_.fold_angle()) && is_clear();
}

bool Operations::may_collapse_to(std::uint32_t half_edge, const Vec3f& position) {
  plan_collapse(surface_, half_edge, position, patch_);
  return has_no_duplicate_triangle(patch_) && has_no_degenerate_triangle(patch_) &&
         has_no_long_edge(patch_, tolerances_) && keeps_volume(surface_, patch_, volume_limit(half_edge)) &&
         keeps_normals(patch_) && keeps_angles(surface_, patch_, tolerances_) &&
         keeps_folds(surface_, patch_, tolerances_.fold_angle()) && is_clear();
}

bool Operations::may_flip(std::uint32_t half_edge) {
  const std::uint32_t twin = surface_.twin(half_edge);
  const std::uint32_t start = surface_.start(half_edge), end = surface_.end(half_edge);
  const std::uint32_t left = surface_.apex(half_edge), right = surface_.apex(twin);
  if (surface_.valence(start) <= kLeastValence || surface_.valence(end) <= kLeastValence) return false;
  bool is_taken = false;
  surface_.for_each_outgoing(left, [&](std::uint32_t h) { is_taken = is_taken || surface_.end(h) == right; });
  if (is_taken) return false;
  const double squared_length = (surface_.position(right) - surface_.position(left)).squaredNorm();
  if (tolerances_.is_short(left, right, squared_length)) return false;

  plan_flip(surface_, half_edge, patch_);
  const double before = std::min(sine_of_smallest_angle(surface_.corners(half_edge / 3)),
                                 sine_of_smallest_angle(surface_.corners(twin / 3)));
  const double after = std::min(sine_of_smallest_angle(patch_.triangles[0].corners),
                                sine_of_smallest_angle(patch_.triangles[1].corners));
  return after > kFlipGain * before && has_no_degenerate_triangle(patch_) && has_no_long_edge(patch_, tolerances_) &&
         keeps_volume(surface_, patch_, volume_limit(half_edge)) && keeps_normals(patch_) &&
         keeps_folds(surface_, patch_, tolerances_.fold_angle()) && is_clear();
}

bool Operations::is_clear() {
  if (!surroundings_) surroundings_.emplace(surface_, kSmallestCell * size_);
  if (clearance_.stays_clear(surface_, patch_, *surroundings_)) return true;
  ++crossings_;
  return false;
}

double Operations::volume_limit(std::uint32_t half_edge) const {
  return kMaxMeanMove * std::min(size_, births_.longest_edge(surface_.start(half_edge), surface_.end(half_edge)));
}

void Operations::enter_around(std::uint32_t vertex) {
  if (!surroundings_) return;
  surface_.for_each_outgoing(vertex, [this](std::uint32_t h) { surroundings_->enter(h / 3); });
}

}  // namespace particle_surface_tracker
