#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "particle_surface_tracker/stages/remeshing.h"
#include "random_bodies.h"
#include "sequences/mesh_judge.h"
#include "stages/upkeep/half_edges.h"

// Random cases; PST_FIRST_SEED and PST_CASES choose others than those that always run.

namespace particle_surface_tracker {
namespace {

std::uint32_t number_from_environment(const char* name, std::uint32_t otherwise) {
  const char* text = std::getenv(name);
  return text == nullptr ? otherwise : static_cast<std::uint32_t>(std::stoul(text));
}

RemeshingReport remesh_case(const test::RemeshingCase& the_case, TriangleMesh& mesh, MeshTwins& twins) {
  mesh = the_case.mesh;
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), the_case.h);
  return remesh(mesh, lattice, the_case.request, twins);
}

RemeshingReport remesh_case(const test::RemeshingCase& the_case, TriangleMesh& mesh) {
  MeshTwins twins;
  return remesh_case(the_case, mesh, twins);
}

/// Twins are kept in step with what was changed.
void expect_twins_of(const TriangleMesh& mesh, const MeshTwins& twins) {
  std::vector<std::uint32_t> expected;
  pair_half_edges(mesh.vertex_count(), mesh.triangles(), expected);
  EXPECT_EQ(twins.connectivity, mesh.connectivity());
  EXPECT_EQ(twins.of_half_edges, expected);
}

/// What stays of the mesh keeps order, ids and bits, and comes first.
void expect_rest_untouched(const TriangleMesh& before, const TriangleMesh& after, const RemeshingReport& report) {
  std::vector<std::uint32_t> ids = after.ids();
  EXPECT_TRUE(std::is_sorted(ids.begin(), ids.end()));
  for (std::uint32_t v = 0; v < after.vertex_count(); ++v) {
    if (ids[v] >= before.vertex_count()) continue;
    ASSERT_EQ(after.positions()[v], before.positions()[ids[v]]);
  }
  const std::size_t kept = after.triangle_count() - report.new_triangles;
  EXPECT_EQ(kept + report.removed_triangles, before.triangle_count());
  std::size_t at = 0;
  for (std::size_t t = 0; t < kept; ++t) {
    const auto& [a, b, c] = after.triangles()[t];
    const Triangle original{ids[a], ids[b], ids[c]};
    while (at < before.triangle_count() && before.triangles()[at] != original) ++at;
    ASSERT_LT(at++, before.triangle_count());
  }
}

/// Edges of new triangles whose ends are in the same place, one at least being a new vertex.
std::size_t count_coincident(const TriangleMesh& mesh, std::size_t new_triangles, std::size_t old_ids) {
  std::size_t count = 0;
  for (std::size_t t = mesh.triangle_count() - new_triangles; t < mesh.triangle_count(); ++t) {
    const Triangle& triangle = mesh.triangles()[t];
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangle[k];
      const std::uint32_t b = triangle[(k + 1) % 3];
      if (std::max(mesh.ids()[a], mesh.ids()[b]) < old_ids) continue;
      if (mesh.positions()[a] == mesh.positions()[b]) ++count;
    }
  }
  return count;
}

/// Nodes around the new mesh that are on another side than Γ says, and all nodes that were looked at.
std::pair<std::size_t, std::size_t> count_wrong_nodes(const test::RemeshingCase& the_case, const TriangleMesh& mesh) {
  const MeshLattice before(the_case.mesh.positions(), the_case.mesh.triangles(), the_case.h);
  const MeshLattice after(mesh.positions(), mesh.triangles(), the_case.h);
  const std::vector<openvdb::Coord>& matched = the_case.request.nodes;
  std::size_t wrong = 0;
  const std::vector<openvdb::Coord> nodes = after.cells();
  for (const openvdb::Coord& node : nodes) {
    const auto found = std::lower_bound(matched.begin(), matched.end(), node);
    const bool is_matched = found != matched.end() && *found == node;
    const bool inside = is_matched ? the_case.request.gamma[static_cast<std::size_t>(found - matched.begin())] < 0.0f
                                   : before.winding_number(node) >= 1;
    if (inside != (after.winding_number(node) >= 1)) ++wrong;
  }
  return {wrong, nodes.size()};
}

TEST(RemeshingTorture, AlwaysGivesASoundMesh) {
  const std::uint32_t first = number_from_environment("PST_FIRST_SEED", 0);
  const std::uint32_t cases = number_from_environment("PST_CASES", 1000);
  std::size_t changed = 0, retries = 0, fallbacks = 0, wrong_nodes = 0, nodes = 0;
  for (std::uint32_t seed = first; seed < first + cases; ++seed) {
    const test::RemeshingCase the_case = test::make_remeshing_case(seed);
    SCOPED_TRACE("seed " + std::to_string(seed) + ": " + the_case.description);
    TriangleMesh mesh;
    MeshTwins twins;
    const RemeshingReport report = remesh_case(the_case, mesh, twins);
    EXPECT_FALSE(report.gave_up);
    if (report.changed()) expect_twins_of(mesh, twins);
    EXPECT_TRUE(test::find_surface_defects(mesh.vertex_count(), mesh.triangles()).none());
    EXPECT_TRUE(
        std::all_of(mesh.positions().begin(), mesh.positions().end(), [](const Vec3f& p) { return p.allFinite(); }));
    EXPECT_EQ(count_coincident(mesh, report.new_triangles, the_case.mesh.vertex_count()), 0u);
    expect_rest_untouched(the_case.mesh, mesh, report);
    changed += report.changed() ? 1 : 0;
    retries += report.retries;
    fallbacks += report.fallbacks;
    const auto [wrong, looked_at] = count_wrong_nodes(the_case, mesh);
    wrong_nodes += wrong;
    nodes += looked_at;
    if (HasFailure()) break;
  }
  std::printf("%zu changed, %zu retries, %zu fallbacks, %zu of %zu nodes on the wrong side\n", changed, retries,
              fallbacks, wrong_nodes, nodes);
  EXPECT_EQ(fallbacks, 0u);
  // Smoothing moves the surface across a node that it passes closely now and then.
  EXPECT_LT(wrong_nodes, nodes / 50);
  if (!HasFailure()) {
    EXPECT_GT(changed, cases / 2);
  }
}

TEST(RemeshingTorture, GivesTheSameBytesForAnyNumberOfThreads) {
  for (std::uint32_t seed = 0; seed < 40; ++seed) {
    SCOPED_TRACE(seed);
    const test::RemeshingCase the_case = test::make_remeshing_case(seed);
    TriangleMesh parallel, serial;
    remesh_case(the_case, parallel);
    const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
    remesh_case(the_case, serial);
    EXPECT_EQ(parallel.positions(), serial.positions());
    EXPECT_EQ(parallel.triangles(), serial.triangles());
    EXPECT_EQ(parallel.ids(), serial.ids());
    EXPECT_EQ(parallel.delta(), serial.delta());
  }
}

}  // namespace
}  // namespace particle_surface_tracker
