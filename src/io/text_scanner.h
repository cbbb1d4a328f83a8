#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>
#include <type_traits>

#include <fmt/format.h>

#include "particle_surface_tracker/core/error.h"

namespace particle_surface_tracker {

/// Takes words and numbers from a text, one after the other. Numbers are rounded to the nearest float, whatever the
/// locale says.
class TextScanner {
 public:
  /// `comment` starts a comment that goes to the end of its line ('\0': there are none).
  explicit TextScanner(std::string_view text, char comment = '\0') : text_(text), comment_(comment) {}

  /// The next word; empty at the end of the text.
  std::string_view word() {
    skip_space();
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }

  /// The next word as a number. `what` says what should be there.
  /// \throw InputError if there is none.
  template <typename Number>
  Number number(std::string_view what) {
    return to_number<Number>(word(), what);
  }

  bool at_end() {
    skip_space();
    return at_ == text_.size();
  }

  /// What is left of the line, without its end; the scanner goes to the next line.
  std::string_view rest_of_line() {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    if (comment_ != '\0') line = line.substr(0, line.find(comment_));
    return line;
  }

  std::size_t remaining() const { return text_.size() - at_; }

  /// \throw InputError if the word is not a number of that kind.
  template <typename Number>
  static Number to_number(std::string_view word, std::string_view what) {
    if (word.empty()) throw InputError(fmt::format("it ends early: no {}", what));
    std::string_view digits = word;
    if (digits.size() > 1 && digits.front() == '+') digits.remove_prefix(1);
    Number value{};
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    const bool is_whole = end == digits.data() + digits.size();
    if (is_whole && error == std::errc()) return value;
    if (is_whole && error == std::errc::result_out_of_range) return out_of_range<Number>(digits, what);
    throw InputError(fmt::format("'{}' is not a number where {} should be", word.substr(0, 40), what));
  }

 private:
  static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

  /// Numbers closer to 0 than any float are 0; numbers beyond the largest are an error.
  template <typename Number>
  static Number out_of_range(std::string_view digits, std::string_view what) {
    if constexpr (std::is_floating_point_v<Number>) {
      const double value = std::strtod(std::string(digits).c_str(), nullptr);
      if (std::abs(value) < 1.0) return static_cast<Number>(value);
    }
    throw InputError(fmt::format("'{}' is out of range where {} should be", digits.substr(0, 40), what));
  }

  void skip_space() {
    while (at_ < text_.size()) {
      if (comment_ != '\0' && text_[at_] == comment_) {
        at_ = std::min(text_.find('\n', at_), text_.size());
      } else if (is_space(text_[at_])) {
        ++at_;
      } else {
        return;
      }
    }
  }

  std::string_view text_;
  char comment_;
  std::size_t at_ = 0;
};

}  // namespace particle_surface_tracker
