#pragma once

#include <functional>
#include <set>
#include <vector>

#include <openvdb/Types.h>

#include "particle_surface_tracker/core/implicit_surface.h"
#include "particle_surface_tracker/core/parameters.h"
#include "particle_surface_tracker/core/triangle_mesh.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "particle_surface_tracker/stages/topology_matching.h"

/// Bodies whose signed distances are known, and what happens to them.
namespace particle_surface_tracker::test::matching {

constexpr double kR = 0.1;       ///< r [m].
constexpr double kH = 0.5 * kR;  ///< Δx_Γ [m].
constexpr int kHalfWidth = 40;   ///< Everything is within so many nodes of the origin, on the lattice of Γ.

using Body = std::function<double(const Vec3d&)>;  ///< Signed distance [m].

Parameters make_parameters();

Body ball(const Vec3d& center, double radius);
Body capsule(const Vec3d& from, const Vec3d& to, double radius);
Body either(const Body& a, const Body& b);   ///< Union.
Body without(const Body& a, const Body& b);  ///< Difference.

/// φ of a body.
ImplicitSurface make_surface(const Body& body, double dx = kH);

/// A mesh of a body with edges of about r/4, on no lattice of the library.
TriangleMesh make_mesh(const Body& body);

/// The cells of Γ that triangles meet one of whose corners fulfils a condition.
std::vector<openvdb::Coord> cells_where(const TriangleMesh& mesh, const std::function<bool(const Vec3d&)>& condition);

/// Position of a node of Γ [m].
Vec3d place(const openvdb::Coord& node);

using Nodes = std::set<openvdb::Coord>;

/// Nodes of Γ inside a body.
Nodes nodes_inside(const Body& body);

/// Nodes of Γ inside the mesh as the matching left it.
Nodes nodes_inside(const MeshLattice& lattice, const MatchedVoxelization& matched);

/// Sets of nodes that are connected along lattice edges.
int count_components(const Nodes& nodes);

}  // namespace particle_surface_tracker::test::matching
