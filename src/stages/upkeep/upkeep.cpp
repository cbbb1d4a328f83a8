#include "particle_surface_tracker/stages/upkeep.h"

#include <algorithm>
#include <utility>

#include <tbb/parallel_for.h>

#include "birth_record.h"
#include "candidate_queue.h"
#include "candidates.h"
#include "editable_surface.h"
#include "half_edges.h"
#include "operations.h"
#include "tolerances.h"

namespace particle_surface_tracker {

namespace {

/// Triangles that are looked at by one task.
constexpr std::uint32_t kTrianglesPerBlock = 2048;

/// Side of the tiles in which candidates are dealt with one after the other [cells of Γ]. Smaller ones are no faster,
/// and collapses across their rims cost volume.
constexpr double kTile = 16.0;

std::uint32_t block_count(const TriangleMesh& mesh) {
  return static_cast<std::uint32_t>((mesh.triangle_count() + kTrianglesPerBlock - 1) / kTrianglesPerBlock);
}

/// Calls visit(block, first triangle, one past the last) in parallel.
template <typename Visit>
void for_each_block(const TriangleMesh& mesh, Visit&& visit) {
  const auto triangles = static_cast<std::uint32_t>(mesh.triangle_count());
  tbb::parallel_for(std::uint32_t{0}, block_count(mesh), [&](std::uint32_t block) {
    const std::uint32_t first = block * kTrianglesPerBlock;
    visit(block, first, std::min(first + kTrianglesPerBlock, triangles));
  });
}

/// Finds the triangles in which something calls for an operation.
/// \return whether there are any.
bool find_suspects(const TriangleMesh& mesh, const Tolerances& tolerances, UpkeepMemory& memory) {
  memory.suspects.resize(std::max<std::size_t>(memory.suspects.size(), block_count(mesh)));
  for (auto& block : memory.suspects) block.clear();
  const SurfaceView surface{mesh.positions(), mesh.triangles(), memory.twins.of_half_edges};
  for_each_block(mesh, [&](std::uint32_t block, std::uint32_t first, std::uint32_t last) {
    std::vector<std::uint32_t>& suspects = memory.suspects[block];
    const auto is_asked = [&](std::uint32_t h) { return surface.is_name_of_edge(h); };
    for (std::uint32_t t = first; t < last; ++t) {
      for_each_ailment(surface, t, tolerances, is_asked, [&](Ailment, double, std::uint32_t) {
        if (suspects.empty() || suspects.back() != t) suspects.push_back(t);
      });
    }
  });
  return std::any_of(memory.suspects.begin(), memory.suspects.end(), [](const auto& block) { return !block.empty(); });
}

/// Works through what calls for an operation, and through what that leads to.
class Upkeep {
 public:
  Upkeep(TriangleMesh& mesh, const BirthRecords& births, const Tolerances& tolerances, const Parameters& parameters,
         UpkeepMemory& memory)
      : twins_(memory.twins),
        surface_(mesh, memory.twins.of_half_edges),
        tolerances_(tolerances),
        operations_(surface_, births, tolerances, parameters.dx_gamma * parameters.particle_spacing),
        suspects_(memory.suspects),
        queue_(kTile * parameters.dx_gamma * parameters.particle_spacing),
        changed_at_(mesh.vertex_count(), 0),
        attempts_left_(kAttemptsPerTriangle * mesh.triangle_count() + kLeastAttempts) {}

  UpkeepReport run() {
    // Until the mesh has the triangles that they belong to.
    twins_.connectivity = 0;
    for (const auto& block : suspects_) {
      for (const std::uint32_t t : block) {
        enqueue_triangle(t, [&](std::uint32_t h) { return view().is_name_of_edge(h); });
      }
    }
    work_through_queue();
    for (int pass = 1; pass < kMaxPasses && enqueue_what_may_have_become_possible(); ++pass) work_through_queue();
    report_.refused = refused_.size();
    if (done_ > 0) report_.fresh = surface_.finish();
    twins_.connectivity = surface_.mesh().connectivity();
    return std::move(report_);
  }

 private:
  // Bounds that no mesh comes near; they make the end certain.
  static constexpr int kMaxPasses = 10;
  static constexpr std::size_t kAttemptsPerTriangle = 20;
  static constexpr std::size_t kLeastAttempts = 100000;

  /// A candidate that no operation could mend.
  struct Refusal {
    Candidate candidate;
    std::size_t done;  ///< Operations done before it.
    bool would_cross;  ///< Whether something else was in the way, which may be far away along the surface.
  };

  SurfaceView view() const { return {surface_.mesh().positions(), surface_.triangles(), surface_.twins()}; }

  Candidate candidate(Ailment ailment, double urgency, std::uint32_t half_edge) const {
    const auto [low, high] = std::minmax({surface_.start(half_edge), surface_.end(half_edge)});
    if (ailment != Ailment::kSliver) half_edge = std::min(half_edge, surface_.twin(half_edge));
    return {ailment, urgency, low, high, half_edge};
  }

  void enqueue(const Candidate& candidate) { queue_.push(candidate, surface_.stored_position(candidate.low)); }

  template <typename IsAsked>
  void enqueue_triangle(std::uint32_t triangle, IsAsked&& is_asked) {
    for_each_ailment(view(), triangle, tolerances_, is_asked, [&](Ailment ailment, double urgency, std::uint32_t h) {
      if (ailment == Ailment::kLongEdge) {
        long_edges_.push_back(candidate(ailment, urgency, h));
      } else {
        enqueue(candidate(ailment, urgency, h));
      }
    });
  }

  void enqueue_around(std::uint32_t vertex) {
    surface_.for_each_outgoing(vertex, [&](std::uint32_t outgoing) {
      // The edge that leads back is that of the next one's outgoing half-edge.
      const std::uint32_t incoming = previous_half_edge(outgoing);
      enqueue_triangle(outgoing / 3, [&](std::uint32_t h) { return h != incoming; });
    });
  }

  /// Long edges are split in rounds, each as one step of subdivision: the new positions follow from the vertices
  /// before the round. Else the butterfly would look at halves of edges next to whole ones, which it is not made for.
  void begin_round_of_splits() {
    for (Candidate& edge : long_edges_) {
      if (!is_current(edge)) continue;
      edge.position = operations_.split_position(edge.half_edge);
      enqueue(edge);
    }
    long_edges_.clear();
  }

  /// Whether a candidate is still what it was when it was queued.
  bool is_current(const Candidate& queued) const {
    return surface_.is_alive(queued.half_edge / 3) && still_ails(view(), queued, tolerances_);
  }

  void work_through_queue() {
    while (attempts_left_ > 0) {
      if (!long_edges_.empty() && (queue_.empty() || queue_.next_ailment() != Ailment::kLongEdge)) {
        begin_round_of_splits();
      }
      if (queue_.empty()) return;
      const Candidate next = queue_.take();
      if (!is_current(next)) continue;
      --attempts_left_;
      const std::size_t crossings_before = operations_.crossings();
      if (mend(next)) {
        ++done_;
      } else {
        refused_.push_back({next, done_, operations_.crossings() > crossings_before});
      }
    }
  }

  /// What was refused may have become possible through what was done after it.
  /// \return whether there is anything to try again.
  bool enqueue_what_may_have_become_possible() {
    const std::size_t before = refused_.size();
    std::vector<Refusal> remaining;
    for (const Refusal& refusal : refused_) {
      const Candidate& candidate = refusal.candidate;
      if (!is_current(candidate)) continue;
      if (refusal.done < done_ && (refusal.would_cross || has_changed_since(refusal))) {
        if (candidate.ailment == Ailment::kLongEdge) {
          long_edges_.push_back(candidate);
        } else {
          enqueue(candidate);
        }
      } else {
        remaining.push_back(refusal);
      }
    }
    refused_ = std::move(remaining);
    return refused_.size() < before && !(queue_.empty() && long_edges_.empty());
  }

  /// Whether anything that the guards of a refused candidate look at has changed, but for other parts of the surface.
  bool has_changed_since(const Refusal& refusal) const {
    bool has_changed = false;
    const std::uint32_t h = refusal.candidate.half_edge;
    const auto ask = [&](std::uint32_t around) {
      has_changed = has_changed || changed_at_[surface_.end(around)] > refusal.done;
    };
    surface_.for_each_outgoing(surface_.start(h), ask);
    surface_.for_each_outgoing(surface_.end(h), ask);
    return has_changed;
  }

  /// Notes that the triangles around a vertex have changed through the operation that is being done.
  void note_change_around(std::uint32_t vertex) {
    changed_at_.resize(surface_.vertex_slots(), 0);
    changed_at_[vertex] = done_ + 1;
    surface_.for_each_outgoing(vertex, [&](std::uint32_t h) { changed_at_[surface_.end(h)] = done_ + 1; });
  }

  bool mend(const Candidate& candidate) {
    switch (candidate.ailment) {
      case Ailment::kLongEdge:
        return split(candidate);
      case Ailment::kShortEdge:
        return collapse(candidate.half_edge, report_.collapses);
      case Ailment::kFoldedEdge:
        return collapse(candidate.half_edge, report_.fold_collapses);
      case Ailment::kSliver:
        return mend_sliver(candidate.half_edge);
    }
    return false;
  }

  bool split(const Candidate& candidate) {
    const std::uint32_t vertex = operations_.split(candidate.half_edge, candidate.position);
    if (vertex == Operations::kNone) return false;
    ++report_.splits;
    note_change_around(vertex);
    enqueue_around(vertex);
    return true;
  }

  bool collapse(std::uint32_t half_edge, std::size_t& count) {
    const std::uint32_t vertex = operations_.collapse(half_edge);
    if (vertex == Operations::kNone) return false;
    ++count;
    note_change_around(vertex);
    enqueue_around(vertex);
    return true;
  }

  bool flip(std::uint32_t half_edge) {
    const std::uint32_t twin = surface_.twin(half_edge);
    if (!operations_.flip(half_edge)) return false;
    ++report_.flips;
    for (const std::uint32_t h : {half_edge, twin}) note_change_around(surface_.start(h));
    const auto all = [](std::uint32_t) { return true; };
    enqueue_triangle(half_edge / 3, all);
    enqueue_triangle(twin / 3, all);
    return true;
  }

  /// A flip takes the longest edge of a cap away, a collapse the shortest of a needle.
  bool mend_sliver(std::uint32_t shortest) {
    const std::uint32_t longest = view().longest_edge(shortest / 3);
    return flip(longest) || collapse(shortest, report_.sliver_collapses);
  }

  MeshTwins& twins_;
  EditableSurface surface_;
  const Tolerances& tolerances_;
  Operations operations_;
  const std::vector<std::vector<std::uint32_t>>& suspects_;
  CandidateQueue queue_;
  std::vector<Candidate> long_edges_;  // of the next round
  std::vector<Refusal> refused_;
  std::vector<std::size_t> changed_at_;  // per vertex: number of the last operation that changed a triangle around it
  std::size_t attempts_left_;
  std::size_t done_ = 0;
  UpkeepReport report_;
};

}  // namespace

UpkeepReport keep_up(TriangleMesh& mesh, const Parameters& parameters, UpkeepMemory& memory) {
  update_twins(mesh, memory.twins);
  BirthRecords births(mesh);
  if (!births.all_noted()) births.note_missing(memory.twins.of_half_edges);
  const Tolerances tolerances(births, parameters);
  if (!find_suspects(mesh, tolerances, memory)) return {};
  return Upkeep(mesh, births, tolerances, parameters, memory).run();
}

UpkeepReport keep_up(TriangleMesh& mesh, const Parameters& parameters) {
  UpkeepMemory memory;
  return keep_up(mesh, parameters, memory);
}

void note_birth(TriangleMesh& mesh) {
  BirthRecords births(mesh);
  if (births.all_noted()) return;
  std::vector<std::uint32_t> twins;
  pair_half_edges(mesh.vertex_count(), mesh.triangles(), twins);
  births.note_missing(twins);
}

void mark_as_remeshed(TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices) {
  BirthRecords births(mesh);
  for (const std::uint32_t vertex : vertices) births.begin_remeshed(vertex);
}

}  // namespace particle_surface_tracker
