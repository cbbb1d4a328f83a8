#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <optional>
#include <string>

#include "byte_source.h"

namespace particle_surface_tracker {

/// Kinds of records of the bag format 2.0.
enum class BagOp : std::uint8_t {
  kMessage = 2,
  kBagHeader = 3,
  kIndexData = 4,
  kChunk = 5,
  kChunkInfo = 6,
  kConnection = 7
};

/// Named values: the header of a record, and the data of a connection record.
class BagFields {
 public:
  /// \return nothing if the bytes are not a list of named values.
  static std::optional<BagFields> parse(const std::string& bytes);

  std::optional<std::string> text(const std::string& name) const;

  /// \return nothing if there is no such value or its size is another.
  template <typename Number>
  std::optional<Number> number(const std::string& name) const {
    const auto found = values_.find(name);
    if (found == values_.end() || found->second.size() != sizeof(Number)) return std::nullopt;
    Number number;
    std::memcpy(&number, found->second.data(), sizeof number);
    return number;
  }

 private:
  std::map<std::string, std::string> values_;
};

/// One record: its header, and where its data is.
struct BagRecord {
  BagOp op;
  BagFields fields;
  std::uint64_t data_begin = 0;
  std::uint32_t data_size = 0;

  std::uint64_t data_end() const { return data_begin + data_size; }
};

/// Reads the record that begins at a position. Its data may reach beyond the end of the source.
/// \return nothing if no record begins there.
std::optional<BagRecord> read_record(const ByteSource& source, std::uint64_t position);

/// The first position after `position` at which a chunk record seems to begin, or the end of the source.
std::uint64_t find_next_chunk(const ByteSource& source, std::uint64_t position);

}  // namespace particle_surface_tracker
