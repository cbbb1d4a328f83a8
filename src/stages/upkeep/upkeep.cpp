#include "particle_surface_tracker/stages/upkeep.h"

#include <algorithm>
#include <atomic>
#include <queue>

#include <tbb/parallel_for.h>

#include "birth_record.h"
#include "candidates.h"
#include "editable_surface.h"
#include "half_edges.h"
#include "operations.h"
#include "tolerances.h"

namespace particle_surface_tracker {

namespace {

/// Triangles that are looked at by one task.
constexpr std::uint32_t kTrianglesPerBlock = 2048;

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

/// Makes the twins of the mesh's half-edges unless those in memory are that.
void update_twins(const TriangleMesh& mesh, std::vector<std::uint32_t>& twins) {
  std::atomic<bool> fit = twins.size() == 3 * mesh.triangle_count();
  if (fit) {
    for_each_block(mesh, [&](std::uint32_t, std::uint32_t first, std::uint32_t last) {
      for (std::uint32_t t = first; t < last && fit; ++t) {
        if (!twins_fit(mesh.triangles(), twins, t)) fit = false;
      }
    });
  }
  if (!fit) pair_half_edges(mesh.vertex_count(), mesh.triangles(), twins);
}

/// Marks the blocks of triangles in which something calls for an operation.
/// \return whether there are any.
bool find_suspects(const TriangleMesh& mesh, const Tolerances& tolerances, UpkeepMemory& memory) {
  memory.is_suspect.assign(block_count(mesh), 0);
  const SurfaceView surface{mesh.positions(), mesh.triangles(), memory.twins};
  for_each_block(mesh, [&](std::uint32_t block, std::uint32_t first, std::uint32_t last) {
    bool is_suspect = false;
    for (std::uint32_t t = first; t < last && !is_suspect; ++t) {
      for_each_ailment(surface, t, Sides::kLowerHalfEdge, tolerances,
                       [&](Ailment, double, std::uint32_t) { is_suspect = true; });
    }
    memory.is_suspect[block] = is_suspect ? 1 : 0;
  });
  return std::find(memory.is_suspect.begin(), memory.is_suspect.end(), 1) != memory.is_suspect.end();
}

/// Works through what calls for an operation, and through what that leads to.
class Upkeep {
 public:
  Upkeep(TriangleMesh& mesh, const BirthRecords& births, const Tolerances& tolerances, const Parameters& parameters,
         UpkeepMemory& memory)
      : surface_(mesh, memory.twins),
        tolerances_(tolerances),
        operations_(surface_, births, tolerances, parameters.dx_gamma * parameters.particle_spacing),
        is_suspect_(memory.is_suspect),
        attempts_left_(kAttemptsPerTriangle * mesh.triangle_count() + kLeastAttempts) {}

  UpkeepReport run() {
    enqueue_suspects();
    // What was refused may have become possible through what was done after it.
    for (int pass = 0; pass < kMaxPasses; ++pass) {
      const std::size_t done_before = done_;
      work_through_queue();
      if (done_ == done_before || refused_.empty()) break;
      if (pass + 1 == kMaxPasses) break;
      for (const Candidate& candidate : refused_) queue_.push(candidate);
      refused_.clear();
    }
    report_.refused = refused_.size();
    if (done_ > 0) report_.fresh = surface_.finish();
    return std::move(report_);
  }

 private:
  // Bounds that no mesh comes near; they make the end certain.
  static constexpr int kMaxPasses = 10;
  static constexpr std::size_t kAttemptsPerTriangle = 20;
  static constexpr std::size_t kLeastAttempts = 100000;

  SurfaceView view() const { return {surface_.mesh().positions(), surface_.triangles(), surface_.twins()}; }

  Candidate candidate(Ailment ailment, double urgency, std::uint32_t half_edge) const {
    const auto [low, high] = std::minmax({surface_.start(half_edge), surface_.end(half_edge)});
    return {ailment, urgency, low, high, half_edge};
  }

  void enqueue_suspects() {
    for (std::uint32_t t = 0; t < surface_.triangle_slots(); ++t) {
      if (is_suspect_[t / kTrianglesPerBlock] == 0) continue;
      enqueue_triangle(t, Sides::kLowerHalfEdge);
    }
  }

  void enqueue_triangle(std::uint32_t triangle, Sides sides) {
    for_each_ailment(view(), triangle, sides, tolerances_, [&](Ailment ailment, double urgency, std::uint32_t h) {
      queue_.push(candidate(ailment, urgency, h));
    });
  }

  void enqueue_around(std::uint32_t vertex) {
    surface_.for_each_outgoing(vertex, [&](std::uint32_t h) { enqueue_triangle(h / 3, Sides::kBoth); });
  }

  /// Whether a candidate is still what it was when it was queued.
  bool is_current(const Candidate& queued) const {
    if (!surface_.is_alive(queued.half_edge / 3)) return false;
    bool found = false;
    for_each_ailment(view(), queued.half_edge / 3, Sides::kBoth, tolerances_,
                     [&](Ailment ailment, double urgency, std::uint32_t h) {
                       const Candidate now = candidate(ailment, urgency, h);
                       found = found || (!(now < queued) && !(queued < now));
                     });
    return found;
  }

  void work_through_queue() {
    while (!queue_.empty() && attempts_left_ > 0) {
      const Candidate next = queue_.top();
      queue_.pop();
      if (!is_current(next)) continue;
      --attempts_left_;
      if (mend(next)) {
        ++done_;
      } else {
        refused_.push_back(next);
      }
    }
  }

  bool mend(const Candidate& candidate) {
    switch (candidate.ailment) {
      case Ailment::kLongEdge:
        return split(candidate.half_edge);
      case Ailment::kShortEdge:
        return collapse(candidate.half_edge, report_.collapses);
      case Ailment::kFoldedEdge:
        return collapse(candidate.half_edge, report_.fold_collapses);
      case Ailment::kSliver:
        return mend_sliver(candidate.half_edge);
    }
    return false;
  }

  bool split(std::uint32_t half_edge) {
    const std::uint32_t vertex = operations_.split(half_edge);
    if (vertex == Operations::kNone) return false;
    ++report_.splits;
    enqueue_around(vertex);
    return true;
  }

  bool collapse(std::uint32_t half_edge, std::size_t& count) {
    const std::uint32_t vertex = operations_.collapse(half_edge);
    if (vertex == Operations::kNone) return false;
    ++count;
    enqueue_around(vertex);
    return true;
  }

  bool flip(std::uint32_t half_edge) {
    const std::uint32_t twin = surface_.twin(half_edge);
    if (!operations_.flip(half_edge)) return false;
    ++report_.flips;
    enqueue_triangle(half_edge / 3, Sides::kBoth);
    enqueue_triangle(twin / 3, Sides::kBoth);
    return true;
  }

  /// A flip takes the longest edge of a cap away, a collapse the shortest of a needle.
  bool mend_sliver(std::uint32_t shortest) {
    const std::uint32_t longest = view().longest_edge(shortest / 3);
    return flip(longest) || collapse(shortest, report_.sliver_collapses);
  }

  EditableSurface surface_;
  const Tolerances& tolerances_;
  Operations operations_;
  const std::vector<std::uint8_t>& is_suspect_;
  std::priority_queue<Candidate> queue_;
  std::vector<Candidate> refused_;
  std::size_t attempts_left_;
  std::size_t done_ = 0;
  UpkeepReport report_;
};

}  // namespace

UpkeepReport keep_up(TriangleMesh& mesh, const Parameters& parameters, UpkeepMemory& memory) {
  update_twins(mesh, memory.twins);
  BirthRecords births(mesh);
  if (!births.all_noted()) births.note_missing(memory.twins);
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

void forget_birth(TriangleMesh& mesh, const std::vector<std::uint32_t>& vertices) {
  BirthRecords births(mesh);
  for (const std::uint32_t vertex : vertices) births.forget(vertex);
}

}  // namespace particle_surface_tracker
