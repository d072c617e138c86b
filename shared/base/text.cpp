#include "shared/base/text.h"

#include <algorithm>
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

/// Zero-width joiners and variation selectors: they shape the character before them, in Persian as in emoji.
bool shapes(uint32_t code) {
  return code == 0x200C || code == 0x200D || (code >= 0xFE00 && code <= 0xFE0F);
}

struct Range {
  uint32_t first;
  uint32_t last;
};

/// Unicode's property Default_Ignorable_Code_Point, without what sets the direction and what shapes().
constexpr Range invisible[] = {{0xAD, 0xAD},       {0x34F, 0x34F},    {0x115F, 0x1160}, {0x17B4, 0x17B5},
                               {0x180B, 0x180F},   {0x200B, 0x200B},  {0x2060, 0x206F}, {0x3164, 0x3164},
                               {0xFEFF, 0xFEFF},   {0xFFA0, 0xFFA0},  {0xFFF0, 0xFFF8}, {0x1BCA0, 0x1BCA3},
                               {0x1D173, 0x1D17A}, {0xE0000, 0xE0FFF}};

bool is_invisible(uint32_t code) {
  return std::ranges::any_of(invisible, [&](const Range& r) { return r.first <= code && code <= r.last; });
}

/// What is wrong with a character after another one (0: none); null: nothing.
const char* fault_of(const Character& next, uint32_t before) {
  if (next.bytes == 0) return "is not UTF-8";
  if (is_control(next.code)) return "holds control characters";
  if (sets_direction(next.code)) return "holds characters that set its direction";
  const bool has_none_to_shape = before == 0 || before == ' ';
  if (is_invisible(next.code) || (shapes(next.code) && has_none_to_shape))
    return "holds invisible characters";
  return nullptr;
}

}  // namespace

std::optional<std::string_view> fault_of_text(std::string_view text) {
  uint32_t before = 0;
  while (!text.empty()) {
    const Character next = first_of(text);
    if (const char* fault = fault_of(next, before)) return fault;
    before = next.code;
    text.remove_prefix(next.bytes);
  }
  return std::nullopt;
}

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const size_t bytes = first_of(text).bytes;
    if (bytes == 0) return false;
    text.remove_prefix(bytes);
  }
  return true;
}

std::string showable(std::string_view text, size_t bytes_max) {
  std::string shown;
  uint32_t before = 0;
  while (!text.empty()) {
    const Character next = first_of(text);
    const bool replaced = fault_of(next, before) != nullptr;
    const std::string_view instead = next.bytes == 0 ? "?" : " ";
    const std::string_view add = replaced ? instead : text.substr(0, next.bytes);
    if (shown.size() + add.size() > bytes_max) break;
    shown += add;
    before = replaced ? static_cast<uint32_t>(instead.front()) : next.code;
    text.remove_prefix(next.bytes == 0 ? 1 : next.bytes);
  }
  CHECK(shown.size() <= bytes_max && !fault_of_text(shown));
  return shown;
}

std::string endpoint_text(std::string_view host, uint16_t port) {
  if (port == 0) return std::string(host);
  const bool is_v6 = std::ranges::count(host, ':') > 1 && !host.starts_with('[');
  std::string text(is_v6 ? "[" : "");
  text.append(host).append(is_v6 ? "]:" : ":").append(std::to_string(port));
  return text;
}

}  // namespace scree
