#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker::test {

/// The boundary of the space around which a closed mesh winds at least once: the exact union of its bodies, what is
/// inside out being taken away. Sampled on the triangles themselves; which side of a triangle is in that space is
/// asked with exact predicates (CGAL).
class UnionReference {
 public:
  /// \param spacing of the samples, at most [m].
  /// \param offset how far beside a triangle its sides are asked [m]: sheets closer than this count as one.
  UnionReference(const TriangleMesh& mesh, double spacing, double offset);
  ~UnionReference();

  /// Points on the boundary; at most `spacing` from each other in a triangle.
  const std::vector<Vec3d>& samples() const { return samples_; }

  /// Area of the boundary [m²].
  double area() const { return area_; }

  /// Distance to the nearest sample [m]; infinite where the union is empty.
  double distance(const Vec3d& point) const;

 private:
  struct Tree;
  std::vector<Vec3d> samples_;
  double area_ = 0.0;
  std::unique_ptr<Tree> tree_;
};

/// Points on the triangles of a mesh, in each at most `spacing` from each other [m] and at least `fewest`²;
/// visit(point, normal, area) with the area that the point stands for.
template <typename Visit>
void for_samples_of(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, double spacing,
                    int fewest, Visit&& visit);

template <typename Visit>
void for_samples_of(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, double spacing,
                    int fewest, Visit&& visit) {
  for (const Triangle& t : triangles) {
    const Vec3d a = positions[t[0]].cast<double>();
    const Vec3d u = positions[t[1]].cast<double>() - a;
    const Vec3d v = positions[t[2]].cast<double>() - a;
    const Vec3d normal(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x());
    if (normal.norm() == 0.0) continue;
    const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
    const int parts = std::max(fewest, 1 + static_cast<int>(longest / spacing));
    // The middles of the parts² small triangles that are turned like the large one, and of those between them.
    for (int i = 0; i < parts; ++i) {
      for (int j = 0; i + j < parts; ++j) {
        const auto at = [&](double x, double y) { return Vec3d(a + (x / parts) * u + (y / parts) * v); };
        const double area = 0.5 * normal.norm() / (static_cast<double>(parts) * parts);
        visit(at(i + 1.0 / 3.0, j + 1.0 / 3.0), Vec3d(normal.normalized()), area);
        if (i + j + 1 < parts) visit(at(i + 2.0 / 3.0, j + 2.0 / 3.0), Vec3d(normal.normalized()), area);
      }
    }
  }
}

}  // namespace particle_surface_tracker::test
