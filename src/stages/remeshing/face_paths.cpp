#include "face_paths.h"

#include <algorithm>

#include "lattice_parts.h"

namespace particle_surface_tracker::remeshing {

namespace {

constexpr std::uint32_t kNone = 0xffffffff;

/// A segment of the mesh on a face, and the one after it.
struct Step {
  LatticePoint from;
  LatticePoint to;
  std::uint32_t next = kNone;
  bool has_previous = false;
};

bool starts_before(const Step& a, const Step& b) {
  return a.from < b.from;
}

bool is_on_edge(const LatticePoint& point) {
  return point.kind == LatticePoint::Kind::kOnLatticeEdge;
}

/// Links each step to the one that begins where it ends.
/// \return false if a point has not exactly one step on either side inside the face, and one in all on its edges.
bool link(std::vector<Step>& steps) {
  std::sort(steps.begin(), steps.end(), starts_before);
  for (std::size_t n = 0; n + 1 < steps.size(); ++n) {
    if (steps[n].from == steps[n + 1].from) return false;
  }
  for (Step& step : steps) {
    const auto next = std::lower_bound(steps.begin(), steps.end(), Step{step.to, step.to, kNone, false}, starts_before);
    const bool found = next != steps.end() && next->from == step.to;
    if (found == is_on_edge(step.to)) return false;
    if (!found) continue;
    if (next->has_previous) return false;
    next->has_previous = true;
    step.next = static_cast<std::uint32_t>(next - steps.begin());
  }
  return std::all_of(steps.begin(), steps.end(),
                     [](const Step& step) { return step.has_previous != is_on_edge(step.from); });
}

/// True if no point on the face's edges ends two paths.
bool have_distinct_ends(const std::vector<std::vector<LatticePoint>>& paths) {
  std::vector<LatticePoint> ends;
  for (const auto& path : paths) {
    ends.push_back(path.front());
    ends.push_back(path.back());
  }
  std::sort(ends.begin(), ends.end());
  return std::adjacent_find(ends.begin(), ends.end()) == ends.end();
}

}  // namespace

const FacePaths& FaceTracer::paths_on(const LatticeFace& face) {
  const auto known = faces_.find(face);
  if (known != faces_.end()) return known->second;
  return faces_.emplace(face, trace(face)).first->second;
}

FacePaths FaceTracer::trace(const LatticeFace& face) {
  FacePaths result;
  std::size_t crossed_edges = 0;
  for (const LatticeEdge& edge : edges_around(face)) {
    const std::size_t crossings = lattice().crossings_on(edge).size();
    if (crossings > 1) return result;
    crossed_edges += crossings;
  }

  const auto below = lattice().triangles_in_cell(face.lower_cell());
  const auto above = lattice().triangles_in_cell(face.upper_cell());
  std::vector<Step> steps;
  for (const std::uint32_t triangle : below.size() < above.size() ? below : above) {
    const TriangleCut& cut = cuts_.of(triangle);
    for (const TriangleCut::Segment& segment : cut.segments) {
      if (segment.face == face) steps.push_back({cut.points[segment.from], cut.points[segment.to], kNone, false});
    }
  }
  if (!link(steps)) return result;

  std::size_t walked = 0;
  for (const Step& first : steps) {
    if (!is_on_edge(first.from)) continue;
    std::vector<LatticePoint>& path = result.paths.emplace_back(1, first.from);
    for (const Step* step = &first;; step = &steps[step->next]) {
      path.push_back(step->to);
      ++walked;
      if (step->next == kNone) break;
    }
  }
  // What was not walked are closed loops.
  result.simple = walked == steps.size() && 2 * result.paths.size() == crossed_edges && result.paths.size() <= 2 &&
                  have_distinct_ends(result.paths);
  if (!result.simple) result.paths.clear();
  return result;
}

}  // namespace particle_surface_tracker::remeshing
