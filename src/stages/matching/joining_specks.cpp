#include "joining_specks.h"

#include <map>

#include "core/disjoint_sets.h"

namespace particle_surface_tracker {

namespace {

using Labels = std::vector<std::int32_t>;
using Speck = std::pair<std::uint32_t, std::int32_t>;  // piece of the mesh, label

/// Where specks of a mesh meet each other, and bodies.
class SpeckContacts {
 public:
  SpeckContacts(const std::vector<Triangle>& triangles, const VertexComponents& pieces,
                const ComponentLabels& components, const Labels& labels)
      : pieces_(pieces), components_(components), labels_(labels) {
    for (const Triangle& t : triangles) {
      for (std::size_t k = 0; k < 3; ++k) look_at_edge(t[k], t[(k + 1) % 3]);
    }
  }

  /// Those that hang together with two bodies or more.
  std::set<Speck> joining() const {
    DisjointSets clusters(numbers_.size());
    for (const auto& [a, b] : meetings_) clusters.join(a, b);
    std::map<std::uint32_t, std::set<std::int32_t>> bodies;
    for (const auto& [speck, body] : contacts_) bodies[clusters.find(speck)].insert(body);
    std::set<Speck> found;
    for (const auto& [speck, number] : numbers_) {
      const auto at = bodies.find(clusters.find(number));
      if (at != bodies.end() && at->second.size() > 1) found.insert(speck);
    }
    return found;
  }

 private:
  void look_at_edge(std::uint32_t a, std::uint32_t b) {
    if (labels_[a] == labels_[b] || labels_[a] == ComponentLabels::kFar || labels_[b] == ComponentLabels::kFar) return;
    const bool first = components_.is_speck(labels_[a]), second = components_.is_speck(labels_[b]);
    if (first && second) meetings_.insert({number_of(a), number_of(b)});
    if (first && !second) contacts_.insert({number_of(a), labels_[b]});
    if (second && !first) contacts_.insert({number_of(b), labels_[a]});
  }

  /// The number of the speck that a vertex belongs to.
  std::uint32_t number_of(std::uint32_t vertex) {
    const auto next = static_cast<std::uint32_t>(numbers_.size());
    return numbers_.try_emplace({pieces_.of_vertex[vertex], labels_[vertex]}, next).first->second;
  }

  const VertexComponents& pieces_;
  const ComponentLabels& components_;
  const Labels& labels_;
  std::map<Speck, std::uint32_t> numbers_;
  std::set<std::pair<std::uint32_t, std::uint32_t>> meetings_;
  std::set<std::pair<std::uint32_t, std::int32_t>> contacts_;
};

}  // namespace

JoiningSpecks::JoiningSpecks(const std::vector<Triangle>& triangles, const VertexComponents& pieces,
                             const ComponentLabels& components, const Labels& labels)
    : joining_(SpeckContacts(triangles, pieces, components, labels).joining()) {}

}  // namespace particle_surface_tracker
