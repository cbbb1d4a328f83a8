#include "patched_connectivity.h"

#include <algorithm>

#include "patch.h"
#include "stages/upkeep/half_edges.h"

namespace particle_surface_tracker::remeshing {

namespace {

constexpr std::uint32_t kRemoved = 0xffffffffU;
constexpr std::uint32_t kFewestAround = 3;

/// Half-edges without a twin, those of each vertex in the order of where they end.
class OpenHalfEdges {
 public:
  struct Entry {
    std::uint32_t end;
    std::uint32_t half_edge;
    bool operator<(const Entry& other) const { return end < other.end; }
  };

  OpenHalfEdges(std::size_t vertex_count, const std::vector<Triangle>& triangles,
                const std::vector<std::uint32_t>& open)
      : begin_(vertex_count + 2, 0), entries_(open.size()) {
    for (const std::uint32_t h : open) ++begin_[start_of(triangles, h) + 2];
    for (std::size_t v = 2; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    for (const std::uint32_t h : open) entries_[begin_[start_of(triangles, h) + 1]++] = {end_of(triangles, h), h};
    begin_.pop_back();
    for (std::uint32_t v = 0; v < vertex_count; ++v) {
      if (begin_[v + 1] - begin_[v] > 1) std::sort(entries_.begin() + begin_[v], entries_.begin() + begin_[v + 1]);
    }
  }

  /// One of them from a vertex, or kNoHalfEdge.
  std::uint32_t any_from(std::uint32_t from) const {
    return begin_[from] == begin_[from + 1] ? kNoHalfEdge : entries_[begin_[from]].half_edge;
  }

  /// The only one from a vertex to another, or kNoHalfEdge if there is none or more than one.
  std::uint32_t find(std::uint32_t from, std::uint32_t to) const {
    const auto end = entries_.begin() + begin_[from + 1];
    const auto found = std::lower_bound(entries_.begin() + begin_[from], end, Entry{to, 0});
    if (found == end || found->end != to) return kNoHalfEdge;
    return found + 1 != end && found[1].end == to ? kNoHalfEdge : found->half_edge;
  }

 private:
  std::vector<std::uint32_t> begin_;
  std::vector<Entry> entries_;
};

class PatchedMesh {
 public:
  PatchedMesh(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& twins, const Patch& patch)
      : vertex_count_(patch.first_vertex() + patch.vertices.size()) {
    keep(triangles, twins, patch.removed);
    for (const Triangle& triangle : patch.triangles) {
      const auto h = static_cast<std::uint32_t>(3 * result_.triangles.size());
      open_.insert(open_.end(), {h, h + 1, h + 2});
      result_.triangles.push_back(triangle);
    }
    result_.twins.resize(3 * result_.triangles.size(), kNoHalfEdge);
    first_new_ = result_.triangles.size() - patch.triangles.size();
  }

  bool close() {
    if (!std::all_of(result_.triangles.begin() + static_cast<std::ptrdiff_t>(first_new_), result_.triangles.end(),
                     [&](const Triangle& t) { return is_proper(t); })) {
      return false;
    }
    const OpenHalfEdges open(vertex_count_, result_.triangles, open_);
    return pair(open) && has_single_umbrellas(open);
  }

  PatchedConnectivity take() { return std::move(result_); }

 private:
  void keep(const std::vector<Triangle>& triangles, const std::vector<std::uint32_t>& twins,
            const std::vector<std::uint32_t>& removed) {
    std::vector<std::uint32_t> number(triangles.size());
    std::uint32_t next = 0;
    auto gone = removed.begin();
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const bool is_gone = gone != removed.end() && *gone == t;
      if (is_gone) ++gone;
      number[t] = is_gone ? kRemoved : next++;
    }
    result_.triangles.reserve(next);
    result_.twins.reserve(3 * std::size_t{next});
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (number[t] == kRemoved) continue;
      result_.triangles.push_back(triangles[t]);
      for (std::uint32_t h = 3 * t; h < 3 * t + 3; ++h) {
        const std::uint32_t beyond = twins[h] == kNoHalfEdge ? kRemoved : number[twins[h] / 3];
        if (beyond == kRemoved) open_.push_back(static_cast<std::uint32_t>(result_.twins.size()));
        result_.twins.push_back(beyond == kRemoved ? kNoHalfEdge : 3 * beyond + twins[h] % 3);
      }
    }
  }

  bool is_proper(const Triangle& t) const {
    return std::max({t[0], t[1], t[2]}) < vertex_count_ && t[0] != t[1] && t[1] != t[2] && t[2] != t[0];
  }

  /// \return whether each of them has exactly one twin.
  bool pair(const OpenHalfEdges& open) {
    return std::all_of(open_.begin(), open_.end(), [&](std::uint32_t h) {
      const std::uint32_t from = start_of(result_.triangles, h), to = end_of(result_.triangles, h);
      const std::uint32_t twin = open.find(to, from);
      result_.twins[h] = twin;
      return twin != kNoHalfEdge && open.find(from, to) == h;
    });
  }

  /// Whether one turn around each vertex where the mesh was open meets all of its triangles, and no neighbour twice:
  /// an edge between two such vertices could have been there before.
  bool has_single_umbrellas(const OpenHalfEdges& open) const {
    std::vector<std::uint32_t> around(vertex_count_, 0);
    for (const Triangle& triangle : result_.triangles) {
      for (const std::uint32_t v : triangle) ++around[v];
    }
    std::vector<std::uint32_t> last_met_around(vertex_count_, kRemoved);
    for (std::uint32_t v = 0; v < vertex_count_; ++v) {
      const std::uint32_t first = open.any_from(v);
      if (first == kNoHalfEdge) continue;
      std::uint32_t size = 0;
      std::uint32_t h = first;
      do {
        std::uint32_t& met = last_met_around[end_of(result_.triangles, h)];
        if (met == v) return false;
        met = v;
        h = result_.twins[previous_half_edge(h)];
        ++size;
      } while (h != first);
      if (size != around[v] || size < kFewestAround) return false;
    }
    return true;
  }

  std::size_t vertex_count_;
  std::size_t first_new_ = 0;
  PatchedConnectivity result_;
  std::vector<std::uint32_t> open_;  // half-edges
};

}  // namespace

std::optional<PatchedConnectivity> patched_connectivity(const std::vector<Triangle>& triangles,
                                                        const std::vector<std::uint32_t>& twins, const Patch& patch) {
  PatchedMesh patched(triangles, twins, patch);
  if (!patched.close()) return std::nullopt;
  return patched.take();
}

}  // namespace particle_surface_tracker::remeshing
