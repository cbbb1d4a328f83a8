#include "piece_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace particle_surface_tracker::remeshing {

namespace {

using Eigen::Vector2d;
using Pair = std::pair<std::uint32_t, std::uint32_t>;

/// Larger polygons lose ears until they have that many vertices: the best triangulation takes the cube of it.
constexpr std::size_t kMostVertices = 48;
constexpr double kImpossible = std::numeric_limits<double>::infinity();

Pair sorted_pair(std::uint32_t a, std::uint32_t b) {
  return a < b ? Pair{a, b} : Pair{b, a};
}

double doubled_area(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// 0 for an equilateral triangle, towards 1 for a thin one, far more for one that is turned over.
double badness(const Vector2d& a, const Vector2d& b, const Vector2d& c) {
  const double area = doubled_area(a, b, c);
  const double lengths = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  if (lengths <= 0.0) return 1.0;
  const double quality = 2.0 * std::sqrt(3.0) * area / lengths;
  constexpr double kRounding = 1.0e-9;
  constexpr double kTurnedOver = 1000.0;
  return quality >= -kRounding ? 1.0 - quality : 10.0 - kTurnedOver * quality;
}

class PieceTriangulator {
 public:
  PieceTriangulator(const FlatPiece& piece, std::vector<std::array<std::uint32_t, 3>>& triangles)
      : piece_(piece), places_(*piece.places), triangles_(triangles) {
    for (const auto& loop : piece.loops) {
      for (std::size_t n = 0; n < loop.size(); ++n) {
        border_.push_back({loop[n], loop[(n + 1) % loop.size()]});
        border_pairs_.push_back(sorted_pair(border_.back().first, border_.back().second));
      }
    }
    std::sort(border_pairs_.begin(), border_pairs_.end());
  }

  bool run() {
    polygon_ = piece_.loops.front();
    std::vector<std::vector<std::uint32_t>> others(piece_.loops.begin() + 1, piece_.loops.end());
    while (!others.empty()) {
      if (!bridge_to_next(others)) return false;
    }
    while (polygon_.size() > kMostVertices) {
      if (!cut_best_ear()) return false;
    }
    const std::size_t first = triangles_.size();
    constexpr int kAttempts = 8;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
      if (!triangulate_polygon()) return false;
      if (forbid_doubled_sides(first)) return true;
      triangles_.resize(first);
    }
    return false;
  }

 private:
  bool may_join(std::uint32_t a, std::uint32_t b) const {
    if (a == b || ((*piece_.edges)[a] & (*piece_.edges)[b]) != 0) return false;
    const Pair pair = sorted_pair(a, b);
    return !std::binary_search(border_pairs_.begin(), border_pairs_.end(), pair) &&
           !std::binary_search(piece_.apart->begin(), piece_.apart->end(), pair);
  }

  bool crosses_border(std::uint32_t a, std::uint32_t b) const {
    const Vector2d& p = places_[a];
    const Vector2d& q = places_[b];
    return std::any_of(border_.begin(), border_.end(), [&](const Pair& edge) {
      const auto [c, d] = edge;
      if (c == a || c == b || d == a || d == b) return false;
      const Vector2d& r = places_[c];
      const Vector2d& s = places_[d];
      return doubled_area(p, q, r) * doubled_area(p, q, s) < 0.0 && doubled_area(r, s, p) * doubled_area(r, s, q) < 0.0;
    });
  }

  /// Joins the polygon and the loop that is nearest to it by a bridge that is walked both ways.
  bool bridge_to_next(std::vector<std::vector<std::uint32_t>>& others) {
    struct Bridge {
      double length;
      std::size_t at, loop, to;
    };
    std::vector<Bridge> bridges;
    for (std::size_t at = 0; at < polygon_.size(); ++at) {
      for (std::size_t loop = 0; loop < others.size(); ++loop) {
        for (std::size_t to = 0; to < others[loop].size(); ++to) {
          if (!may_join(polygon_[at], others[loop][to])) continue;
          bridges.push_back({(places_[polygon_[at]] - places_[others[loop][to]]).squaredNorm(), at, loop, to});
        }
      }
    }
    std::stable_sort(bridges.begin(), bridges.end(),
                     [](const Bridge& a, const Bridge& b) { return a.length < b.length; });
    if (bridges.empty()) return false;
    auto good = std::find_if(bridges.begin(), bridges.end(), [&](const Bridge& bridge) {
      return !crosses_border(polygon_[bridge.at], others[bridge.loop][bridge.to]);
    });
    // Where places coincide, every bridge may seem to cross something.
    if (good == bridges.end()) good = bridges.begin();
    std::vector<std::uint32_t>& loop = others[good->loop];
    const std::uint32_t from = polygon_[good->at];
    const std::uint32_t to = loop[good->to];
    std::rotate(loop.begin(), loop.begin() + static_cast<std::ptrdiff_t>(good->to), loop.end());
    loop.push_back(to);
    loop.push_back(from);
    polygon_.insert(polygon_.begin() + static_cast<std::ptrdiff_t>(good->at) + 1, loop.begin(), loop.end());
    others.erase(others.begin() + static_cast<std::ptrdiff_t>(good->loop));
    add_border_pair(from, to);
    border_.push_back({from, to});
    return true;
  }

  void add_border_pair(std::uint32_t a, std::uint32_t b) {
    const Pair pair = sorted_pair(a, b);
    border_pairs_.insert(std::lower_bound(border_pairs_.begin(), border_pairs_.end(), pair), pair);
  }

  /// Cuts off the best triangle of three vertices in a row that holds no other vertex.
  bool cut_best_ear() {
    const std::size_t n = polygon_.size();
    double best = kImpossible;
    std::size_t best_ear = n;
    for (std::size_t ear = 0; ear < n; ++ear) {
      const std::uint32_t a = polygon_[(ear + n - 1) % n];
      const std::uint32_t b = polygon_[ear];
      const std::uint32_t c = polygon_[(ear + 1) % n];
      if (!may_join(a, c)) continue;
      const double cost = badness(places_[a], places_[b], places_[c]) + (holds_vertex(a, b, c) ? 1.0e6 : 0.0);
      if (cost >= best) continue;
      best = cost;
      best_ear = ear;
    }
    if (best_ear == n) return false;
    const std::uint32_t a = polygon_[(best_ear + n - 1) % n];
    const std::uint32_t c = polygon_[(best_ear + 1) % n];
    triangles_.push_back({a, polygon_[best_ear], c});
    add_border_pair(a, c);
    polygon_.erase(polygon_.begin() + static_cast<std::ptrdiff_t>(best_ear));
    return true;
  }

  bool holds_vertex(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return std::any_of(polygon_.begin(), polygon_.end(), [&](std::uint32_t v) {
      if (v == a || v == b || v == c) return false;
      const Vector2d& p = places_[v];
      return doubled_area(places_[a], places_[b], p) >= 0.0 && doubled_area(places_[b], places_[c], p) >= 0.0 &&
             doubled_area(places_[c], places_[a], p) >= 0.0;
    });
  }

  /// The triangulation of least badness, by dynamic programming over the parts first .. last of the polygon.
  bool triangulate_polygon() {
    const std::size_t n = polygon_.size();
    std::vector<double> least(n * n, kImpossible);
    std::vector<std::uint32_t> middle_of(n * n, 0);
    for (std::size_t a = 0; a + 1 < n; ++a) least[a * n + a + 1] = 0.0;
    for (std::size_t span = 2; span < n; ++span) {
      for (std::size_t first = 0; first + span < n; ++first) {
        const std::size_t last = first + span;
        if (span + 1 < n && !may_join(polygon_[first], polygon_[last])) continue;
        for (std::size_t middle = first + 1; middle < last; ++middle) {
          const double parts = least[first * n + middle] + least[middle * n + last];
          if (parts >= least[first * n + last]) continue;
          const double cost =
              parts + badness(places_[polygon_[first]], places_[polygon_[middle]], places_[polygon_[last]]);
          if (cost >= least[first * n + last]) continue;
          least[first * n + last] = cost;
          middle_of[first * n + last] = static_cast<std::uint32_t>(middle);
        }
      }
    }
    if (least[n - 1] == kImpossible) return false;
    std::vector<std::pair<std::size_t, std::size_t>> parts{{0, n - 1}};
    while (!parts.empty()) {
      const auto [first, last] = parts.back();
      parts.pop_back();
      if (last - first < 2) continue;
      const std::size_t middle = middle_of[first * n + last];
      triangles_.push_back({polygon_[first], polygon_[middle], polygon_[last]});
      parts.emplace_back(first, middle);
      parts.emplace_back(middle, last);
    }
    return true;
  }

  /// A vertex that occurs twice in the polygon can be joined to another one twice. Such sides are forbidden from now
  /// on.
  /// \return true if there are none.
  bool forbid_doubled_sides(std::size_t first) {
    std::vector<Pair> sides;
    for (std::size_t t = first; t < triangles_.size(); ++t) {
      for (int k = 0; k < 3; ++k) sides.emplace_back(triangles_[t][k], triangles_[t][(k + 1) % 3]);
    }
    std::sort(sides.begin(), sides.end());
    bool none = true;
    for (std::size_t n = 1; n < sides.size(); ++n) {
      if (sides[n] != sides[n - 1]) continue;
      add_border_pair(sides[n].first, sides[n].second);
      none = false;
    }
    return none;
  }

  const FlatPiece& piece_;
  const std::vector<Vector2d>& places_;
  std::vector<std::array<std::uint32_t, 3>>& triangles_;
  std::vector<Pair> border_;
  std::vector<Pair> border_pairs_;  // including bridges and the sides of ears; sorted
  std::vector<std::uint32_t> polygon_;
};

}  // namespace

bool triangulate_piece(const FlatPiece& piece, std::vector<std::array<std::uint32_t, 3>>& triangles) {
  return PieceTriangulator(piece, triangles).run();
}

}  // namespace particle_surface_tracker::remeshing
