#include "surface_search.h"

#include <algorithm>
#include <cmath>

#include "stages/nodes/lattice_cell.h"

namespace particle_surface_tracker {

namespace {

/// A gradient shorter than this has no direction to follow: the middle of a sheet, the centre of a drop.
constexpr double kSmallestSlope = 1e-3;

/// Where |φ| is smaller, φ is so close to a plane that long steps end where many short ones do: two of 0.8 φ take the
/// place of seven of 0.35 φ. They stop short of the surface, as those do [cells].
constexpr double kNear = 0.1;
constexpr double kNearStep = 0.8;

}  // namespace

SurfaceSearch::SurfaceSearch(const SignedDistanceField& field, const FieldLeaves& leaves, const SearchLimits& limits)
    : stencil_(leaves),
      kernel_(active_tricubic_kernel()),
      limits_(limits),
      dx_(field.dx),
      largest_(static_cast<float>(2.0 * (field.reach + 8.0 * field.dx))),
      smallest_slope_(static_cast<float>(kSmallestSlope * field.dx)) {}

void SurfaceSearch::find(const std::vector<Vec3f>& vertices, std::size_t begin, std::size_t end,
                         std::vector<SurfacePoint>& found) {
  std::size_t next = begin;
  for (int l = 0; l < TricubicBatch::lanes; ++l) refill(l, vertices, next, end, found);
  const StepLength step_length = {static_cast<float>(limits_.epsilon / dx_),
                                  static_cast<float>(std::max<double>(kNearStep, limits_.epsilon) / dx_),
                                  static_cast<float>(kNear * dx_)};
  for (bool busy = true; busy;) {
    kernel_(batch_, step_length);
    busy = false;
    for (int l = 0; l < TricubicBatch::lanes; ++l) {
      if (!lanes_[l].busy) continue;
      if (settle(l, vertices, found[lanes_[l].vertex])) {
        refill(l, vertices, next, end, found);
      } else {
        advance(l);
      }
      busy = busy || lanes_[l].busy;
    }
  }
}

void SurfaceSearch::refill(int l, const std::vector<Vec3f>& vertices, std::size_t& next, std::size_t end,
                           std::vector<SurfacePoint>& found) {
  Lane& lane = lanes_[l];
  lane.busy = false;
  for (; next < end; ++next) {
    const Vec3d lattice = vertices[next].cast<double>() / dx_;
    if (!has_cell(lattice)) {
      found[next].status = ProjectionStatus::kAbsent;
      continue;
    }
    lane.busy = true;
    lane.vertex = next++;
    lane.steps = 0;
    lane.cell = cell_of(lattice);
    for (int axis = 0; axis < 3; ++axis) batch_.place[axis][l] = static_cast<float>(lattice[axis] - lane.cell[axis]);
    stencil_.load(lane.cell, &batch_.nodes[0][l], TricubicBatch::lanes);
    return;
  }
}

bool SurfaceSearch::settle(int l, const std::vector<Vec3f>& vertices, SurfacePoint& found) {
  const Lane& lane = lanes_[l];
  const float value = batch_.value[l];
  const float slope = batch_.slope[l];
  // An absent node is so large that it lifts value or slope beyond anything a distance field has, unless its weight is
  // 0.
  if (!(std::abs(value) <= largest_ && slope <= largest_)) {
    found.status = ProjectionStatus::kAbsent;
    return true;
  }
  if (lane.steps == 0) found.start_value = value;
  if (slope < smallest_slope_) return true;
  if (std::abs(value) < limits_.tolerance) {
    found.status = ProjectionStatus::kFound;
    const Vec3d gradient(batch_.gradient[0][l], batch_.gradient[1][l], batch_.gradient[2][l]);
    found.normal = gradient.normalized();
    if (lane.steps == 0) {
      found.position = vertices[lane.vertex].cast<double>();
    } else {
      for (int axis = 0; axis < 3; ++axis) {
        found.position[axis] = (lane.cell[axis] + static_cast<double>(batch_.place[axis][l])) * dx_;
      }
    }
    return true;
  }
  return lane.steps == limits_.max_steps;
}

void SurfaceSearch::advance(int l) {
  Lane& lane = lanes_[l];
  ++lane.steps;
  for (int axis = 0; axis < 3; ++axis) batch_.place[axis][l] = batch_.next[axis][l];
  const openvdb::Coord cells(batch_.cells[0][l], batch_.cells[1][l], batch_.cells[2][l]);
  if (cells == openvdb::Coord(0)) return;
  lane.cell += cells;
  stencil_.load(lane.cell, &batch_.nodes[0][l], TricubicBatch::lanes);
}

}  // namespace particle_surface_tracker
