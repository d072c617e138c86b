#include "shared/base/text.h"

#include <cstdint>

#include "shared/base/check.h"

namespace scree {

namespace {

struct Character {
  uint32_t code = 0;
  size_t bytes = 0;  ///< 0: no UTF-8
};

/// The first character of a text that is not empty (RFC 3629: shortest form, no surrogates, at most
/// U+10FFFF).
Character first_of(std::string_view text) {
  const auto byte = [&](size_t i) { return static_cast<uint8_t>(text[i]); };
  if (byte(0) < 0x80) return {byte(0), 1};
  const size_t bytes = byte(0) >= 0xF0 ? 4 : byte(0) >= 0xE0 ? 3 : 2;
  if (byte(0) < 0xC2 || byte(0) > 0xF4 || text.size() < bytes) return {};
  uint32_t code = byte(0) & (0x7FU >> bytes);
  for (size_t i = 1; i < bytes; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6U | (byte(i) & 0x3FU);
  }
  constexpr uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
  if (code < least[bytes] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return {};
  return {code, bytes};
}

bool is_control(uint32_t code) {
  return code < 0x20 || (code >= 0x7F && code < 0xA0) || code == 0x2028 || code == 0x2029;
}

/// Unicode's property Bidi_Control.
bool sets_direction(uint32_t code) {
  return code == 0x061C || code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
         (code >= 0x2066 && code <= 0x2069);
}

}  // namespace

std::optional<std::string_view> fault_of_text(std::string_view text) {
  while (!text.empty()) {
    const Character next = first_of(text);
    if (next.bytes == 0) return "is not UTF-8";
    if (is_control(next.code)) return "holds control characters";
    if (sets_direction(next.code)) return "holds characters that set its direction";
    text.remove_prefix(next.bytes);
  }
  return std::nullopt;
}

std::string showable(std::string_view text, size_t bytes_max) {
  std::string shown;
  while (!text.empty()) {
    const Character next = first_of(text);
    const bool hidden = next.bytes != 0 && (is_control(next.code) || sets_direction(next.code));
    const std::string_view add = next.bytes == 0 ? "?" : hidden ? " " : text.substr(0, next.bytes);
    if (shown.size() + add.size() > bytes_max) break;
    shown += add;
    text.remove_prefix(next.bytes == 0 ? 1 : next.bytes);
  }
  CHECK(shown.size() <= bytes_max && !fault_of_text(shown));
  return shown;
}

}  // namespace scree
