#include "band_distances.h"

#include <algorithm>
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include "cell_functions.h"
#include "closest_place.h"
#include "tube_patches.h"

namespace particle_surface_tracker {

namespace {

constexpr int kWidth = 8;
constexpr float kNone = 1e30f;

/// Up to here cells lower the distances of the nodes around them; the few nodes farther away look for themselves
/// [cells]. Less than the margin of a block, in which a cell also has its own width.
constexpr double kScanHeight = 3.95;

/// Parts into which the leaves fall so that no node belongs to the blocks of two leaves of one part: by whether their
/// place along each axis is even or odd.
constexpr int kParts = 8;

int part_of(const openvdb::Coord& origin) {
  return (origin.x() / kWidth & 1) + 2 * (origin.y() / kWidth & 1) + 4 * (origin.z() / kWidth & 1);
}

/// Whatever part of a leaf is in a block, its rows are made of runs of so many nodes.
constexpr int kRun = 4;
static_assert(DistanceBlock::margin == kRun && DistanceBlock::width == 4 * kRun);

/// Of the nodes of a leaf, in the two orders of a DistanceBlock; the smaller of the two counts.
struct NearDistances {
  LeafDistances first;
  LeafDistances second;
};

/// Everything that one thread needs.
struct Workplace {
  DistanceBlock block;
  std::vector<Patch> patches;
};

class DistanceScan {
 public:
  DistanceScan(const SurfaceCells& cells, const NodeMasks& wanted, double reach)
      : cells_(cells), wanted_(wanted), reach_(reach), height_(std::min(reach, kScanHeight)) {}

  std::vector<LeafDistances> run() {
    near_.resize(wanted_.leaves().size());
    for_each_index(near_.size(), [&](std::size_t n) {
      near_[n].first.fill(kNone);
      near_[n].second.fill(kNone);
    });
    scan_near();
    std::vector<LeafDistances> distances(near_.size());
    for_each_index(distances.size(), [&](std::size_t n) { distances[n] = finish(n); });
    return distances;
  }

 private:
  template <typename Visit>
  static void for_each_index(std::size_t count, Visit&& visit) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, 4), [&](const auto& range) {
      for (std::size_t n = range.begin(); n != range.end(); ++n) visit(n);
    });
  }

  void scan_near() {
    std::array<std::vector<std::uint32_t>, kParts> parts;
    for (std::uint32_t n = 0; n < cells_.leaves().size(); ++n) {
      const openvdb::Coord& origin = cells_.leaves()[n].origin;
      if (is_wanted_around(origin)) parts[part_of(origin)].push_back(n);
    }
    tbb::enumerable_thread_specific<std::unique_ptr<Workplace>> workplaces(
        [] { return std::make_unique<Workplace>(); });
    for (const std::vector<std::uint32_t>& part : parts) {
      tbb::parallel_for(tbb::blocked_range<std::size_t>(0, part.size()), [&](const auto& range) {
        Workplace& workplace = *workplaces.local();
        for (std::size_t n = range.begin(); n != range.end(); ++n) {
          scan_leaf(cells_.leaves()[part[n]], workplace);
          merge(cells_.leaves()[part[n]].origin, workplace.block);
        }
      });
    }
  }

  template <typename Visit>
  void for_each_neighbor(const openvdb::Coord& origin, Visit&& visit) const {
    for (int n = 0; n < 27; ++n) {
      const openvdb::Coord step(n / 9 - 1, n / 3 % 3 - 1, n % 3 - 1);
      const std::uint32_t number =
          wanted_.find(origin.offsetBy(kWidth * step.x(), kWidth * step.y(), kWidth * step.z()));
      if (number != LeafIndex::none) visit(step, number);
    }
  }

  bool is_wanted_around(const openvdb::Coord& origin) const {
    bool is_wanted = false;
    for_each_neighbor(origin, [&](const openvdb::Coord&, std::uint32_t) { is_wanted = true; });
    return is_wanted;
  }

  void scan_leaf(const SurfaceCells::Leaf& leaf, Workplace& workplace) const {
    std::fill(std::begin(workplace.block.squared), std::end(workplace.block.squared), kNone);
    const std::vector<CutCell>& cut = cells_.surface().triangulation.cells;
    for (std::uint32_t c = leaf.begin; c != leaf.end; ++c) {
      const openvdb::Coord& corner = cut[c].origin;
      const PatchAxes axes =
          list_patches(cells_.bounds(c), corner - leaf.origin, static_cast<float>(height_), workplace.patches);
      for (std::uint32_t t = cut[c].first_triangle; t < cut[c + 1].first_triangle; t += CellFunctions::max_faces) {
        const std::uint32_t end = std::min(t + CellFunctions::max_faces, cut[c + 1].first_triangle);
        kernel_(make_cell_functions(cells_, corner, t, end), axes, workplace.patches.data(),
                static_cast<int>(workplace.patches.size()), workplace.block);
      }
    }
  }

  /// Takes the distances of a block over to the leaves it overlaps.
  void merge(const openvdb::Coord& origin, const DistanceBlock& block) {
    for_each_neighbor(origin, [&](const openvdb::Coord& step, std::uint32_t number) {
      const int x = step.x();
      const int y = step.y();
      const int z = step.z();
      lower_rows(block.squared, {x, y, z}, near_[number].first.data());
      lower_rows(block.squared + DistanceBlock::size, {z, x, y}, near_[number].second.data());
    });
  }

  /// Lowers the distances of one leaf, `step` leaves from the block's along the slowest to the fastest axis.
  static void lower_rows(const float* block, const std::array<int, 3>& step, float* leaf) {
    constexpr int width = DistanceBlock::width;
    std::array<int, 3> low;
    std::array<int, 3> high;
    std::array<int, 3> shift;
    for (int i = 0; i < 3; ++i) {
      low[i] = step[i] < 0 ? kWidth - DistanceBlock::margin : 0;
      high[i] = step[i] > 0 ? width - DistanceBlock::margin - kWidth : kWidth;
      shift[i] = kWidth * step[i] + DistanceBlock::margin;
    }
    for (int i = low[0]; i < high[0]; ++i) {
      for (int j = low[1]; j < high[1]; ++j) {
        const float* from = block + ((i + shift[0]) * width + j + shift[1]) * width + shift[2];
        float* to = leaf + 64 * i + 8 * j;
        for (int k = low[2]; k < high[2]; k += kRun) {
          for (int n = k; n < k + kRun; ++n) to[n] = std::min(to[n], from[n]);
        }
      }
    }
  }

  /// Chooses the smaller distances of a leaf, and looks for those that are too large for the scan.
  LeafDistances finish(std::size_t n) const {
    const NodeMasks::Leaf& wanted = wanted_.leaves()[n];
    const NearDistances& near = near_[n];
    const auto resolved = static_cast<float>(height_ * height_);
    LeafDistances distances;
    distances.fill(kNone);
    ClosestPlaceSearch search(cells_, reach_);
    for (int x = 0; x < kWidth; ++x) {
      for_each_bit(wanted.words[x], [&](int bit) {
        const int y = bit >> 3;
        const int z = bit & 7;
        float& squared = distances[64 * x + bit];
        squared = std::min(near.first[64 * x + bit], near.second[64 * z + 8 * x + y]);
        if (squared <= resolved) return;
        const openvdb::Coord node = wanted.origin.offsetBy(x, y, z);
        squared = reach_ > height_ ? search.find(Vec3d(node.x(), node.y(), node.z())).squared_distance : kNone;
      });
    }
    return distances;
  }

  const SurfaceCells& cells_;
  const NodeMasks& wanted_;
  double reach_;
  double height_;
  PatchKernel kernel_ = active_patch_kernel();
  std::vector<NearDistances> near_;
};

}  // namespace

std::vector<LeafDistances> measure_distances(const SurfaceCells& cells, const NodeMasks& wanted, double reach) {
  return DistanceScan(cells, wanted, reach).run();
}

}  // namespace particle_surface_tracker
