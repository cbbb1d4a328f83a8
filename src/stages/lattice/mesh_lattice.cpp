#include "particle_surface_tracker/stages/mesh_lattice.h"

#include "cell_triangles.h"
#include "crossing_lines.h"
#include "lattice_mesh.h"
#include "lattice_predicates.h"
#include "triangle_slicer.h"

namespace particle_surface_tracker {

struct MeshLattice::Data {
  LatticeMesh mesh;
  CrossingLines lines;
  CellTriangles cells;

  Data(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, double h)
      : mesh(positions, triangles, h), lines(mesh), cells(mesh) {}
};

MeshLattice::MeshLattice(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, double h)
    : data_(std::make_unique<const Data>(positions, triangles, h)) {}

MeshLattice::~MeshLattice() = default;
MeshLattice::MeshLattice(MeshLattice&& other) noexcept = default;
MeshLattice& MeshLattice::operator=(MeshLattice&& other) noexcept = default;

double MeshLattice::h() const {
  return data_->mesh.h;
}

const std::vector<Vec3f>& MeshLattice::positions() const {
  return *data_->mesh.positions;
}

const std::vector<Triangle>& MeshLattice::triangles() const {
  return *data_->mesh.triangles;
}

const std::vector<EdgeCrossing>& MeshLattice::crossings() const {
  return data_->lines.crossings();
}

ArrayRange<EdgeCrossing> MeshLattice::crossings_on(const LatticeEdge& edge) const {
  return data_->lines.on_edge(edge);
}

int MeshLattice::winding_number(const openvdb::Coord& node, int axis) const {
  return data_->lines.winding_number(node, axis);
}

ArrayRange<std::uint32_t> MeshLattice::triangles_in_cell(const openvdb::Coord& cell) const {
  return data_->cells.in_cell(cell);
}

std::vector<openvdb::Coord> MeshLattice::cells() const {
  return data_->cells.cells_outside(NodeMasks());
}

std::vector<openvdb::Coord> MeshLattice::cells_outside(const NodeMasks& set) const {
  return data_->cells.cells_outside(set);
}

openvdb::Coord MeshLattice::cell_of_vertex(std::uint32_t vertex) const {
  return data_->mesh.cells[vertex];
}

TriangleCut MeshLattice::cut_triangle(std::uint32_t triangle) const {
  TriangleCut cut;
  cut_triangle(triangle, cut);
  return cut;
}

void MeshLattice::cut_triangle(std::uint32_t triangle, TriangleCut& cut) const {
  thread_local TriangleSlicer slicer;
  slicer.use(data_->mesh);
  slicer.cut(triangle, cut);
}

bool MeshLattice::comes_before(const LatticePoint& p, const LatticePoint& q) const {
  const auto plane = [&](const LatticePoint& point) { return point.node[point.axis]; };
  if (p.axis == q.axis) return p.step > 0 ? plane(p) < plane(q) : plane(p) > plane(q);
  const LatticeMesh& mesh = data_->mesh;
  // Both planes are crossed by the edge, so that the share of the way to them can be compared in the view along the
  // third axis.
  const int side =
      side_of_edge(mesh.position(p.a), mesh.position(p.b), p.axis, q.axis, mesh.plane(plane(p)), mesh.plane(plane(q)));
  return side * p.step * q.step > 0;
}

}  // namespace particle_surface_tracker
