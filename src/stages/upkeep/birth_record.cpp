#include "birth_record.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "half_edges.h"
#include "triangle_shape.h"

namespace particle_surface_tracker {

namespace {

constexpr const char* kAttributeName = "birth";
constexpr std::size_t kComponents = 5;
/// Blends of ones are rounded.
constexpr float kWhollyRemeshed = 0.999F;

Corners corners_of(const TriangleMesh& mesh, std::uint32_t triangle) {
  return place_corners(mesh.positions(), mesh.triangles()[triangle]);
}

/// A rounded record must not be stricter than what was measured.
float rounded_down(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) <= value ? rounded : std::nextafter(rounded, 0.0F);
}

float rounded_up(double value) {
  const auto rounded = static_cast<float>(value);
  return static_cast<double>(rounded) >= value ? rounded
                                               : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

}  // namespace

BirthRecords::BirthRecords(TriangleMesh& mesh) : mesh_(mesh), attribute_(mesh.attributes().find(kAttributeName)) {
  if (attribute_ == VertexAttributes::none) {
    attribute_ = mesh.attributes().add(kAttributeName, kComponents, std::vector<float>(kComponents, 0.0F),
                                       AttributeUse::kInternal);
  }
}

BirthRecord BirthRecords::of(std::uint32_t vertex) const {
  const float* values = mesh_.attributes()[attribute_].values.data() + kComponents * vertex;
  return {values[0], values[1], values[2], values[3], values[4]};
}

void BirthRecords::set(std::uint32_t vertex, const BirthRecord& record) {
  float* values = mesh_.attributes()[attribute_].values.data() + kComponents * vertex;
  values[0] = record.shortest_edge;
  values[1] = record.longest_edge;
  values[2] = record.smallest_angle;
  values[3] = record.largest_fold;
  values[4] = record.remeshed;
}

bool BirthRecords::all_noted() const {
  for (std::uint32_t v = 0; v < mesh_.vertex_count(); ++v) {
    if (!is_noted(v)) return false;
  }
  return true;
}

void BirthRecords::begin_remeshed(std::uint32_t vertex) {
  BirthRecord record;
  record.remeshed = 1.0F;
  set(vertex, record);
}

bool BirthRecords::is_remeshed(std::uint32_t vertex) const {
  return of(vertex).remeshed > kWhollyRemeshed;
}

void BirthRecords::note_missing(const std::vector<std::uint32_t>& twins) {
  std::vector<bool> missing(mesh_.vertex_count());
  for (std::uint32_t v = 0; v < missing.size(); ++v) {
    missing[v] = !is_noted(v);
    constexpr float kUnbounded = std::numeric_limits<float>::max();
    if (missing[v]) set(v, {kUnbounded, 0.0F, kUnbounded, 0.0F, of(v).remeshed});
  }
  for (std::uint32_t t = 0; t < mesh_.triangle_count(); ++t) {
    const Triangle& triangle = mesh_.triangles()[t];
    if (!missing[triangle[0]] && !missing[triangle[1]] && !missing[triangle[2]]) continue;
    const Corners corners = corners_of(mesh_, t);
    const double angle = std::asin(std::min(1.0, sine_of_smallest_angle(corners)));
    for (std::uint32_t k = 0; k < 3; ++k) {
      const double length = (corners[(k + 1) % 3] - corners[k]).norm();
      const double fold = fold_between(area_normal(corners), area_normal(corners_of(mesh_, twins[3 * t + k] / 3)));
      for (const std::uint32_t v : {triangle[k], triangle[(k + 1) % 3]}) {
        if (!missing[v]) continue;
        const BirthRecord before = of(v);
        set(v, {std::min(before.shortest_edge, rounded_down(length)), std::max(before.longest_edge, rounded_up(length)),
                std::min(before.smallest_angle, rounded_down(angle)), std::max(before.largest_fold, rounded_up(fold)),
                before.remeshed});
      }
    }
  }
}

double BirthRecords::longest_edge(std::uint32_t a, std::uint32_t b) const {
  return std::min(of(a).longest_edge, of(b).longest_edge);
}

double BirthRecords::shortest_edge(std::uint32_t a, std::uint32_t b) const {
  return std::max(of(a).shortest_edge, of(b).shortest_edge);
}

double BirthRecords::largest_fold(std::uint32_t a, std::uint32_t b) const {
  return std::min(of(a).largest_fold, of(b).largest_fold);
}

double BirthRecords::smallest_angle(const Triangle& triangle) const {
  return std::max({of(triangle[0]).smallest_angle, of(triangle[1]).smallest_angle, of(triangle[2]).smallest_angle});
}

double longest_edge_at_birth(const TriangleMesh& mesh, std::uint32_t a, std::uint32_t b) {
  const std::size_t attribute = mesh.attributes().find(kAttributeName);
  if (attribute == VertexAttributes::none) return 0.0;
  const float* values = mesh.attributes()[attribute].values.data();
  constexpr std::size_t kLongest = 1;
  return std::min(values[kComponents * a + kLongest], values[kComponents * b + kLongest]);
}

}  // namespace particle_surface_tracker
