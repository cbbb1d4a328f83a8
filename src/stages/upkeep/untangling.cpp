#include "particle_surface_tracker/stages/untangling.h"

#include <algorithm>
#include <cmath>

#include <tbb/parallel_for.h>
#include <Eigen/Geometry>

#include "birth_record.h"
#include "core/disjoint_sets.h"
#include "crossing_search.h"
#include "half_edges.h"
#include "triangle_shape.h"

namespace particle_surface_tracker {

namespace {

constexpr double kRadiansPerDegree = 3.14159265358979323846 / 180.0;
/// Triangles are looked at next to edges that are folded by more than this [rad], and by more than at birth by the
/// other. With 60 degrees instead no more crossings are found on recorded sequences, and it takes three times as long.
constexpr double kFold = 120.0 * kRadiansPerDegree;
constexpr double kFoldGrowth = 20.0 * kRadiansPerDegree;

constexpr std::uint32_t kTrianglesPerTask = 2048;

/// Most steps of the relaxation of one set of vertices, and how often the set grows by a ring when they do not help.
constexpr int kMostSteps = 10;
constexpr int kMostRings = 2;
/// Part of the way to the mean of its neighbours that a vertex goes in one step.
constexpr double kStep = 0.5;

using Indices = std::vector<std::uint32_t>;

void sort_out(Indices& indices) {
  std::sort(indices.begin(), indices.end());
  indices.erase(std::unique(indices.begin(), indices.end()), indices.end());
}

class Untangling {
 public:
  Untangling(TriangleMesh& mesh, const Indices& twins)
      : mesh_(mesh), connected_{mesh.positions(), mesh.triangles(), twins}, births_(mesh) {}

  UntanglingReport run() {
    const std::vector<CrossingPair> crossings = find_crossings(connected_, triangles_at_new_folds());
    for (const Indices& tangle : tangles_of(crossings)) {
      ++report_.tangles;
      if (mend(tangle)) ++report_.untangled;
    }
    sort_out(report_.moved);
    return std::move(report_);
  }

 private:
  Vec3d normal(std::uint32_t triangle) const {
    const auto& [a, b, c] = connected_.triangles[triangle];
    const auto& p = connected_.positions;
    return area_normal({p[a].cast<double>(), p[b].cast<double>(), p[c].cast<double>()});
  }

  bool is_new_fold(std::uint32_t half_edge, const Vec3d& normal_here) const {
    const Vec3d normal_beyond = normal(connected_.twins[half_edge] / 3);
    const double dot = normal_here.dot(normal_beyond);
    // Nearly all edges are settled by the sign, or without a root.
    if (dot >= 0.0) return false;
    if (dot * dot < cosine_of_fold_ * cosine_of_fold_ * normal_here.squaredNorm() * normal_beyond.squaredNorm()) {
      return false;
    }
    const double at_birth =
        births_.largest_fold(start_of(connected_.triangles, half_edge), end_of(connected_.triangles, half_edge));
    return fold_between(normal_here, normal_beyond) > std::max(kFold, at_birth + kFoldGrowth);
  }

  /// All triangles at the ends of edges that have folded.
  Indices triangles_at_new_folds() const {
    const auto count = static_cast<std::uint32_t>(connected_.triangles.size());
    const std::uint32_t tasks = (count + kTrianglesPerTask - 1) / kTrianglesPerTask;
    std::vector<Indices> found(tasks);
    tbb::parallel_for(std::uint32_t{0}, tasks, [&](std::uint32_t task) {
      const std::uint32_t end = std::min(count, (task + 1) * kTrianglesPerTask);
      for (std::uint32_t t = task * kTrianglesPerTask; t < end; ++t) {
        const Vec3d normal_here = normal(t);
        for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
          if (connected_.twins[h] < h || !is_new_fold(h, normal_here)) continue;
          for (const std::uint32_t at_end : {h, next_half_edge(h)}) {
            connected_.for_each_around(at_end, [&](std::uint32_t around) { found[task].push_back(around / 3); });
          }
        }
      }
    });
    Indices all;
    for (const Indices& part : found) all.insert(all.end(), part.begin(), part.end());
    sort_out(all);
    return all;
  }

  /// Crossing triangles, joined where they cross or share a vertex.
  std::vector<Indices> tangles_of(const std::vector<CrossingPair>& crossings) const {
    Indices members;
    for (const auto& [a, b] : crossings) members.insert(members.end(), {a, b});
    sort_out(members);
    DisjointSets joined(members.size());
    const auto number = [&](std::uint32_t triangle) {
      return static_cast<std::uint32_t>(std::lower_bound(members.begin(), members.end(), triangle) - members.begin());
    };
    for (const auto& [a, b] : crossings) joined.join(number(a), number(b));
    std::vector<std::pair<std::uint32_t, std::uint32_t>> at_vertex;
    for (std::uint32_t n = 0; n < members.size(); ++n) {
      for (const std::uint32_t v : connected_.triangles[members[n]]) at_vertex.emplace_back(v, n);
    }
    std::sort(at_vertex.begin(), at_vertex.end());
    for (std::size_t n = 1; n < at_vertex.size(); ++n) {
      if (at_vertex[n].first == at_vertex[n - 1].first) joined.join(at_vertex[n].second, at_vertex[n - 1].second);
    }
    std::vector<Indices> tangles(joined.count());
    const Indices labels = joined.labels();
    for (std::uint32_t n = 0; n < members.size(); ++n) tangles[labels[n]].push_back(members[n]);
    return tangles;
  }

  /// Half-edges from the vertices of some triangles, one for each vertex, by vertex.
  Indices starts_of(const Indices& triangles) const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> starts;
    for (const std::uint32_t t : triangles) {
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) starts.emplace_back(start_of(connected_.triangles, h), h);
    }
    std::sort(starts.begin(), starts.end());
    Indices half_edges;
    for (std::size_t n = 0; n < starts.size(); ++n) {
      if (n == 0 || starts[n].first != starts[n - 1].first) half_edges.push_back(starts[n].second);
    }
    return half_edges;
  }

  /// All triangles at the starts of some half-edges.
  Indices triangles_around(const Indices& starts) const {
    Indices triangles;
    for (const std::uint32_t start : starts) {
      connected_.for_each_around(start, [&](std::uint32_t h) { triangles.push_back(h / 3); });
    }
    sort_out(triangles);
    return triangles;
  }

  /// Relaxes the vertices of a tangle, then also those around it. On failure they are where they were.
  bool mend(const Indices& tangle) {
    Indices triangles = tangle;
    for (int ring = 0; ring < kMostRings; ++ring) {
      const Indices starts = starts_of(triangles);
      const Indices affected = triangles_around(starts);
      if (relax(starts, affected)) {
        for (const std::uint32_t h : starts) report_.moved.push_back(start_of(connected_.triangles, h));
        return true;
      }
      triangles = affected;
    }
    return false;
  }

  bool relax(const Indices& starts, const Indices& affected) {
    std::vector<Vec3f>& positions = mesh_.positions();
    std::vector<Vec3f> before;
    before.reserve(starts.size());
    for (const std::uint32_t h : starts) before.push_back(positions[start_of(connected_.triangles, h)]);
    std::vector<Vec3f> next(starts.size());
    CrossingPair crossing{0, 0};
    for (int step = 0; step < kMostSteps; ++step) {
      for (std::size_t n = 0; n < starts.size(); ++n) next[n] = relaxed(starts[n]);
      for (std::size_t n = 0; n < starts.size(); ++n) positions[start_of(connected_.triangles, starts[n])] = next[n];
      if (is_clean(affected, crossing)) return true;
    }
    for (std::size_t n = 0; n < starts.size(); ++n) positions[start_of(connected_.triangles, starts[n])] = before[n];
    return false;
  }

  Vec3f relaxed(std::uint32_t start) const {
    Vec3d sum = Vec3d::Zero();
    int count = 0;
    connected_.for_each_around(start, [&](std::uint32_t h) {
      sum += connected_.positions[end_of(connected_.triangles, h)].cast<double>();
      ++count;
    });
    const Vec3d here = connected_.positions[start_of(connected_.triangles, start)].cast<double>();
    return ((1.0 - kStep) * here + kStep / count * sum).cast<float>();
  }

  /// \param crossing one that was there before; receives one that is there now.
  bool is_clean(const Indices& affected, CrossingPair& crossing) const {
    for (const std::uint32_t t : affected) {
      if (normal(t).squaredNorm() == 0.0) return false;
    }
    return !find_crossing(connected_, affected, crossing);
  }

  const double cosine_of_fold_ = std::cos(kFold);  // negative
  TriangleMesh& mesh_;
  ConnectedTriangles connected_;
  BirthRecords births_;
  UntanglingReport report_;
};

}  // namespace

UntanglingReport untangle(TriangleMesh& mesh, UpkeepMemory& memory) {
  update_twins(mesh, memory.twins);
  return Untangling(mesh, memory.twins.of_half_edges).run();
}

}  // namespace particle_surface_tracker
