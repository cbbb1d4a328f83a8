#include "cell_functions.h"

#include <Eigen/Geometry>

namespace particle_surface_tracker {

namespace {

void add_function(CellFunctions& to, int& count, const Vec3f& gradient, float constant) {
  to.constant[count] = constant;
  for (int axis = 0; axis < 3; ++axis) to.gradient[axis][count] = gradient[axis];
  ++count;
}

}  // namespace

CellFunctions make_cell_functions(const SurfaceCells& cells, const openvdb::Coord& corner, std::uint32_t first_triangle,
                                  std::uint32_t last_triangle) {
  CellFunctions result;
  const std::vector<Triangle>& triangles = cells.surface().triangulation.triangles;
  Vec3f places[CellFunctions::max_faces][3];
  int count = 0;
  for (std::uint32_t t = first_triangle; t != last_triangle; ++t) {
    Vec3f* place = places[t - first_triangle];
    for (int i = 0; i < 3; ++i) place[i] = cells.relative(triangles[t][i], corner);
    const Vec3f& normal = cells.normal(t);
    if (normal.isZero(0.0f)) continue;  // its edges are all there is of it
    add_function(result, count, normal, -normal.dot(place[0]));
    for (int i = 0; i < 3; ++i) {
      const Vec3f inward = normal.cross(place[(i + 1) % 3] - place[i]);
      add_function(result, count, inward, -inward.dot(place[i]));
    }
    ++result.faces;
  }
  for (std::uint32_t t = first_triangle; t != last_triangle; ++t) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3;
      if (triangles[t][i] > triangles[t][j]) continue;
      const Vec3f& a = places[t - first_triangle][i];
      const Vec3f edge = places[t - first_triangle][j] - a;
      const float squared_length = edge.squaredNorm();
      const Vec3f along = squared_length > 0.0f ? Vec3f(edge / squared_length) : Vec3f::Zero();
      add_function(result, count, along, -along.dot(a));
      add_function(result, count, -2.0f * a, a.squaredNorm());
      result.squared_length[result.edges++] = squared_length;
    }
  }
  return result;
}

}  // namespace particle_surface_tracker
