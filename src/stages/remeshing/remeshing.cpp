#include "particle_surface_tracker/stages/remeshing.h"

#include <algorithm>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "cell_complexity.h"
#include "cell_filling.h"
#include "crossing_triangles.h"
#include "face_paths.h"
#include "front_growth.h"
#include "gamma_nodes.h"
#include "lattice_parts.h"
#include "mesh_cutting.h"
#include "particle_surface_tracker/core/error.h"
#include "patch.h"
#include "patch_places.h"
#include "patched_connectivity.h"
#include "small_components.h"
#include "stages/upkeep/half_edges.h"
#include "triangle_cuts.h"

namespace particle_surface_tracker {

namespace {

using namespace remeshing;
using openvdb::Coord;

/// How often the marked cells are widened before whole components are made anew, and these before everything is.
constexpr std::size_t kWidenings = 3;
constexpr std::size_t kComponentRounds = 2;
/// Cutting marks single cells; many rounds are cheap.
constexpr std::size_t kMostRounds = 40;

class Remesher {
 public:
  Remesher(TriangleMesh& mesh, const MeshLattice& lattice, const RemeshingRequest& request, MeshTwins& twins,
           TopologyCells* record)
      : mesh_(mesh),
        twins_(twins),
        lattice_(lattice),
        request_(request),
        record_(record),
        gamma_(lattice, request.nodes, request.gamma),
        cuts_(lattice),
        tracer_(cuts_),
        growth_(marked_, tracer_) {}

  RemeshingReport run() {
    small_ = find_small_components(cuts_, *mesh_.components(), request_.is_liquid);
    report_.kept_components = small_.kept_count;
    report_.removed_components = small_.removed_count;
    mark_initial_cells();
    if (marked_.cells().empty() && small_.removed.empty()) return report_;
    find_twins();
    while (!try_once()) {
      if (!widen()) {
        report_.gave_up = true;
        return report_;
      }
    }
    return report_;
  }

 private:
  /// In a mesh that is not closed and manifold no twins are taken for given, and all of the result is checked.
  void find_twins() {
    if (try_to_update_twins(mesh_, twins_).empty()) return;
    twins_.of_half_edges.assign(3 * mesh_.triangle_count(), kNoHalfEdge);
  }

  void mark_initial_cells() {
    for (const Coord& cell : request_.flagged_cells) marked_.insert(cell);
    report_.flagged_cells = marked_.cells().size();
    for (const Coord& node : gamma_.changed()) {
      for (int corner = 0; corner < kCellCorners; ++corner) marked_.insert(node - corner_of({0, 0, 0}, corner));
    }
    report_.changed_nodes = gamma_.changed().size();
    CellComplexity complexity = classify_cells(gamma_);
    if (request_.remesh_crossings) {
      for (const Coord& cell : find_crossing_cells(lattice_)) {
        complexity.complex.insert(cell);
        complexity.tangled.insert(cell);
      }
    }
    for (const Coord& cell : complexity.tangled.cells()) marked_.insert(cell);
    report_.complex_cells = complexity.complex.cells().size();
    report_.tangled_cells = complexity.tangled.cells().size();
    const std::vector<Coord> deep = find_deep_cells(cuts_, complexity.near_sign_change, small_);
    for (const Coord& cell : deep) marked_.insert(cell);
    report_.deep_cells = deep.size();
    initial_cells_ = marked_.cells().size();
    if (record_ != nullptr) record_causes(complexity, deep);
  }

  void record_causes(const CellComplexity& complexity, const std::vector<Coord>& deep) {
    record_->cell_size = lattice_.h();
    CellSet flagged;
    for (const Coord& cell : request_.flagged_cells) flagged.insert(cell);
    record_->flagged = flagged.sorted();
    record_->complex = complexity.complex.sorted();
    record_->tangled = complexity.tangled.sorted();
    record_->deep = deep;
    record_->changed_nodes = gamma_.changed();
    std::sort(record_->changed_nodes.begin(), record_->changed_nodes.end());
  }

  void record_marked() {
    record_->marked = marked_.sorted();
    record_->front.clear();
    for (const Coord& cell : record_->marked) {
      if (is_at_front(cell)) record_->front.push_back(cell);
    }
  }

  /// Whether the mesh was cut at a face of a marked cell.
  bool is_at_front(const Coord& cell) {
    for (int face = 0; face < kCellFaces; ++face) {
      if (!marked_.contains(cell_beyond(cell, face)) && !tracer_.paths_on(face_of(cell, face)).paths.empty())
        return true;
    }
    return false;
  }

  /// Cuts, fills and checks with the cells that are marked now.
  /// \return false if that led to nothing; the mesh is as it was then.
  bool try_once() {
    growth_.run();
    Patch patch(mesh_.vertex_count());
    trouble_ = cut_mesh(cuts_, marked_, patch);
    if (!trouble_.empty() || !fill_cells(marked_, gamma_, tracer_, patch)) return false;
    drop_small_components(patch);
    place_filling(gamma_, patch);
    smooth_filling(lattice_.h(), patch);
    keep_places_apart(mesh_.positions(), lattice_.h(), patch);
    blend_filling(lattice_, patch);

    if (!is_finite(patch)) return false;
    std::optional<PatchedConnectivity> connectivity =
        patched_connectivity(mesh_.triangles(), twins_.of_half_edges, patch);
    if (!connectivity) return false;
    if (record_ != nullptr) record_marked();
    apply(patch, std::move(*connectivity));
    report_.removed_triangles = patch.removed.size();
    report_.new_triangles = patch.triangles.size();
    report_.new_vertices = patch.vertices.size();
    report_.remeshed_cells = marked_.cells().size();
    report_.marked_by_growth = marked_.cells().size() - initial_cells_;
    return true;
  }

  void drop_small_components(Patch& patch) const {
    const auto middle = static_cast<std::ptrdiff_t>(patch.removed.size());
    patch.removed.insert(patch.removed.end(), small_.removed.begin(), small_.removed.end());
    std::inplace_merge(patch.removed.begin(), patch.removed.begin() + middle, patch.removed.end());
    patch.removed.erase(std::unique(patch.removed.begin(), patch.removed.end()), patch.removed.end());
  }

  static bool is_finite(const Patch& patch) {
    return std::all_of(patch.vertices.begin(), patch.vertices.end(),
                       [](const PatchVertex& vertex) { return vertex.position.cast<float>().allFinite(); });
  }

  void apply(const Patch& patch, PatchedConnectivity&& connectivity) {
    for (const PatchVertex& vertex : patch.vertices) mesh_.append_vertex(vertex.position.cast<float>(), vertex.blend);
    mesh_.set_triangles(std::move(connectivity.triangles));
    mesh_.remove_unused_vertices();
    twins_ = {std::move(connectivity.twins), mesh_.connectivity()};
  }

  /// Marks more cells after an attempt that failed: those that cannot be cut, then those around all that are marked,
  /// then whole components, then everything.
  /// \return false if there is nothing left to try.
  bool widen() {
    if (everything_) return false;
    ++report_.retries;
    const std::size_t before = marked_.cells().size();
    if (report_.retries > kMostRounds) {
      ++report_.fallbacks;
      mark_components(/*all*/ true);
    } else if (!trouble_.empty()) {
      for (const Coord& cell : trouble_) marked_.insert(cell);
    } else if (widenings_ < kWidenings) {
      ++widenings_;
      mark_neighbors();
    } else {
      ++report_.fallbacks;
      mark_components(/*all*/ report_.fallbacks > kComponentRounds);
    }
    if (marked_.cells().size() == before && !everything_) {
      ++report_.fallbacks;
      mark_components(/*all*/ true);
    }
    return true;
  }

  void mark_neighbors() {
    const std::size_t count = marked_.cells().size();
    for (std::size_t n = 0; n < count; ++n) {
      const Coord cell = marked_.cells()[n];
      for (int x = -1; x <= 1; ++x) {
        for (int y = -1; y <= 1; ++y) {
          for (int z = -1; z <= 1; ++z) marked_.insert(cell.offsetBy(x, y, z));
        }
      }
    }
  }

  /// Marks the cells of all components of the mesh that are in marked cells, or of all there are.
  void mark_components(bool all) {
    const std::vector<Triangle>& triangles = lattice_.triangles();
    const std::shared_ptr<const VertexComponents> components = mesh_.components();
    const std::vector<std::uint32_t>& component = components->of_vertex;
    std::vector<char> is_affected(components->count, all ? 1 : 0);
    for (const Coord& cell : marked_.cells()) {
      for (const std::uint32_t t : lattice_.triangles_in_cell(cell)) is_affected[component[triangles[t][0]]] = 1;
    }
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      if (is_affected[component[triangles[t][0]]] == 0) continue;
      const TriangleCut& cut = cuts_.of(t);
      for (const Coord& cell : cut.cells) marked_.insert(cell);
      for (const TriangleCut::Segment& segment : cut.segments) {
        marked_.insert(segment.face.lower_cell());
        marked_.insert(segment.face.upper_cell());
      }
    }
    everything_ = all;
  }

  TriangleMesh& mesh_;
  MeshTwins& twins_;
  const MeshLattice& lattice_;
  const RemeshingRequest& request_;
  TopologyCells* record_;
  GammaNodes gamma_;
  TriangleCuts cuts_;
  FaceTracer tracer_;
  CellSet marked_;
  FrontGrowth growth_;
  SmallComponents small_;
  RemeshingReport report_;
  std::vector<Coord> trouble_;
  std::size_t initial_cells_ = 0;
  std::size_t widenings_ = 0;
  bool everything_ = false;
};

}  // namespace

RemeshingReport remesh(TriangleMesh& mesh, const MeshLattice& lattice, const RemeshingRequest& request,
                       TopologyCells* record) {
  MeshTwins twins;
  return remesh(mesh, lattice, request, twins, record);
}

RemeshingReport remesh(TriangleMesh& mesh, const MeshLattice& lattice, const RemeshingRequest& request,
                       MeshTwins& twins, TopologyCells* record) {
  if (request.nodes.size() != request.gamma.size()) {
    throw MeshError(fmt::format("re-meshing was given {} nodes of Γ but {} values; each node needs one",
                                request.nodes.size(), request.gamma.size()));
  }
  if (lattice.positions().size() != mesh.vertex_count() || lattice.triangles().size() != mesh.triangle_count()) {
    throw MeshError(fmt::format(
        "re-meshing was given the lattice of a mesh of {} vertices and {} triangles for one of "
        "{} and {}; make the lattice anew after every change of the mesh",
        lattice.positions().size(), lattice.triangles().size(), mesh.vertex_count(), mesh.triangle_count()));
  }
  return Remesher(mesh, lattice, request, twins, record).run();
}

}  // namespace particle_surface_tracker
