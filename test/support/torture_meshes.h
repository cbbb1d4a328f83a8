#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "particle_surface_tracker/core/triangle_mesh.h"

namespace particle_surface_tracker::test {

/// A mesh that is hard to cut, split and merge, and the lattice that makes it so. Each of its components is closed and
/// manifold; together they may overlap, touch, coincide, be inside out, and have triangles without area.
struct TortureMesh {
  std::string name;  ///< What is in it, and the seed.
  double h;          ///< Cell size [m].
  TriangleMesh mesh;
};

/// Two to six random bodies pushed through each other: spheres, tori, knots, slivers, needles, specks smaller than a
/// cell, boxes on the lattice, shells in shells; some repeated in place, some inside out; on some seeds with all
/// vertices on nodes or halves of cells, or far from the origin. The same for the same seed.
TortureMesh make_torture_mesh(std::uint32_t seed);

/// Pairs and groups of bodies in one chosen unlucky position each.
std::vector<TortureMesh> chosen_torture_meshes();

/// A tube around a trefoil knot, about `size` in radius: closed, manifold, genus 1.
TriangleMesh make_knot(const Vec3d& center, double size, double tube_radius, int rings, int sides);

/// Volume of the space around which a closed mesh winds at least once, also where it overlaps itself [m³]. Measured
/// along lines × lines vertical lines: off by about the area of the surface times its extent / lines, or less.
double covered_volume(const std::vector<Vec3f>& positions, const std::vector<Triangle>& triangles, int lines);

}  // namespace particle_surface_tracker::test
