#include "bag_record.h"

#include <algorithm>

namespace particle_surface_tracker {
namespace {

// Record headers hold a few numbers and a topic; a longer one is damage.
constexpr std::uint32_t longest_header = 1 << 16;

template <typename Number>
std::optional<Number> read_number(const ByteSource& source, std::uint64_t position) {
  Number number;
  if (!source.read(position, sizeof number, &number)) return std::nullopt;
  return number;
}

bool is_known(std::uint8_t op) {
  return op >= static_cast<std::uint8_t>(BagOp::kMessage) && op <= static_cast<std::uint8_t>(BagOp::kConnection);
}

}  // namespace

std::optional<BagFields> BagFields::parse(const std::string& bytes) {
  BagFields fields;
  std::size_t position = 0;
  while (position < bytes.size()) {
    std::uint32_t length = 0;
    if (bytes.size() - position < sizeof length) return std::nullopt;
    std::memcpy(&length, bytes.data() + position, sizeof length);
    position += sizeof length;
    if (length > bytes.size() - position) return std::nullopt;
    const std::string field = bytes.substr(position, length);
    const std::size_t equals = field.find('=');
    if (equals == std::string::npos) return std::nullopt;
    fields.values_[field.substr(0, equals)] = field.substr(equals + 1);
    position += length;
  }
  return fields;
}

std::optional<std::string> BagFields::text(const std::string& name) const {
  const auto found = values_.find(name);
  if (found == values_.end()) return std::nullopt;
  return found->second;
}

std::optional<BagRecord> read_record(const ByteSource& source, std::uint64_t position) {
  const auto header_size = read_number<std::uint32_t>(source, position);
  if (!header_size || *header_size > longest_header) return std::nullopt;
  position += sizeof *header_size;
  std::string header(*header_size, '\0');
  if (!source.read(position, header.size(), header.data())) return std::nullopt;
  position += header.size();

  const auto fields = BagFields::parse(header);
  const auto data_size = read_number<std::uint32_t>(source, position);
  if (!fields || !data_size) return std::nullopt;
  const auto op = fields->number<std::uint8_t>("op");
  if (!op || !is_known(*op)) return std::nullopt;
  return BagRecord{static_cast<BagOp>(*op), *fields, position + sizeof *data_size, *data_size};
}

std::uint64_t find_next_chunk(const ByteSource& source, std::uint64_t position) {
  // The header of a chunk begins with its own length and that of its first field, which is this one.
  const std::string mark = "compression=";
  constexpr std::uint64_t before_mark = 8;
  constexpr std::uint64_t block_size = 1 << 20;
  std::string block;
  for (std::uint64_t begin = position + 1 + before_mark; begin < source.size(); begin += block_size) {
    block.resize(std::min(block_size + mark.size() - 1, source.size() - begin));
    if (!source.read(begin, block.size(), block.data())) return source.size();
    for (std::size_t at = block.find(mark); at != std::string::npos; at = block.find(mark, at + 1)) {
      const std::uint64_t candidate = begin + at - before_mark;
      const auto record = read_record(source, candidate);
      if (record && record->op == BagOp::kChunk) return candidate;
    }
  }
  return source.size();
}

}  // namespace particle_surface_tracker
