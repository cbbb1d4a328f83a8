#include "fresh_delta.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

namespace particle_surface_tracker {

namespace {

struct Range {
  float low = std::numeric_limits<float>::max();
  float high = std::numeric_limits<float>::lowest();
};

/// δ of the vertices next to each of `vertices`.
std::vector<Range> delta_around(const TriangleMesh& mesh, const std::vector<FreshVertex>& vertices) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> place(mesh.vertex_count(), none);
  for (std::uint32_t n = 0; n < vertices.size(); ++n) place[vertices[n].index] = n;
  std::vector<Range> ranges(vertices.size());
  for (const Triangle& t : mesh.triangles()) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (place[t[k]] == none) continue;
      Range& range = ranges[place[t[k]]];
      for (const std::uint32_t other : {t[(k + 1) % 3], t[(k + 2) % 3]}) {
        range.low = std::min(range.low, mesh.delta()[other]);
        range.high = std::max(range.high, mesh.delta()[other]);
      }
    }
  }
  return ranges;
}

}  // namespace

double measure_fresh_delta(TriangleMesh& mesh, const std::vector<FreshVertex>& fresh, NarrowBand& band,
                           const Parameters& parameters, FrameReport& report) {
  std::vector<FreshVertex> vertices;
  for (const FreshVertex& vertex : fresh) {
    if (vertex.has_detail) {
      vertices.push_back(vertex);
    } else {
      mesh.delta()[vertex.index] = 0.0F;
    }
  }
  if (vertices.empty()) return 0.0;
  std::vector<Vec3f> positions;
  positions.reserve(vertices.size());
  for (const FreshVertex& vertex : vertices) positions.push_back(mesh.positions()[vertex.index]);
  const double r = parameters.particle_spacing;
  const Projection measured =
      band.project(positions, std::vector<float>(positions.size(), 0.0f), parameters.tau * r, parameters.max_reach * r);
  const std::vector<Range> around = delta_around(mesh, vertices);
  const auto tolerance = static_cast<float>(parameters.tau * r);
  std::vector<float> deltas(vertices.size());
  std::size_t lost = 0;
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    const float blended = mesh.delta()[vertices[n].index];
    deltas[n] = blended;
    if (measured.status[n] != ProjectionStatus::kFound) {
      ++lost;
      continue;
    }
    if (vertices[n].is_remeshed) {
      if (std::abs(measured.distances[n] - blended) <= tolerance) deltas[n] = measured.distances[n];
    } else {
      deltas[n] = std::clamp(measured.distances[n], around[n].low, around[n].high);
    }
  }
  double largest = 0.0;
  for (std::size_t n = 0; n < vertices.size(); ++n) {
    mesh.delta()[vertices[n].index] = deltas[n];
    largest = std::max(largest, std::abs(static_cast<double>(deltas[n])));
  }
  if (lost > 0) {
    report.warnings.push_back(fmt::format(
        "{} of {} new vertices have no implicit surface near them; their δ is that of the surface that they "
        "replace",
        lost, vertices.size()));
  }
  return largest;
}

}  // namespace particle_surface_tracker
