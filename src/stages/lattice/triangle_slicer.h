#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "lattice_mesh.h"

namespace particle_surface_tracker {

/// Cuts triangles along the planes of the lattice, in three passes: plane by plane, where the two sides of the triangle
/// that the plane separates cross it; between these two points, which lattice lines of the plane the triangle crosses;
/// then the way from one point to the other, face by face. Keeps its memory from one triangle to the next.
class TriangleSlicer {
 public:
  TriangleSlicer() = default;
  explicit TriangleSlicer(const LatticeMesh& mesh) : mesh_(&mesh) {}

  /// Goes on with triangles of another mesh.
  void use(const LatticeMesh& mesh) { mesh_ = &mesh; }

  /// Finds the crossings of a triangle and all lattice edges.
  /// \return points of kind kOnLatticeEdge, valid until the next call.
  const std::vector<LatticePoint>& find_crossings(std::uint32_t triangle);

  /// Cuts a triangle. The points are those of find_crossings(), then those on lattice faces.
  void cut(std::uint32_t triangle, TriangleCut& result);

 private:
  /// A side of the triangle crosses a plane.
  struct SidePoint {
    std::uint32_t a;  // ends of the mesh edge, a < b
    std::uint32_t b;
    std::int8_t step;
    double place;                        // from a to b
    std::array<std::int32_t, 2> square;  // of the plane: cell along the next axis and the one after it
  };

  /// The triangle's part in a plane: from where its outline goes up through the plane to where it comes down.
  struct Slice {
    SidePoint up;
    SidePoint down;
  };

  /// The lattice lines of a plane along the axis after the next one that the triangle crosses.
  struct Row {
    std::int32_t first_line;
    std::uint32_t first_point;
  };

  SidePoint side_point(std::uint32_t from, std::uint32_t to, int axis, std::int32_t k) const;
  std::int32_t square_along(const SidePoint& point, int axis, std::int32_t k, int along) const;
  void slice(int axis);
  void cross_lines(int axis);
  void walk(int axis, std::int32_t k, TriangleCut& result) const;
  std::uint32_t crossing(int axis, std::int32_t plane, std::int32_t line) const;

  const LatticeMesh* mesh_ = nullptr;
  std::uint32_t triangle_ = 0;
  Triangle vertices_{};
  std::array<std::int32_t, 3> first_plane_{};  // per axis
  std::array<std::vector<Slice>, 3> slices_;   // per axis of the planes
  std::array<std::vector<Row>, 3> rows_;       // per axis of the lines; one per plane across the next axis
  std::vector<LatticePoint> crossings_;
};

}  // namespace particle_surface_tracker
