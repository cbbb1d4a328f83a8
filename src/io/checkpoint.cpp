#include "particle_surface_tracker/io/checkpoint.h"

#include <cstdint>
#include <string_view>

#include <fmt/format.h>
#include <zlib.h>

#include "file_bytes.h"
#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/io/byte_stream.h"
#include "tracker_state_bytes.h"

namespace particle_surface_tracker {
namespace {

constexpr std::string_view kMagic = "PSTCHKP\n";
constexpr std::uint32_t kVersion = 2;
constexpr std::size_t kHeadSize = kMagic.size() + sizeof(std::uint32_t) + sizeof(std::uint64_t);

std::uint32_t checksum(std::string_view head, std::string_view body) {
  const auto add = [](uLong sum, std::string_view bytes) {
    return ::crc32_z(sum, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
  };
  return static_cast<std::uint32_t>(add(add(::crc32_z(0, nullptr, 0), head), body));
}

void put_sections(ByteWriter& bytes, const std::map<std::string, std::string>& sections) {
  bytes.put(static_cast<std::uint64_t>(sections.size()));
  for (const auto& [name, content] : sections) {
    bytes.put(std::string_view(name));
    bytes.put(std::string_view(content));
  }
}

std::map<std::string, std::string> read_sections(ByteReader& bytes) {
  std::map<std::string, std::string> sections;
  const std::size_t count = bytes.length(2 * sizeof(std::uint64_t), "section");
  for (std::size_t n = 0; n < count; ++n) {
    const std::string name = bytes.text("name of a section");
    if (!sections.emplace(name, bytes.text("section")).second) {
      throw InputError(fmt::format("it has two sections '{}'", name));
    }
  }
  return sections;
}

/// What the head and the checksum say is right.
std::string_view checked_body(std::string_view file) {
  if (file.substr(0, kMagic.size()) != kMagic) throw InputError("it is no checkpoint");
  ByteReader head(file.substr(kMagic.size()));
  const auto version = head.number<std::uint32_t>("version");
  if (version != kVersion) {
    throw InputError(
        fmt::format("it is of version {} of the format, and this program reads version {}; go on with the "
                    "program that wrote it",
                    version, kVersion));
  }
  const auto size = head.number<std::uint64_t>("size");
  const auto sum = head.number<std::uint32_t>("checksum");
  const std::string_view body = file.substr(kHeadSize + sizeof(sum));
  if (body.size() != size) {
    throw InputError(fmt::format("it is damaged: {} bytes should follow its head, and {} do", size, body.size()));
  }
  if (checksum(file.substr(0, kHeadSize), body) != sum) throw InputError("it is damaged: its checksum is wrong");
  return body;
}

Checkpoint parse(std::string_view file) {
  ByteReader body(checked_body(file));
  Checkpoint checkpoint;
  checkpoint.tracker = read_tracker_state(body);
  checkpoint.sections = read_sections(body);
  body.expect_end();
  check_tracker_state(checkpoint.tracker);
  return checkpoint;
}

}  // namespace

void write_checkpoint(const std::string& path, const Checkpoint& checkpoint) {
  ByteWriter body;
  put_tracker_state(body, checkpoint.tracker);
  put_sections(body, checkpoint.sections);
  ByteWriter head;
  head.put(kVersion);
  head.put(static_cast<std::uint64_t>(body.bytes().size()));
  std::string file = std::string(kMagic) + head.bytes();
  ByteWriter sum;
  sum.put(checksum(file, body.bytes()));
  file += sum.bytes();
  file += body.bytes();
  write_file_durably(path, file);
}

Checkpoint read_checkpoint(const std::string& path) {
  const std::string file = read_file(path);
  try {
    return parse(file);
  } catch (const Error& error) {
    throw InputError(fmt::format("cannot use checkpoint '{}': {}", path, error.what()));
  }
}

}  // namespace particle_surface_tracker
