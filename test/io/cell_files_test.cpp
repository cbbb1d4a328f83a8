#include "particle_surface_tracker/io/cell_files.h"

#include <openvdb/io/File.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "particle_surface_tracker/core/error.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

using openvdb::Coord;

TopologyCells some_cells() {
  TopologyCells cells;
  cells.cell_size = 0.25;
  cells.flagged = {{0, 0, 0}, {0, 0, 1}};
  cells.complex = {{0, 1, 0}, {0, 1, 1}, {9, 9, 9}};
  cells.tangled = {{0, 1, 0}};
  cells.deep = {{0, 1, 1}};
  cells.marked = {{0, 0, 0}, {0, 0, 1}, {0, 1, 0}, {0, 1, 1}, {0, 2, 0}, {4, 4, 4}};
  cells.front = {{0, 2, 0}};
  cells.changed_nodes = {{5, 5, 5}};
  cells.fixed = {{{-1, 0, 0}, {3, 0, 0}}, {0.5F, -0.125F}};
  cells.unknown = {{{5, 5, 5}}, {0.25F}};
  return cells;
}

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<Coord> cells_in(openvdb::io::File& file, const char* name) {
  const auto grid = openvdb::gridPtrCast<openvdb::MaskGrid>(file.readGrid(name));
  std::vector<Coord> cells;
  for (auto value = grid->cbeginValueOn(); value; ++value) cells.push_back(value.getCoord());
  std::sort(cells.begin(), cells.end());
  return cells;
}

std::string bytes_of_base64(const std::string& text) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  for (std::size_t i = 0; i < text.size() && text[i] != '='; ++i) {
    bits = bits << 6 | static_cast<std::uint32_t>(digits.find(text[i]));
    if (i % 4 != 0) bytes += static_cast<char>(bits >> (6 - 2 * (i % 4)) & 255);
  }
  return bytes;
}

/// An array of a file that write_cells_vtp() wrote.
template <typename Number>
std::vector<Number> array_in(const std::string& content, const std::string& name) {
  std::smatch match;
  const std::regex element("Name=\"" + name + "\"[^>]*format=\"binary\">\n([A-Za-z0-9+/]*=*)\n</DataArray>");
  EXPECT_TRUE(std::regex_search(content, match, element)) << name;
  const std::string bytes = bytes_of_base64(match[1]);
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), sizeof(size));
  EXPECT_EQ(bytes.size(), sizeof(size) + size) << name;
  std::vector<Number> values(size / sizeof(Number));
  if (!values.empty()) std::memcpy(values.data(), bytes.data() + sizeof(size), size);
  return values;
}

TEST(CellFiles, VdbHoldsTheCells) {
  const test::TemporaryFolder folder;
  const TopologyCells cells = some_cells();
  CellFiles(folder / "new").write(cells, 42);
  openvdb::io::File file(folder / "new/cells_000042.vdb");
  file.open();
  EXPECT_EQ(cells_in(file, "flagged"), cells.flagged);
  EXPECT_EQ(cells_in(file, "complex"), cells.complex);
  EXPECT_EQ(cells_in(file, "tangled"), cells.tangled);
  EXPECT_EQ(cells_in(file, "deep"), cells.deep);
  EXPECT_EQ(cells_in(file, "marked"), cells.marked);
  EXPECT_EQ(cells_in(file, "front"), cells.front);
  EXPECT_EQ(cells_in(file, "changed_nodes"), cells.changed_nodes);
  const auto fixed = openvdb::gridPtrCast<openvdb::FloatGrid>(file.readGrid("psi_fixed"));
  EXPECT_EQ(fixed->activeVoxelCount(), 2u);
  EXPECT_EQ(fixed->tree().getValue(Coord(3, 0, 0)), -0.125F);
  EXPECT_EQ(fixed->indexToWorld(Coord(3, 0, 0)), openvdb::Vec3d(0.75, 0.0, 0.0));
  EXPECT_EQ(file.readGrid("marked")->indexToWorld(Coord(4, 4, 4)), openvdb::Vec3d(1.125));
}

TEST(CellFiles, VtpHoldsTheCellsWithTheirKinds) {
  const test::TemporaryFolder folder;
  write_cells_vtp(folder / "a.vtp", some_cells());
  const std::string content = content_of(folder / "a.vtp");
  const std::vector<std::uint8_t> kinds = {1, 1, 2, 3, 5, 4, 6, 7, 7, 8};
  EXPECT_EQ(array_in<std::uint8_t>(content, "kind"), kinds);
  EXPECT_EQ(array_in<std::uint8_t>(content, "marked"), (std::vector<std::uint8_t>{1, 1, 1, 1, 1, 1, 0, 0, 0, 0}));
  EXPECT_EQ(array_in<std::uint8_t>(content, "front"), (std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 0}));
  EXPECT_EQ(array_in<std::uint8_t>(content, "changed_nodes"),
            (std::vector<std::uint8_t>{0, 0, 0, 0, 0, 0, 0, 0, 0, 1}));
  EXPECT_EQ(array_in<float>(content, "psi"), (std::vector<float>{0, 0, 0, 0, 0, 0, 0, 0.5F, -0.125F, 0.25F}));
  const std::vector<float> places = array_in<float>(content, "Points");
  ASSERT_EQ(places.size(), 3 * kinds.size());
  EXPECT_EQ(places[15], 1.125F);  // The middle of cell (4, 4, 4).
  EXPECT_EQ(places[24], 0.75F);   // Node (3, 0, 0).
  EXPECT_EQ(content.find("AppendedData"), std::string::npos);
}

TEST(CellFiles, SameCellsGiveSameBytesAndNoneAreNoError) {
  const test::TemporaryFolder folder;
  write_cells_vdb(folder / "a.vdb", some_cells());
  write_cells_vdb(folder / "b.vdb", some_cells());
  EXPECT_EQ(content_of(folder / "a.vdb"), content_of(folder / "b.vdb"));
  TopologyCells none;
  none.cell_size = 0.25;
  CellFiles(folder.path().string()).write(none, 0);
  EXPECT_TRUE(array_in<std::uint8_t>(content_of(folder / "cells_000000.vtp"), "kind").empty());
}

TEST(CellFiles, FilesThatCannotBeWrittenAreErrors) {
  const test::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THROW(CellFiles(folder / "file"), OutputError);
  EXPECT_THROW(write_cells_vdb(folder / "none/a.vdb", some_cells()), OutputError);
}

}  // namespace
}  // namespace particle_surface_tracker
