#include "particle_surface_tracker/io/cell_files.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "file_bytes.h"
#include "sequence_folder.h"
#include "vdb_bytes.h"
#include "vtp_arrays.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;
using Cells = std::vector<Coord>;

struct NamedCells {
  const char* name;
  const Cells* cells;
};

std::array<NamedCells, 6> kinds_of(const TopologyCells& cells) {
  return {{{"flagged", &cells.flagged},
           {"complex", &cells.complex},
           {"tangled", &cells.tangled},
           {"deep", &cells.deep},
           {"marked", &cells.marked},
           {"front", &cells.front}}};
}

bool holds(const Cells& sorted, const Coord& cell) {
  return std::binary_search(sorted.begin(), sorted.end(), cell);
}

/// \param place of voxel 0 [cells].
openvdb::math::Transform::Ptr transform_of(const TopologyCells& cells, double place) {
  auto transform = openvdb::math::Transform::createLinearTransform(cells.cell_size);
  transform->postTranslate(openvdb::Vec3d(place * cells.cell_size));
  return transform;
}

openvdb::GridBase::Ptr mask_of(const NamedCells& named, const openvdb::math::Transform::Ptr& transform) {
  const auto grid = openvdb::MaskGrid::create();
  grid->setName(named.name);
  grid->setTransform(transform);
  for (const Coord& cell : *named.cells) grid->tree().setValueOn(cell);
  return grid;
}

openvdb::GridBase::Ptr psi_grid(const char* name, const NodeValues& values,
                                const openvdb::math::Transform::Ptr& transform) {
  const auto grid = openvdb::FloatGrid::create(0.0F);
  grid->setName(name);
  grid->setTransform(transform);
  for (std::size_t n = 0; n < values.nodes.size(); ++n) grid->tree().setValueOn(values.nodes[n], values.values[n]);
  return grid;
}

/// The first kind that applies.
CellKind kind_of(const TopologyCells& cells, const Coord& cell) {
  if (holds(cells.flagged, cell)) return CellKind::kFlagged;
  if (holds(cells.tangled, cell)) return CellKind::kTangled;
  if (holds(cells.deep, cell)) return CellKind::kDeep;
  if (!holds(cells.marked, cell)) return CellKind::kComplex;
  for (int corner = 0; corner < 8; ++corner) {
    if (holds(cells.changed_nodes, cell.offsetBy(corner & 1, corner >> 1 & 1, corner >> 2))) return CellKind::kAtChange;
  }
  return CellKind::kGrown;
}

/// The columns of a table of points.
struct Points {
  std::vector<float> places;
  std::vector<std::uint8_t> kinds;
  std::array<std::vector<std::uint8_t>, 6> is_of_kind;
  std::vector<std::uint8_t> is_changed_node;
  std::vector<float> psi;

  explicit Points(const TopologyCells& cells) {
    const auto named = kinds_of(cells);
    Cells all;
    for (const NamedCells& kind : named) all.insert(all.end(), kind.cells->begin(), kind.cells->end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    for (const Coord& cell : all) {
      add(cell, 0.5, cells.cell_size, kind_of(cells, cell), 0.0F);
      is_changed_node.push_back(0);
      for (std::size_t k = 0; k < named.size(); ++k) is_of_kind[k].push_back(holds(*named[k].cells, cell) ? 1 : 0);
    }
    add_nodes(cells, cells.fixed, CellKind::kFixedNode);
    add_nodes(cells, cells.unknown, CellKind::kUnknownNode);
  }

 private:
  void add(const Coord& at, double offset, double cell_size, CellKind kind, float value) {
    for (int axis = 0; axis < 3; ++axis) places.push_back(static_cast<float>((at[axis] + offset) * cell_size));
    kinds.push_back(static_cast<std::uint8_t>(kind));
    psi.push_back(value);
  }

  void add_nodes(const TopologyCells& cells, const NodeValues& values, CellKind kind) {
    for (std::size_t n = 0; n < values.nodes.size(); ++n) {
      add(values.nodes[n], 0.0, cells.cell_size, kind, values.values[n]);
      is_changed_node.push_back(holds(cells.changed_nodes, values.nodes[n]) ? 1 : 0);
      for (auto& column : is_of_kind) column.push_back(0);
    }
  }
};

}  // namespace

void write_cells_vdb(const std::string& path, const TopologyCells& cells) {
  openvdb::initialize();
  const auto at_cells = transform_of(cells, 0.5);
  const auto at_nodes = transform_of(cells, 0.0);
  openvdb::GridCPtrVec grids;
  for (const NamedCells& kind : kinds_of(cells)) grids.push_back(mask_of(kind, at_cells));
  grids.push_back(mask_of({"changed_nodes", &cells.changed_nodes}, at_nodes));
  grids.push_back(psi_grid("psi_fixed", cells.fixed, at_nodes));
  grids.push_back(psi_grid("psi_unknown", cells.unknown, at_nodes));
  write_file_whole(path, vdb_bytes(grids));
}

void write_cells_vtp(const std::string& path, const TopologyCells& cells) {
  const Points points(cells);
  const auto count = static_cast<std::int64_t>(points.kinds.size());
  std::string piece = fmt::format("<Piece NumberOfPoints=\"{}\" NumberOfVerts=\"{}\">\n", count, count);
  piece += "<PointData Scalars=\"kind\">\n";
  append_vtp_array(piece, "UInt8", "kind", 1, points.kinds);
  const auto named = kinds_of(cells);
  for (std::size_t k = 0; k < named.size(); ++k) {
    append_vtp_array(piece, "UInt8", named[k].name, 1, points.is_of_kind[k]);
  }
  append_vtp_array(piece, "UInt8", "changed_nodes", 1, points.is_changed_node);
  append_vtp_array(piece, "Float32", "psi", 1, points.psi);
  piece += "</PointData>\n<Points>\n";
  append_vtp_array(piece, "Float32", "Points", 3, points.places);
  piece += "</Points>\n";
  std::vector<std::int64_t> numbers, ends;
  for (std::int64_t n = 0; n < count; ++n) {
    numbers.push_back(n);
    ends.push_back(n + 1);
  }
  piece += "<Verts>\n";
  append_vtp_array(piece, "Int64", "connectivity", 1, numbers);
  append_vtp_array(piece, "Int64", "offsets", 1, ends);
  piece += "</Verts>\n</Piece>\n";
  write_file_whole(path, vtp_file(piece));
}

CellFiles::CellFiles(std::string folder) : folder_(std::move(folder)) {
  make_sequence_folder(folder_);
}

void CellFiles::write(const TopologyCells& cells, std::uint64_t frame) const {
  const std::string path = (std::filesystem::path(folder_) / fmt::format("cells_{:06}", frame)).string();
  write_cells_vdb(path + ".vdb", cells);
  write_cells_vtp(path + ".vtp", cells);
}

}  // namespace particle_surface_tracker
