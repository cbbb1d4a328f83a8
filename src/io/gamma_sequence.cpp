#include "particle_surface_tracker/io/gamma_sequence.h"

#include <openvdb/tools/Morphology.h>
#include <openvdb/tools/SignedFloodFill.h>

#include <cmath>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "file_bytes.h"
#include "particle_surface_tracker/core/mesh_validation.h"
#include "particle_surface_tracker/stages/mesh_lattice.h"
#include "sequence_folder.h"
#include "vdb_bytes.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

constexpr int kHalfWidth = 3;  // [cells], what OpenVDB's tools take for granted.

/// All nodes that can be within kHalfWidth cells of the mesh.
std::vector<Coord> nodes_near(const MeshLattice& lattice) {
  openvdb::MaskTree mask;
  for (const Coord& cell : lattice.cells()) {
    for (int corner = 0; corner < 8; ++corner) {
      mask.setValueOn(cell.offsetBy(corner & 1, corner >> 1 & 1, corner >> 2));
    }
  }
  openvdb::tools::dilateActiveValues(mask, kHalfWidth, openvdb::tools::NN_FACE_EDGE_VERTEX,
                                     openvdb::tools::EXPAND_TILES);
  mask.voxelizeActiveTiles();
  std::vector<Coord> nodes;
  nodes.reserve(mask.activeVoxelCount());
  for (auto value = mask.cbeginValueOn(); value; ++value) nodes.push_back(value.getCoord());
  return nodes;
}

openvdb::FloatGrid::Ptr gamma_of(const TriangleMesh& mesh, double h) {
  const MeshLattice lattice(mesh.positions(), mesh.triangles(), h);
  const auto reach = static_cast<float>(kHalfWidth * h);
  auto grid = openvdb::FloatGrid::create(reach);
  grid->setName("gamma");
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  grid->setTransform(openvdb::math::Transform::createLinearTransform(h));
  const std::vector<Coord> nodes = nodes_near(lattice);
  const std::vector<float> distances = signed_distances(lattice, nodes, kHalfWidth * h);
  auto accessor = grid->getAccessor();
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    if (std::abs(distances[n]) < reach) accessor.setValueOn(nodes[n], distances[n]);
  }
  openvdb::tools::signedFloodFill(grid->tree());
  return grid;
}

}  // namespace

void write_gamma_vdb(const std::string& path, const TriangleMesh& mesh, double h) {
  if (mesh.triangle_count() != 0) check_closed_manifold(mesh);  // A liquid may be gone.
  openvdb::initialize();
  write_file_whole(path, vdb_bytes({gamma_of(mesh, h)}));
}

GammaSequence::GammaSequence(std::string folder, double h) : folder_(std::move(folder)), h_(h) {
  make_sequence_folder(folder_);
}

void GammaSequence::write(const TriangleMesh& mesh, std::uint64_t frame) const {
  write_gamma_vdb((std::filesystem::path(folder_) / fmt::format("gamma_{:06}.vdb", frame)).string(), mesh, h_);
}

}  // namespace particle_surface_tracker
