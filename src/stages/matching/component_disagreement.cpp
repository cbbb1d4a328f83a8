#include "particle_surface_tracker/stages/component_disagreement.h"

#include <algorithm>
#include <array>
#include <map>
#include <utility>

#include "component_labels.h"
#include "joining_specks.h"
#include "stages/detection/triangle_cells.h"
#include "stages/nodes/lattice_cell.h"
#include "stages/nodes/node_masks.h"
#include "stages/upkeep/birth_record.h"

namespace particle_surface_tracker {

namespace {

constexpr const char* kAttributeName = "bridge";

/// A component of the mesh with more triangles may have detail that is worth keeping.
constexpr std::size_t kLargestScrap = 500;

/// An edge must have grown by this factor since its birth to span a gap.
constexpr double kGrowth = 1.9;

/// ... and be longer than this [h].
constexpr double kLength = 1.25;

/// Cells of φ around a bridge of birth that belong to it.
constexpr int kBridgeReach = 6;

using Labels = std::vector<std::int32_t>;

/// The triangles with corners at different components of φ = 0.
std::vector<Triangle> spanning_triangles(const TriangleMesh& mesh, const Labels& labels) {
  std::vector<Triangle> spanning;
  for (const Triangle& t : mesh.triangles()) {
    if (labels[t[0]] != labels[t[1]] || labels[t[1]] != labels[t[2]]) spanning.push_back(t);
  }
  return spanning;
}

/// Components of the mesh that should not be there, or not be on their own.
class StrayPieces {
 public:
  enum class Kind : std::uint8_t { kNone, kScrap, kBody };

  StrayPieces(const TriangleMesh& mesh, std::uint32_t first_new_id, const Labels& labels)
      : components_(mesh.components()), kinds_(components_->count, Kind::kNone) {
    const std::size_t count = components_->count;
    const std::vector<std::uint32_t>& of_vertex = components_->of_vertex;
    if (count <= 1) return;
    std::vector<std::size_t> sizes(count, 0);
    for (const Triangle& t : mesh.triangles()) ++sizes[of_vertex[t[0]]];
    std::vector<bool> has_changed(count, false);
    auto entry = votes_.end();
    for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
      // Away from all others there is only the largest.
      const std::pair key(of_vertex[v], std::max(labels[v], 0));
      // Mostly that of the vertex before.
      if (entry == votes_.end() || entry->first != key) entry = votes_.try_emplace(key, 0).first;
      ++entry->second;
      if (mesh.ids()[v] >= first_new_id) has_changed[of_vertex[v]] = true;
    }
    std::vector<std::pair<std::size_t, std::int32_t>> choice(count, {0, 0});
    for (const auto& [place, number] : votes_) {
      const auto& [component, label] = place;
      if (number > choice[component].first) choice[component] = {number, label};
      auto& best = owner_[label];
      if (number > best.first) best = {number, component};
    }
    for (std::uint32_t c = 0; c < count; ++c) {
      if (!has_changed[c] || owner_[choice[c].second].second == c) continue;
      kinds_[c] = sizes[c] <= kLargestScrap ? Kind::kScrap : Kind::kBody;
    }
  }

  bool none() const {
    return std::all_of(kinds_.begin(), kinds_.end(), [](Kind kind) { return kind == Kind::kNone; });
  }

  /// Of the component that a triangle belongs to.
  Kind kind_of(const Triangle& t) const { return kinds_[component_of(t)]; }

  /// Whether the component that a triangle belongs to has much of two components of φ = 0.
  bool holds_both(const Triangle& t, std::int32_t label, std::int32_t other) const {
    return kinds_.size() == 1 || (holds(component_of(t), label) && holds(component_of(t), other));
  }

  std::uint32_t component_of(const Triangle& t) const { return components_->of_vertex[t[0]]; }

 private:
  /// Whether a component of the mesh has at least half as many vertices at one of φ = 0 as that which has most: what is
  /// only near to it, as detail of the body beside it is, has fewer.
  bool holds(std::uint32_t component, std::int32_t label) const {
    return 2 * votes_.at({component, label}) >= owner_.at(label).first;
  }

  std::shared_ptr<const VertexComponents> components_;
  std::vector<Kind> kinds_;
  /// How many vertices each component of the mesh has at every one of φ = 0.
  std::map<std::pair<std::uint32_t, std::int32_t>, std::size_t> votes_;
  /// Of every component of φ = 0 that of the mesh with most vertices there, and how many.
  std::map<std::int32_t, std::pair<std::size_t, std::uint32_t>> owner_;
};

/// Finds triangles that hold bodies together which have come apart.
class Bridges {
 public:
  /// \param spanning the triangles that may be part of one.
  Bridges(const TriangleMesh& mesh, const std::vector<Triangle>& spanning, std::uint32_t first_new_id,
          const ComponentLabels& components, const Labels& labels, const StrayPieces& pieces, double h)
      : mesh_(mesh),
        first_new_id_(first_new_id),
        components_(components),
        labels_(labels),
        pieces_(pieces),
        joining_specks_(spanning, *mesh.components(), components, labels),
        h_(h) {}

  /// Whether an edge runs from one body to another. Where a part of the liquid is thinner than r, φ = 0 can come apart
  /// and together again as the lattice lies: detail must not follow, so it is a bridge only where an edge has grown
  /// long, as it does where the bodies really part. Surface that re-meshing has made follows φ wherever its piece of
  /// the mesh has much of both bodies.
  bool contain(const Triangle& t) const {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t a = t[k], b = t[(k + 1) % 3];
      if (labels_[a] == labels_[b] || !counts(t, a) || !counts(t, b)) continue;
      if ((is_new(a) || is_new(b)) && pieces_.holds_both(t, labels_[a], labels_[b])) return true;
      const double length = (mesh_.positions()[a] - mesh_.positions()[b]).cast<double>().norm();
      if (length > std::max(kLength * h_, kGrowth * longest_edge_at_birth(mesh_, a, b))) return true;
    }
    return false;
  }

 private:
  bool is_new(std::uint32_t v) const { return mesh_.ids()[v] >= first_new_id_; }

  /// Whether the component of φ = 0 that a corner belongs to is a body, or joins bodies.
  bool counts(const Triangle& t, std::uint32_t corner) const {
    const std::int32_t label = labels_[corner];
    if (label == ComponentLabels::kFar) return false;
    return !components_.is_speck(label) || joining_specks_.contain(pieces_.component_of(t), label);
  }

  const TriangleMesh& mesh_;
  std::uint32_t first_new_id_;
  const ComponentLabels& components_;
  const Labels& labels_;
  const StrayPieces& pieces_;
  JoiningSpecks joining_specks_;
  double h_;
};

}  // namespace

ComponentDisagreement find_component_disagreement(const TriangleMesh& mesh, std::uint32_t first_new_id,
                                                  const IsosurfaceQuery& isosurface, const Parameters& parameters) {
  if (parameters.detection == DetectionMethod::kTau || mesh.triangles().empty()) return {};
  const ComponentLabels& components = isosurface.components();
  const Labels labels = components.of(mesh.positions());
  const StrayPieces pieces(mesh, first_new_id, labels);
  if (components.is_of_one_piece() && pieces.none()) return {};
  const std::size_t attribute = mesh.attributes().find(kAttributeName);
  const auto is_old_bridge = [&](const Triangle& t) {
    if (attribute == VertexAttributes::none) return false;
    // New vertices inherit the attribute, which by and by would spread over the whole mesh.
    const std::vector<float>& bridge = mesh.attributes()[attribute].values;
    return std::all_of(t.begin(), t.end(), [&](std::uint32_t v) { return mesh.ids()[v] < first_new_id; }) &&
           std::any_of(t.begin(), t.end(), [&](std::uint32_t v) { return bridge[v] > 0.0F; });
  };
  const double h = parameters.dx_gamma * parameters.particle_spacing;
  ComponentDisagreement found;
  const auto append_cells = [&](const Triangle& t, std::vector<openvdb::Coord>& cells) {
    const auto at = [&](std::size_t k) -> Vec3d { return mesh.positions()[t[k]].cast<double>(); };
    append_triangle_cells({at(0), at(1), at(2)}, h, cells);
  };
  if (!pieces.none()) {
    for (const Triangle& t : mesh.triangles()) {
      const StrayPieces::Kind kind = pieces.kind_of(t);
      if (kind == StrayPieces::Kind::kScrap) append_cells(t, found.scrap_cells);
      if (kind == StrayPieces::Kind::kBody) append_cells(t, found.stray_cells);
    }
  }
  const std::vector<Triangle> spanning = spanning_triangles(mesh, labels);
  const Bridges bridges(mesh, spanning, first_new_id, components, labels, pieces, h);
  for (const Triangle& t : spanning) {
    if (pieces.kind_of(t) != StrayPieces::Kind::kScrap && bridges.contain(t) && !is_old_bridge(t)) {
      append_cells(t, found.bridge_cells);
    }
  }
  for (std::vector<openvdb::Coord>* cells : {&found.bridge_cells, &found.scrap_cells, &found.stray_cells}) {
    std::sort(cells->begin(), cells->end());
    cells->erase(std::unique(cells->begin(), cells->end()), cells->end());
  }
  return found;
}

void note_bridges(TriangleMesh& mesh, const IsosurfaceQuery& isosurface) {
  const Labels labels = isosurface.components().of(mesh.positions());
  const std::size_t attribute = mesh.attributes().add(kAttributeName, 1, {0.0F}, AttributeUse::kInternal);
  const auto cell_at = [&](std::uint32_t v) {
    return cell_of(mesh.positions()[v].cast<double>() / isosurface.surface().dx);
  };
  NodeMasks cells;
  for (const Triangle& t : spanning_triangles(mesh, labels)) {
    for (const std::uint32_t v : t) cells.insert(cell_at(v));
  }
  if (cells.leaves().empty()) return;
  // Which component is nearest depends on how the lattice lies, by some cells.
  cells.dilate(kBridgeReach, kBridgeReach);
  std::vector<float>& bridge = mesh.attributes()[attribute].values;
  for (std::uint32_t v = 0; v < mesh.vertex_count(); ++v) {
    if (cells.contains(cell_at(v))) bridge[v] = 1.0F;
  }
}

}  // namespace particle_surface_tracker
