#include "band.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace particle_surface_tracker {

namespace {

DistanceFields prepare_fields(const ImplicitSurface& surface, StageTimer& timer) {
  timer.begin("distance_field");
  return DistanceFields(surface);
}

/// Projects the vertices again that no field so far leads to the isosurface.
class AbsentVertices {
 public:
  AbsentVertices(const std::vector<Vec3f>& vertices, const std::vector<float>& delta, const Parameters& parameters,
                 StageTimer& timer, Projection& result)
      : vertices_(vertices), delta_(delta), parameters_(parameters), timer_(timer), result_(result) {}

  /// \param make_field makes the field for such vertices.
  /// \return false if there are none.
  template <typename MakeField>
  bool project_with(MakeField&& make_field) {
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

 private:
  const std::vector<Vec3f>& vertices_;
  const std::vector<float>& delta_;
  const Parameters& parameters_;
  StageTimer& timer_;
  Projection& result_;
};

}  // namespace

NarrowBand::NarrowBand(const ImplicitSurface& surface, const Parameters& parameters, StageTimer& timer)
    : parameters_(parameters),
      timer_(timer),
      // The farthest node of a cubic stencil is a diagonal of two cells beyond the vertex.
      stencil_reach_(2.0 * std::sqrt(3.0) * surface.dx),
      fields_(prepare_fields(surface, timer)) {}

Projection NarrowBand::project(const std::vector<Vec3f>& vertices, const std::vector<float>& delta, double reach,
                               double max_reach) {
  if (!stencils_) {
    timer_.begin("distance_field");
    stencils_ = fields_.at_stencils(vertices, reach + stencil_reach_);
  }
  timer_.begin("projection");
  Projection result = particle_surface_tracker::project(vertices, delta, *stencils_, parameters_);
  AbsentVertices absent(vertices, delta, parameters_, timer_, result);
  absent.project_with(
      [&](const std::vector<Vec3f>& positions) { return fields_.on_ways(positions, max_reach + stencil_reach_); });
  for (double wider_reach = reach;; wider_reach = std::min(2.0 * wider_reach, max_reach)) {
    const bool has_absent = absent.project_with(
        [&](const std::vector<Vec3f>& positions) { return fields_.around(positions, wider_reach + stencil_reach_); });
    if (!has_absent || wider_reach >= max_reach) return result;
  }
}

}  // namespace particle_surface_tracker
