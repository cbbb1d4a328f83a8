#include "bag_index.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"
#include "particle_surface_tracker/ros/time_conversion.h"

namespace particle_surface_tracker {
namespace {

// Times in bags are two 32-bit numbers, seconds and nanoseconds, the seconds first.
std::int64_t nanoseconds_of(std::uint64_t packed) {
  ros::Time time;
  time.sec = static_cast<std::uint32_t>(packed);
  time.nsec = static_cast<std::uint32_t>(packed >> 32);
  return to_nanoseconds(time);
}

class IndexBuilder {
 public:
  explicit IndexBuilder(const ByteSource& file) : file_(file) {}

  BagIndex build() {
    std::uint64_t position = check_start();
    while (position < file_.size()) position = take_record(position);
    if (index_.chunks.size() < promised_chunks_) {
      index_.damage.push_back(
          fmt::format("the bag has {} of the {} chunks it should have", index_.chunks.size(), promised_chunks_));
    }
    for (std::size_t chunk = 0; chunk < index_.chunks.size(); ++chunk) {
      if (is_indexed(chunk)) {
        index_.messages.insert(index_.messages.end(), indexed_[chunk].begin(), indexed_[chunk].end());
      } else {
        walk_chunk(chunk);
      }
    }
    return std::move(index_);
  }

 private:
  std::uint64_t check_start() const {
    const std::string wanted = "#ROSBAG V2.0\n";
    std::string found(std::min<std::uint64_t>(wanted.size(), file_.size()), '\0');
    file_.read(0, found.size(), found.data());
    if (found == wanted) return wanted.size();
    if (found.rfind("#ROSBAG V", 0) == 0 || found.rfind("#ROSRECORD V", 0) == 0) {
      throw InputError("the bag has an old format, wanted 2.0; convert it with 'rosbag fix'");
    }
    throw InputError("not a bag: it does not begin with '#ROSBAG V2.0'");
  }

  // Takes in the record at a position.
  // Returns where the next one begins.
  std::uint64_t take_record(std::uint64_t position) {
    const auto record = read_record(file_, position);
    if (!record) return skip_damage(position);
    const bool whole = file_.has(record->data_begin, record->data_size);
    if (record->op == BagOp::kChunk) return take_chunk(*record, whole);
    if (!whole) {
      // A length that was damaged swallows the chunks after it; a file that was cut has none.
      return skip_damage(position);
    }
    switch (record->op) {
      case BagOp::kBagHeader:
        take_bag_header(*record);
        break;
      case BagOp::kConnection:
        take_connection(file_, *record);
        break;
      case BagOp::kIndexData:
        take_index_data(*record);
        break;
      case BagOp::kMessage:
        take_message(*record, BagMessage::outside, position);
        break;
      default:
        break;
    }
    return record->data_end();
  }

  std::uint64_t skip_damage(std::uint64_t position) {
    const std::uint64_t next = find_next_chunk(file_, position);
    index_.damage.push_back(next == file_.size()
                                ? fmt::format("the bag cannot be read from byte {} to its end at {}", position, next)
                                : fmt::format("the bag cannot be read from byte {} to byte {}", position, next));
    return next;
  }

  void take_bag_header(const BagRecord& record) {
    const std::string encryptor = record.fields.text("encryptor").value_or("");
    if (!encryptor.empty() && encryptor != "rosbag/NoEncryptor") {
      throw InputError(fmt::format("the bag is encrypted ({}); decrypt it with 'rosbag decrypt'", encryptor));
    }
    if (record.fields.number<std::uint64_t>("index_pos").value_or(0) == 0) {
      index_.damage.push_back("the bag was never closed: its end may be missing");
    }
    promised_chunks_ = record.fields.number<std::uint32_t>("chunk_count").value_or(0);
  }

  std::uint64_t take_chunk(const BagRecord& record, bool whole) {
    const std::string compression = record.fields.text("compression").value_or("");
    // A recorder fills in the length when the chunk is complete; until then it is 0.
    if (whole && record.data_size != 0) {
      index_.chunks.push_back(
          {record.data_begin, record.data_size, record.fields.number<std::uint32_t>("size").value_or(0), compression});
      indexed_.emplace_back();
      return record.data_end();
    }
    if (compression == "none") {
      index_.damage.push_back(fmt::format("the chunk at byte {} of the bag is not complete", record.data_begin));
      return record.data_begin;  // Its messages can be read one by one, as if they were outside of any chunk.
    }
    return skip_damage(record.data_begin);
  }

  bool take_connection(const ByteSource& source, const BagRecord& record) {
    const auto id = record.fields.number<std::uint32_t>("conn");
    const auto topic = record.fields.text("topic");
    std::string data(record.data_size, '\0');
    if (!id || !topic || !source.read(record.data_begin, data.size(), data.data())) return false;
    const auto fields = BagFields::parse(data);
    if (!fields) return false;
    const BagConnection connection{*topic, fields->text("type").value_or(""), fields->text("md5sum").value_or("")};
    index_.connections.emplace(*id, connection);
    return true;
  }

  void take_index_data(const BagRecord& record) {
    struct Entry {
      std::uint32_t sec, nsec, position;
    };
    const auto connection = record.fields.number<std::uint32_t>("conn");
    const auto count = record.fields.number<std::uint32_t>("count");
    if (!connection || !count || std::uint64_t{*count} * sizeof(Entry) != record.data_size || indexed_.empty()) return;
    std::vector<Entry> entries(*count);
    if (!file_.read(record.data_begin, record.data_size, entries.data())) return;
    for (const Entry& entry : entries) {
      const std::uint64_t packed = std::uint64_t{entry.nsec} << 32 | entry.sec;
      indexed_.back().push_back({nanoseconds_of(packed), *connection, indexed_.size() - 1, entry.position});
    }
  }

  void take_message(const BagRecord& record, std::size_t chunk, std::uint64_t position) {
    const auto connection = record.fields.number<std::uint32_t>("conn");
    const auto time = message_time(record);
    if (connection && time) index_.messages.push_back({*time, *connection, chunk, position});
  }

  bool is_indexed(std::size_t chunk) const {
    return !indexed_[chunk].empty() &&
           std::all_of(indexed_[chunk].begin(), indexed_[chunk].end(),
                       [this](const BagMessage& message) { return index_.connections.count(message.connection) != 0; });
  }

  void walk_chunk(std::size_t chunk) {
    try {
      const MemoryBytes bytes = read_chunk(file_, index_.chunks[chunk]);
      std::uint64_t position = 0;
      while (position < bytes.size()) {
        const auto record = read_record(bytes, position);
        if (!record || !bytes.has(record->data_begin, record->data_size)) {
          throw InputError(fmt::format("the chunk at byte {} of the bag is damaged: no record begins at its byte {}",
                                       index_.chunks[chunk].data_begin, position));
        }
        if (record->op == BagOp::kConnection) take_connection(bytes, *record);
        if (record->op == BagOp::kMessage) take_message(*record, chunk, position);
        position = record->data_end();
      }
    } catch (const InputError& error) {
      index_.damage.push_back(error.what());
    }
  }

  const ByteSource& file_;
  BagIndex index_;
  std::size_t promised_chunks_ = 0;               // By the header of the bag.
  std::vector<std::vector<BagMessage>> indexed_;  // Per chunk: what the bag's own index says it holds.
};

}  // namespace

BagIndex read_bag_index(const ByteSource& file) {
  return IndexBuilder(file).build();
}

std::optional<std::int64_t> message_time(const BagRecord& record) {
  const auto packed = record.fields.number<std::uint64_t>("time");
  if (record.op != BagOp::kMessage || !packed) return std::nullopt;
  return nanoseconds_of(*packed);
}

}  // namespace particle_surface_tracker
