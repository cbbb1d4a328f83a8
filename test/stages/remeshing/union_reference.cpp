#include "union_reference.h"

#include <cmath>
#include <limits>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Orthogonal_k_neighbor_search.h>
#include <CGAL/Search_traits_3.h>

#include "sequences/solid_judge.h"

namespace particle_surface_tracker::test {

namespace {

/// Of a small triangle too a part can be on the boundary and the rest inside another body; a quarter of its edge is too
/// coarse to see that part where bodies of a cell's size touch each other.
constexpr int kFewestParts = 8;

}  // namespace

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Search = CGAL::Orthogonal_k_neighbor_search<CGAL::Search_traits_3<Kernel>>;

struct UnionReference::Tree {
  Search::Tree points;
};

UnionReference::UnionReference(const TriangleMesh& mesh, double spacing, double offset)
    : tree_(std::make_unique<Tree>()) {
  const SolidJudge judge(mesh.positions(), mesh.triangles());
  for_samples_of(mesh.positions(), mesh.triangles(), spacing, kFewestParts,
                 [&](const Vec3d& point, const Vec3d& normal, double area) {
                   const Vec3d outer = point + offset * normal;
                   const Vec3d inner = point - offset * normal;
                   if ((judge.winding_number(outer) >= 1) == (judge.winding_number(inner) >= 1)) {
                     return;
                   }
                   samples_.push_back(point);
                   area_ += area;
                   tree_->points.insert(Kernel::Point_3(point.x(), point.y(), point.z()));
                 });
  if (!samples_.empty()) tree_->points.build();
}

UnionReference::~UnionReference() = default;

double UnionReference::distance(const Vec3d& point) const {
  if (samples_.empty()) return std::numeric_limits<double>::infinity();
  Search search(tree_->points, Kernel::Point_3(point.x(), point.y(), point.z()), 1);
  return std::sqrt(search.begin()->second);
}

}  // namespace particle_surface_tracker::test
