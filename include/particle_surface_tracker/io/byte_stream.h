#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

static_assert(std::numeric_limits<float>::is_iec559 && std::numeric_limits<double>::is_iec559,
              "stored numbers are IEEE 754");

/// Puts numbers, texts and arrays one after the other, little-endian, every length before what it counts.
class ByteWriter {
 public:
  template <typename Number>
  void put(Number value) {
    static_assert(std::is_arithmetic_v<Number>);
    if constexpr (std::is_floating_point_v<Number>) {
      std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t> bits;
      static_assert(sizeof(bits) == sizeof(value));
      std::memcpy(&bits, &value, sizeof(bits));
      put(bits);
    } else {
      const auto bits = static_cast<std::uint64_t>(value);
      char bytes[sizeof(Number)];
      for (std::size_t n = 0; n < sizeof(Number); ++n) bytes[n] = static_cast<char>(bits >> 8 * n);
      bytes_.append(bytes, sizeof(Number));
    }
  }

  void put(std::string_view text) {
    put(static_cast<std::uint64_t>(text.size()));
    bytes_ += text;
  }

  /// The numbers of an array, or of an array of triples.
  template <typename Value>
  void put(const std::vector<Value>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    for (const Value& value : values) {
      if constexpr (std::is_arithmetic_v<Value>) {
        put(value);
      } else {
        for (int k = 0; k < 3; ++k) put(value[k]);
      }
    }
  }

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Takes back what a ByteWriter has put. Nothing is believed: a length is compared with what is left before any memory
/// is asked for.
class ByteReader {
 public:
  /// \param bytes outlive this object.
  explicit ByteReader(std::string_view bytes) : rest_(bytes) {}

  /// \param what names the number, for the error.
  /// \throw InputError if too little is left.
  template <typename Number>
  Number number(const char* what) {
    static_assert(std::is_arithmetic_v<Number>);
    const std::string_view bytes = take(sizeof(Number), what);
    std::uint64_t bits = 0;
    for (std::size_t n = 0; n < sizeof(Number); ++n) {
      bits |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[n])) << 8 * n;
    }
    if constexpr (std::is_floating_point_v<Number>) {
      const auto narrow = static_cast<std::conditional_t<sizeof(Number) == 4, std::uint32_t, std::uint64_t>>(bits);
      Number value;
      std::memcpy(&value, &narrow, sizeof(value));
      return value;
    } else {
      return static_cast<Number>(bits);
    }
  }

  /// \throw InputError if too little is left.
  std::string text(const char* what) { return std::string(take(length(1, what), what)); }

  /// An array of numbers.
  /// \throw InputError if too little is left.
  template <typename Number>
  std::vector<Number> numbers(const char* what) {
    std::vector<Number> values(length(sizeof(Number), what));
    for (Number& value : values) value = number<Number>(what);
    return values;
  }

  /// An array of triples of numbers.
  /// \throw InputError if too little is left.
  template <typename Triple, typename Number>
  std::vector<Triple> triples(const char* what) {
    std::vector<Triple> values(length(3 * sizeof(Number), what));
    for (Triple& value : values) {
      for (int k = 0; k < 3; ++k) value[k] = number<Number>(what);
    }
    return values;
  }

  /// How many things follow that take at least so many bytes each.
  /// \throw InputError if there is not room for as many as it says.
  std::size_t length(std::size_t bytes_of_each, const char* what) {
    const auto count = number<std::uint64_t>(what);
    if (count > rest_.size() / bytes_of_each) {
      throw InputError(fmt::format("it names {} of {}, but holds {} more bytes", count, what, rest_.size()));
    }
    return static_cast<std::size_t>(count);
  }

  /// \throw InputError if something is left.
  void expect_end() const {
    if (!rest_.empty()) throw InputError(fmt::format("{} bytes follow after its end", rest_.size()));
  }

 private:
  std::string_view take(std::size_t count, const char* what) {
    if (rest_.size() < count) throw InputError(fmt::format("it ends early: no {}", what));
    const std::string_view taken = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return taken;
  }

  std::string_view rest_;
};

}  // namespace particle_surface_tracker
