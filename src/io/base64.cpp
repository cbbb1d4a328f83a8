#include "base64.h"

#include <cstddef>
#include <cstdint>

namespace particle_surface_tracker {

void append_base64(std::string& text, std::string_view bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t begin = text.size();
  text.resize(begin + 4 * ((bytes.size() + 2) / 3), '=');
  char* out = text.data() + begin;
  // Of a last group with fewer than three bytes the digits without any of their bits stay '='.
  for (std::size_t at = 0; at < bytes.size(); at += 3, out += 4) {
    const auto byte = [&](std::size_t i) -> std::uint32_t {
      return at + i < bytes.size() ? static_cast<std::uint8_t>(bytes[at + i]) : 0;
    };
    const std::uint32_t bits = byte(0) << 16 | byte(1) << 8 | byte(2);
    out[0] = digits[bits >> 18];
    out[1] = digits[bits >> 12 & 63];
    if (at + 1 < bytes.size()) out[2] = digits[bits >> 6 & 63];
    if (at + 2 < bytes.size()) out[3] = digits[bits & 63];
  }
}

}  // namespace particle_surface_tracker
