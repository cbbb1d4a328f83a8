#include "particle_surface_tracker/io/checkpoint.h"

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <gtest/gtest.h>
#include <zlib.h>

#include "particle_surface_tracker/core/error.h"
#include "support/shapes.h"
#include "support/temporary_folder.h"

namespace particle_surface_tracker {
namespace {

using test::TemporaryFolder;

constexpr double r = 0.1;

/// What a tracker might leave behind: small, with something in every field.
Checkpoint example() {
  Checkpoint checkpoint;
  checkpoint.tracker.parameters.particle_spacing = r;
  checkpoint.tracker.parameters.tau = 0.1 + 0.2;  // No short decimal number.
  checkpoint.tracker.parameters.topology = TopologyMode::kKeep;
  TrackedFrame& frame = checkpoint.tracker.frame;
  const TriangleMesh box = test::make_box(Vec3d::Zero(), Vec3d::Constant(2 * r));
  std::vector<std::uint32_t> ids;
  for (std::uint32_t v = 0; v < box.vertex_count(); ++v) ids.push_back(3 * v + 1);
  frame.mesh = TriangleMesh(box.positions(), box.triangles(), ids);
  frame.mesh.reserve_ids(100);
  VertexAttributes& attributes = frame.mesh.attributes();
  attributes.add(TriangleMesh::color_name, 4, {1.0F, 0.5F, 0.25F, 1.0F});
  attributes.add("memory", 1, {2.0F}, AttributeUse::kInternal);
  for (std::size_t n = 0; n < attributes.count(); ++n) {
    for (std::size_t i = 0; i < attributes[n].values.size(); ++i) {
      attributes[n].values[i] += 0.01F * static_cast<float>(i + n);
    }
  }
  frame.particles = test::fill_with_particles(Vec3d::Zero(), Vec3d::Constant(2 * r), r, 0.1, 5,
                                              [](const Vec3d& x) { return x.minCoeff() > 0 && x.maxCoeff() < 2 * r; });
  frame.particles.stamp_ns = -1234567890123456789;
  frame.particles.velocities.assign(frame.particles.size(), Vec3f(0.5F, -0.0F, 1e-30F));
  frame.particles_frame = 41;
  frame.detection.flagged_vertices = {0, 5};
  frame.detection.flagged_cells = {openvdb::Coord(-1, 2, -3), openvdb::Coord(4, 5, 6)};
  frame.detection.unreached_vertices = 1;
  frame.band = 0.3 * r;
  frame.original_vertices = 99;
  checkpoint.sections = {{"empty", ""}, {"run", std::string("\0\n\xff", 3)}};
  return checkpoint;
}

std::string content_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::string bytes_of(const Checkpoint& checkpoint) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "a", checkpoint);
  return content_of(folder / "a");
}

/// Why these bytes are refused; empty if they are not. Whatever else is thrown ends the test.
std::string refusal(const TemporaryFolder& folder, const std::string& bytes) {
  try {
    read_checkpoint(folder.write("a", bytes));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

/// The bytes with a checksum that agrees with them.
std::string with_checksum(std::string bytes) {
  constexpr std::size_t head = 8 + 4 + 8;
  uLong sum = ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes.data()), head);
  sum = ::crc32_z(sum, reinterpret_cast<const Bytef*>(bytes.data()) + head + 4, bytes.size() - head - 4);
  for (std::size_t n = 0; n < 4; ++n) bytes[head + n] = static_cast<char>(sum >> 8 * n);
  return bytes;
}

TEST(Checkpoint, ComesBackAsItWas) {
  const TemporaryFolder folder;
  const Checkpoint before = example();
  write_checkpoint(folder / "a", before);
  const Checkpoint after = read_checkpoint(folder / "a");
  for (const ParameterInfo& info : parameter_table()) {
    EXPECT_EQ(get_parameter(after.tracker.parameters, info.name), get_parameter(before.tracker.parameters, info.name));
  }
  EXPECT_EQ(after.tracker.parameters.tau, before.tracker.parameters.tau);
  const TrackedFrame& was = before.tracker.frame;
  const TrackedFrame& is = after.tracker.frame;
  EXPECT_EQ(is.mesh.positions(), was.mesh.positions());
  EXPECT_EQ(is.mesh.triangles(), was.mesh.triangles());
  EXPECT_EQ(is.mesh.ids(), was.mesh.ids());
  EXPECT_EQ(is.mesh.next_id(), 100u);
  ASSERT_EQ(is.mesh.attributes().count(), 3u);
  for (std::size_t n = 0; n < 3; ++n) {
    EXPECT_EQ(is.mesh.attributes()[n].name, was.mesh.attributes()[n].name);
    EXPECT_EQ(is.mesh.attributes()[n].use, was.mesh.attributes()[n].use);
    EXPECT_EQ(is.mesh.attributes()[n].initial_value, was.mesh.attributes()[n].initial_value);
    EXPECT_EQ(is.mesh.attributes()[n].values, was.mesh.attributes()[n].values);
  }
  EXPECT_EQ(is.particles.stamp_ns, was.particles.stamp_ns);
  EXPECT_EQ(is.particles.positions, was.particles.positions);
  EXPECT_EQ(is.particles.ids, was.particles.ids);
  EXPECT_EQ(is.particles.velocities, was.particles.velocities);
  EXPECT_TRUE(std::signbit(is.particles.velocities[0].y()));
  EXPECT_EQ(is.particles_frame, 41u);
  EXPECT_EQ(is.detection.flagged_vertices, was.detection.flagged_vertices);
  EXPECT_EQ(is.detection.flagged_cells, was.detection.flagged_cells);
  EXPECT_EQ(is.detection.unreached_vertices, 1u);
  EXPECT_EQ(is.band, was.band);
  EXPECT_EQ(is.original_vertices, 99u);
  EXPECT_EQ(after.sections, before.sections);
  EXPECT_EQ(bytes_of(after), bytes_of(before));
}

TEST(Checkpoint, EveryFlippedByteIsRefused) {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(example());
  ASSERT_EQ(refusal(folder, bytes), "");
  for (std::size_t n = 0; n < bytes.size(); ++n) {
    for (const int flip : {0x01, 0x80, 0xff}) {
      std::string damaged = bytes;
      damaged[n] = static_cast<char>(damaged[n] ^ flip);
      ASSERT_NE(refusal(folder, damaged), "") << "byte " << n << " flipped by " << flip;
    }
  }
}

TEST(Checkpoint, EveryCutAndEveryAppendedByteIsRefused) {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(example());
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    ASSERT_NE(refusal(folder, bytes.substr(0, size)), "") << size << " of " << bytes.size() << " bytes";
  }
  EXPECT_NE(refusal(folder, bytes + '\0'), "");
}

// A checksum that agrees must not open the door: what is in the file is not believed either.
TEST(Checkpoint, DamageWithARightChecksumNeverCrashes) {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(example());
  constexpr std::size_t body = 8 + 4 + 8 + 4;
  std::size_t refused = 0;
  for (std::size_t n = body; n < bytes.size(); ++n) {
    std::string damaged = bytes;
    damaged[n] = static_cast<char>(damaged[n] ^ 0xff);
    if (!refusal(folder, with_checksum(damaged)).empty()) ++refused;
  }
  // Most of the rest are numbers that could as well be others.
  EXPECT_GT(refused, (bytes.size() - body) / 4);
  std::mt19937 random(7);
  for (int n = 0; n < 2000; ++n) {
    std::string damaged = bytes;
    for (int k = 0; k < 3; ++k) {
      damaged[body + random() % (bytes.size() - body)] = static_cast<char>(random());
    }
    refusal(folder, with_checksum(damaged));
  }
}

TEST(Checkpoint, SaysWhatIsWrong) {
  const TemporaryFolder folder;
  const std::string bytes = bytes_of(example());
  const auto says = [&](const std::string& damaged, const std::string& word) {
    const std::string text = refusal(folder, damaged);
    EXPECT_NE(text.find(word), std::string::npos) << text;
    EXPECT_NE(text.find(folder / "a"), std::string::npos) << text;
  };
  says("", "no checkpoint");
  says("ply\nformat ascii 1.0\n", "no checkpoint");
  std::string newer = bytes;
  newer[8] = 3;
  says(newer, "version 3");
  says(with_checksum(newer), "version 3");
  says(bytes.substr(0, bytes.size() - 1), "damaged");
  std::string flipped = bytes;
  flipped.back() = static_cast<char>(flipped.back() ^ 1);
  says(flipped, "checksum");
  EXPECT_THROW(read_checkpoint(folder / "missing"), InputError);
  EXPECT_THROW(read_checkpoint(folder.path().string()), InputError);

  Checkpoint open = example();
  std::vector<Triangle> triangles = open.tracker.frame.mesh.triangles();
  triangles.pop_back();
  open.tracker.frame.mesh.set_triangles(triangles);
  says(bytes_of(open), "closed");
  Checkpoint wrong = example();
  wrong.tracker.frame.detection.flagged_vertices = {5, 0};
  says(bytes_of(wrong), "flagged");
  wrong = example();
  wrong.tracker.frame.band = -1.0;
  says(bytes_of(wrong), "distance");
  wrong = example();
  wrong.tracker.frame.original_vertices = 101;
  says(bytes_of(wrong), "101");
  wrong = example();
  std::swap(wrong.tracker.frame.particles.ids[0], wrong.tracker.frame.particles.ids[1]);
  says(bytes_of(wrong), "order");
}

TEST(Checkpoint, ParametersOfAnotherVersionAreNamed) {
  const TemporaryFolder folder;
  std::string bytes = bytes_of(example());
  const std::size_t at = bytes.find("max_reach");
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at, 9, "max_peach");
  const std::string text = refusal(folder, with_checksum(bytes));
  EXPECT_NE(text.find("max_peach"), std::string::npos) << text;
}

TEST(Checkpoint, WhatCannotBeWrittenLeavesTheOldOne) {
  const TemporaryFolder folder;
  write_checkpoint(folder / "a", example());
  const std::string before = content_of(folder / "a");
  std::filesystem::create_directory(folder / "a.part");
  EXPECT_THROW(write_checkpoint(folder / "a", Checkpoint()), OutputError);
  EXPECT_EQ(content_of(folder / "a"), before);
  EXPECT_THROW(write_checkpoint(folder / "missing/a", example()), OutputError);
  EXPECT_THROW(write_checkpoint(folder.path().string(), example()), OutputError);
}

}  // namespace
}  // namespace particle_surface_tracker
