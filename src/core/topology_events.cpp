#include "particle_surface_tracker/core/topology_events.h"

#include <algorithm>
#include <limits>
#include <set>
#include <unordered_map>

namespace particle_surface_tracker {
namespace {

/// A mesh with the components of its vertices.
struct Pieces {
  explicit Pieces(const IdentifiedMesh& whole)
      : mesh(whole), count(whole.components.count), of_vertex(whole.components.of_vertex) {
    sizes.resize(count);
    middles.resize(count, Vec3d::Zero());
    for (std::size_t v = 0; v < of_vertex.size(); ++v) {
      ++sizes[of_vertex[v]];
      middles[of_vertex[v]] += position(v).cast<double>();
    }
    for (std::size_t c = 0; c < count; ++c) middles[c] /= static_cast<double>(sizes[c]);
  }

  const Vec3f& position(std::size_t v) const { return mesh.positions[v]; }

  /// The vertex nearest to a place, among some.
  template <typename Wanted>
  std::size_t nearest(const Vec3f& place, Wanted&& wanted) const {
    std::size_t best = of_vertex.size();
    float distance = std::numeric_limits<float>::max();
    for (std::size_t v = 0; v < of_vertex.size(); ++v) {
      if (!wanted(v)) continue;
      const float squared = (position(v) - place).squaredNorm();
      if (squared >= distance) continue;
      distance = squared;
      best = v;
    }
    return best;
  }

  IdentifiedMesh mesh;
  std::size_t count;
  const std::vector<std::uint32_t>& of_vertex;
  std::vector<std::size_t> sizes;
  std::vector<Vec3d> middles;
};

/// Which components of two meshes have vertices in common: for every one of the first, those of the second.
using Links = std::vector<std::set<std::uint32_t>>;

/// Finds vertices by their ids.
std::unordered_map<std::uint32_t, std::size_t> places_of(const std::vector<std::uint32_t>& ids) {
  std::unordered_map<std::uint32_t, std::size_t> places;
  places.reserve(ids.size());
  for (std::size_t v = 0; v < ids.size(); ++v) places.emplace(ids[v], v);
  return places;
}

class Comparison {
 public:
  Comparison(const IdentifiedMesh& before, const IdentifiedMesh& after)
      : before_(before), after_(after), forward_(before_.count), backward_(after_.count) {
    const auto places = places_of(before.ids);
    is_new_.resize(after.ids.size());
    for (std::size_t v = 0; v < after.ids.size(); ++v) {
      const auto found = places.find(after.ids[v]);
      is_new_[v] = found == places.end();
      if (!is_new_[v]) link(before_.of_vertex[found->second], after_.of_vertex[v]);
    }
  }

  std::vector<TopologyEvent> events(double reach) {
    adopt_new_pieces();
    bury_lost_pieces(reach);
    for (const auto& pieces : forward_) add_all_but_largest(TopologyEvent::Kind::kSplit, pieces, after_);
    for (const auto& pieces : backward_) add_all_but_largest(TopologyEvent::Kind::kMerge, pieces, before_);
    return std::move(events_);
  }

 private:
  void link(std::uint32_t earlier, std::uint32_t later) {
    forward_[earlier].insert(later);
    backward_[later].insert(earlier);
  }

  void adopt_new_pieces() {
    if (before_.count == 0) return;
    for (std::uint32_t c = 0; c < after_.count; ++c) {
      if (!backward_[c].empty()) continue;
      const std::size_t parent = before_.nearest(after_.middles[c].cast<float>(), [](std::size_t) { return true; });
      link(before_.of_vertex[parent], c);
    }
  }

  void bury_lost_pieces(double reach) {
    for (std::uint32_t c = 0; c < before_.count; ++c) {
      if (!forward_[c].empty()) continue;
      const Vec3f place = before_.middles[c].cast<float>();
      const std::size_t heir = after_.nearest(place, [](std::size_t) { return true; });
      const bool has_joined = heir != after_.of_vertex.size() && (after_.position(heir) - place).norm() < reach;
      if (has_joined) {
        link(c, after_.of_vertex[heir]);
      } else {
        events_.push_back({TopologyEvent::Kind::kGone, place});
      }
    }
  }

  void add_all_but_largest(TopologyEvent::Kind kind, const std::set<std::uint32_t>& pieces, const Pieces& of) {
    if (pieces.size() < 2) return;
    const std::uint32_t largest =
        *std::max_element(pieces.begin(), pieces.end(), [&](auto a, auto b) { return of.sizes[a] < of.sizes[b]; });
    for (const std::uint32_t piece : pieces) {
      if (piece == largest) continue;
      // Cut and seam are where vertices are new; of all these, the nearest to the piece.
      const Vec3f middle = of.middles[piece].cast<float>();
      const std::size_t fresh = after_.nearest(middle, [this](std::size_t v) { return is_new_[v]; });
      events_.push_back({kind, fresh == is_new_.size() ? middle : after_.position(fresh)});
    }
  }

  Pieces before_;
  Pieces after_;
  Links forward_;
  Links backward_;
  std::vector<bool> is_new_;
  std::vector<TopologyEvent> events_;
};

}  // namespace

std::vector<TopologyEvent> find_topology_events(const IdentifiedMesh& before, const IdentifiedMesh& after,
                                                double reach) {
  return Comparison(before, after).events(reach);
}

}  // namespace particle_surface_tracker
