#include "particle_surface_tracker/core/mesh_refinement.h"

#include <algorithm>
#include <cmath>
#include <queue>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {
namespace {

constexpr std::uint32_t kNone = 0xffffffffU;

/// Half-edge 3 t + k runs from corner k of triangle t to the next one.
std::uint32_t next_in_triangle(std::uint32_t half_edge) {
  return half_edge % 3 == 2 ? half_edge - 2 : half_edge + 1;
}

struct QueuedEdge {
  double squared_length;
  std::uint32_t low, high;  ///< Vertices of the edge when it was queued.
  std::uint32_t half_edge;

  /// Whether the other comes first: the longer edge, then that of the lower vertices.
  bool operator<(const QueuedEdge& other) const {
    if (squared_length != other.squared_length) return squared_length < other.squared_length;
    return std::make_pair(low, high) > std::make_pair(other.low, other.high);
  }
};

class EdgeSplitter {
 public:
  EdgeSplitter(TriangleMesh& mesh, double max_edge_length)
      : mesh_(mesh), triangles_(mesh.triangles()), max_squared_length_(max_edge_length * max_edge_length) {}

  void run() {
    pair_half_edges();
    for (std::uint32_t h = 0; h < twins_.size(); ++h) {
      if (twins_[h] == kNone || h < twins_[h]) enqueue(h);
    }
    while (!queue_.empty()) {
      const QueuedEdge edge = queue_.top();
      queue_.pop();
      const auto [low, high] = std::minmax({start(edge.half_edge), end(edge.half_edge)});
      if (low == edge.low && high == edge.high) split(edge.half_edge);
    }
    mesh_.set_triangles(std::move(triangles_));
  }

 private:
  std::uint32_t start(std::uint32_t half_edge) const { return triangles_[half_edge / 3][half_edge % 3]; }
  std::uint32_t end(std::uint32_t half_edge) const { return start(next_in_triangle(half_edge)); }

  void pair_half_edges() {
    const auto count = static_cast<std::uint32_t>(3 * triangles_.size());
    std::vector<std::array<std::uint32_t, 3>> edges(count);
    for (std::uint32_t h = 0; h < count; ++h) {
      const auto [low, high] = std::minmax({start(h), end(h)});
      edges[h] = {low, high, h};
    }
    std::sort(edges.begin(), edges.end());
    twins_.assign(count, kNone);
    for (std::uint32_t i = 1; i < count; ++i) {
      if (edges[i][0] != edges[i - 1][0] || edges[i][1] != edges[i - 1][1]) continue;
      twins_[edges[i][2]] = edges[i - 1][2];
      twins_[edges[i - 1][2]] = edges[i][2];
    }
  }

  void enqueue(std::uint32_t half_edge) {
    const auto [low, high] = std::minmax({start(half_edge), end(half_edge)});
    const auto& positions = mesh_.positions();
    const double squared_length = (positions[low].cast<double>() - positions[high].cast<double>()).squaredNorm();
    if (squared_length > max_squared_length_) queue_.push({squared_length, low, high, half_edge});
  }

  void pair(std::uint32_t a, std::uint32_t b) {
    twins_[a] = b;
    if (b != kNone) twins_[b] = a;
  }

  void split(std::uint32_t half_edge) {
    const std::uint32_t a = start(half_edge), b = end(half_edge);
    const Vec3f& position_a = mesh_.positions()[a];
    const Vec3f& position_b = mesh_.positions()[b];
    const Vec3f middle = (0.5 * (position_a.cast<double>() + position_b.cast<double>())).cast<float>();
    // The ends are neighbouring floats: there is nothing between them.
    if (middle == position_a || middle == position_b) return;
    if (mesh_.vertex_count() >= kLargestVertexCount) {
      throw ParameterError(
          fmt::format("Edges of {:g} m at most would take more than {} vertices; give a larger max_edge_length.",
                      std::sqrt(max_squared_length_), kLargestVertexCount));
    }
    const std::uint32_t vertex = mesh_.append_vertex(middle, {{a, 0.5}, {b, 0.5}});

    const std::uint32_t twin = twins_[half_edge];
    const std::uint32_t second_half = split_triangle(half_edge, vertex);
    if (twin != kNone) {
      const std::uint32_t second_half_of_twin = split_triangle(twin, vertex);
      pair(half_edge, second_half_of_twin);
      pair(second_half, twin);
    } else {
      pair(half_edge, kNone);
    }
    enqueue(half_edge);
    enqueue(second_half);
  }

  /// Splits triangle (a, b, c), where the half-edge runs from a to b: it becomes (a, m, c), a new one is (m, b, c).
  /// \return the half-edge from m to b.
  std::uint32_t split_triangle(std::uint32_t half_edge, std::uint32_t middle) {
    const std::uint32_t to_apex = next_in_triangle(half_edge);
    const std::uint32_t b = start(to_apex), apex = end(to_apex);
    const auto second_half = static_cast<std::uint32_t>(3 * triangles_.size());
    const std::uint32_t moved = twins_[to_apex];
    triangles_.push_back({middle, b, apex});
    twins_.resize(twins_.size() + 3, kNone);
    triangles_[to_apex / 3][to_apex % 3] = middle;
    pair(second_half + 1, moved);
    pair(second_half + 2, to_apex);
    enqueue(to_apex);
    // The edge from b to the apex may be waiting under the half-edge that it has just left.
    enqueue(second_half + 1);
    return second_half;
  }

  /// A length that asks for more is a mistake in the units.
  static constexpr std::size_t kLargestVertexCount = 50'000'000;

  TriangleMesh& mesh_;
  std::vector<Triangle> triangles_;
  std::vector<std::uint32_t> twins_;
  std::priority_queue<QueuedEdge> queue_;
  double max_squared_length_;
};

}  // namespace

void split_long_edges(TriangleMesh& mesh, double max_edge_length) {
  if (!(max_edge_length > 0.0) || !std::isfinite(max_edge_length)) {
    throw ParameterError(
        fmt::format("max_edge_length is {:g} m; it must be a positive, finite length.", max_edge_length));
  }
  EdgeSplitter(mesh, max_edge_length).run();
}

}  // namespace particle_surface_tracker
