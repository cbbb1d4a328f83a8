#include "band_distances.h"

#include <algorithm>
#include <array>
#include <memory>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "cell_kernel.h"
#include "closest_place.h"
#include "leaf_values.h"
#include "particle_surface_tracker/core/signed_distance_field.h"

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;

/// Up to here cells lower the distances of the nodes around them; the few nodes farther away look for themselves
/// [cells]. No node nearer than that is beyond kFirstAround or kLastAround: no triangle lies in a side of its cell.
constexpr double kScanHeight = 4.0;

/// Parts into which the leaves fall so that the nodes around two leaves of one part are different ones: by whether
/// their place along each axis is even or odd.
constexpr int kParts = 8;

int part_of(const openvdb::Coord& origin) {
  return (origin.x() / kWidth & 1) + 2 * (origin.y() / kWidth & 1) + 4 * (origin.z() / kWidth & 1);
}

/// Nodes of a tube below and above the corner of its cell along each axis, at most.
constexpr int kTubeDown = 3;
constexpr int kTubeUp = 4;

bool has_bit(const LeafWords& words, const openvdb::Coord& place) {
  return (words[place.x()] >> (kWidth * place.y() + place.z()) & 1) != 0;
}

/// Nodes that one search looks for the distances of, at least.
constexpr std::size_t kFarNodesAtOnce = 1000;

/// Scratch of one thread.
struct Workplace {
  std::vector<TriangleShape> triangles;  ///< Of the leaf.
  CellShape shape;
  NodeList list;
};

class DistanceScan {
 public:
  DistanceScan(const SurfaceCells& cells, const NodeMasks& wanted, double reach)
      : cells_(cells),
        wanted_(wanted),
        reach_(reach),
        height_(std::min(reach, kScanHeight)),
        squared_(wanted.leaves().size()) {}

  SquaredDistances run() {
    // Where few nodes are wanted, most cells have none of them around.
    if (4 * wanted_.leaves().size() < cells_.leaves().size()) {
      scanned_ = wanted_;
      scanned_->dilate(kTubeUp, kTubeDown);
    }
    scan_near();
    if (reach_ > height_) search_far();
    return std::move(squared_);
  }

 private:
  void scan_near() {
    std::array<std::vector<std::uint32_t>, kParts> parts;
    for (std::uint32_t n = 0; n < cells_.leaves().size(); ++n) {
      parts[part_of(cells_.leaves()[n].origin)].push_back(n);
    }
    tbb::enumerable_thread_specific<std::unique_ptr<Workplace>> workplaces(
        [] { return std::make_unique<Workplace>(); });
    for (const std::vector<std::uint32_t>& part : parts) {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, part.size()), [&](const auto& range) {
        Workplace& workplace = *workplaces.local();
        for (std::size_t n = range.begin(); n != range.end(); ++n) scan_leaf(cells_.leaves()[part[n]], workplace);
      });
    }
  }

  void scan_leaf(const SurfaceCells::Leaf& leaf, Workplace& workplace) {
    const std::uint32_t scanned = scanned_ ? scanned_->find(leaf.origin) : LeafIndex::none;
    if (scanned_ && scanned == LeafIndex::none) return;
    LeafTargets targets;
    targets.squared = squared_.data();
    bool is_wanted = false;
    for (int n = 0; n < LeafTargets::size; ++n) {
      targets.begin[n] = LeafTargets::unwanted;
      const std::uint32_t number =
          wanted_.find(leaf.origin.offsetBy(kWidth * (n / 9 - 1), kWidth * (n / 3 % 3 - 1), kWidth * (n % 3 - 1)));
      if (number == LeafIndex::none) continue;
      targets.begin[n] = static_cast<std::int32_t>(number * SquaredDistances::leaf_size);
      is_wanted = true;
    }
    if (!is_wanted) return;
    const std::vector<CutCell>& cut = cells_.surface().triangulation.cells;
    const TriangleRange range = cells_.triangles_of(leaf);
    if (workplace.triangles.size() < range.end - range.begin + TriangleKernel::lanes) {
      workplace.triangles.resize(2 * (range.end - range.begin) + TriangleKernel::lanes);
    }
    triangle_kernel_.make_shapes(range, workplace.triangles.data());
    for (std::uint32_t c = leaf.begin; c != leaf.end; ++c) {
      if (scanned_ && !has_bit(scanned_->leaves()[scanned].words, cut[c].origin - leaf.origin)) continue;
      make_cell_shape(cells_, c, workplace.triangles.data() + (cut[c].first_triangle - range.begin), workplace.shape);
      kernel_(workplace.shape, make_cell_tube(workplace.shape, static_cast<float>(height_)), workplace.list, targets);
    }
  }

  /// A node that the scan did not reach.
  struct FarNode {
    std::uint32_t leaf;
    int place;  ///< 64 x + 8 y + z.
  };

  std::vector<FarNode> list_far_nodes() const {
    const auto resolved = static_cast<float>(height_ * height_);
    std::vector<LeafWords> far(wanted_.leaves().size());
    tbb::parallel_for(std::size_t{0}, far.size(), [&](std::size_t n) {
      const LeafWords near = nodes_at_most(squared_.leaf(n), resolved);
      for (int x = 0; x < kWidth; ++x) far[n][x] = wanted_.leaves()[n].words[x] & ~near[x];
    });
    std::vector<FarNode> nodes;
    for (std::uint32_t n = 0; n < far.size(); ++n) {
      for (int x = 0; x < kWidth; ++x) {
        for_each_bit(far[n][x], [&](int bit) { nodes.push_back({n, 64 * x + bit}); });
      }
    }
    return nodes;
  }

  /// Looks for the distances that are too large for the scan. Nodes close together look at the same cells, which a
  /// search prepares once: mostly there are so few that one search should have them all.
  void search_far() {
    const std::vector<FarNode> nodes = list_far_nodes();
    tbb::enumerable_thread_specific<ClosestPlaceSearch> searches([&] { return ClosestPlaceSearch(cells_, reach_); });
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, nodes.size(), kFarNodesAtOnce),
        [&](const auto& range) {
          ClosestPlaceSearch& search = searches.local();
          for (std::size_t n = range.begin(); n != range.end(); ++n) {
            const auto [leaf, place] = nodes[n];
            const openvdb::Coord& origin = wanted_.leaves()[leaf].origin;
            const Vec3d node(origin.x() + (place >> 6), origin.y() + (place >> 3 & 7), origin.z() + (place & 7));
            float& squared = squared_.leaf(leaf)[place];
            squared = std::min(squared, search.find(node, squared).squared_distance);
          }
        },
        tbb::simple_partitioner());
  }

  const SurfaceCells& cells_;
  const NodeMasks& wanted_;
  double reach_;
  double height_;
  std::optional<NodeMasks> scanned_;  ///< The cells that matter, unless nearly all do.
  CellKernel kernel_ = active_cell_kernel();
  const TriangleKernel& triangle_kernel_ = active_triangle_kernel();
  SquaredDistances squared_;
};

}  // namespace

SquaredDistances measure_distances(const SurfaceCells& cells, const NodeMasks& wanted, double reach) {
  return DistanceScan(cells, wanted, reach).run();
}

}  // namespace particle_surface_tracker
