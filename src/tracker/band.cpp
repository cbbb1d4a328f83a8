#include "band.h"

#include <algorithm>
#include <cmath>

#include "particle_surface_tracker/stages/distance_field.h"

namespace particle_surface_tracker {

namespace {

/// Projects more and more of what is left over with larger and larger fields.
class BandProjection {
 public:
  BandProjection(const std::vector<Vec3f>& vertices, const std::vector<float>& delta, const ImplicitSurface& surface,
                 const Parameters& parameters, StageTimer& timer)
      : vertices_(vertices),
        delta_(delta),
        // The farthest node of a cubic stencil is a diagonal of two cells beyond the vertex.
        stencil_reach_(2.0 * std::sqrt(3.0) * surface.dx),
        parameters_(parameters),
        timer_(timer),
        fields_(surface) {}

  Projection run(double reach, double max_reach) {
    const SignedDistanceField stencils = fields_.at_stencils(vertices_, reach + stencil_reach_);
    timer_.begin("projection");
    result_ = project(vertices_, delta_, stencils, parameters_);
    project_absent(
        [&](const std::vector<Vec3f>& absent) { return fields_.on_ways(absent, max_reach + stencil_reach_); });
    for (double wider_reach = reach;; wider_reach = std::min(2.0 * wider_reach, max_reach)) {
      const bool has_absent = project_absent(
          [&](const std::vector<Vec3f>& absent) { return fields_.around(absent, wider_reach + stencil_reach_); });
      if (!has_absent || wider_reach >= max_reach) return std::move(result_);
    }
  }

 private:
  /// Projects the vertices again that no field so far leads to the isosurface.
  /// \return false if there are none.
  template <typename MakeField>
  bool project_absent(MakeField&& make_field) {
    std::vector<std::uint32_t> absent;
    std::vector<Vec3f> absent_vertices;
    std::vector<float> absent_delta;
    for (std::uint32_t v = 0; v < vertices_.size(); ++v) {
      if (result_.status[v] != ProjectionStatus::kAbsent) continue;
      absent.push_back(v);
      absent_vertices.push_back(vertices_[v]);
      absent_delta.push_back(delta_[v]);
    }
    if (absent.empty()) return false;
    timer_.begin("distance_field");
    const SignedDistanceField field = make_field(absent_vertices);
    timer_.begin("projection");
    const Projection wider = project(absent_vertices, absent_delta, field, parameters_);
    for (std::size_t n = 0; n < absent.size(); ++n) {
      result_.positions[absent[n]] = wider.positions[n];
      result_.distances[absent[n]] = wider.distances[n];
      result_.status[absent[n]] = wider.status[n];
    }
    return true;
  }

  const std::vector<Vec3f>& vertices_;
  const std::vector<float>& delta_;
  double stencil_reach_;
  const Parameters& parameters_;
  StageTimer& timer_;
  DistanceFields fields_;
  Projection result_;
};

}  // namespace

Projection project_within_band(const std::vector<Vec3f>& vertices, const std::vector<float>& delta,
                               const ImplicitSurface& surface, double reach, double max_reach,
                               const Parameters& parameters, StageTimer& timer) {
  timer.begin("distance_field");
  return BandProjection(vertices, delta, surface, parameters, timer).run(reach, max_reach);
}

}  // namespace particle_surface_tracker
