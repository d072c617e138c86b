#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "client/admin/admin.h"
#include "shared/base/text.h"

namespace scree {

namespace {

/// Printable ASCII stays; a backslash is written twice, so that no line looks like an escaped one.
std::string escaped(std::string_view line) {
  std::string text;
  for (const char byte : line) {
    const auto code = static_cast<unsigned char>(byte);
    std::array<char, 5> hex{};
    std::snprintf(hex.data(), hex.size(), "\\x%02x", code);
    if (byte == '\t')
      text += "\\t";
    else if (byte == '\\')
      text += "\\\\";
    else
      text += code >= 0x20 && code < 0x7F ? std::string(1, byte) : hex.data();
  }
  return text;
}

}  // namespace

std::string rules_lines(const std::string& text) {
  std::string lines;
  for (size_t from = 0; from < text.size();) {
    const size_t end = std::min(text.find('\n', from), text.size());
    const std::string_view line = std::string_view(text).substr(from, end - from);
    lines += fault_of_text(line) ? escaped(line) : std::string(line);
    lines += '\n';
    from = end + 1;
  }
  return lines;
}

std::string rules_json(const std::string& text) {
  const nlohmann::ordered_json json{{"text", text}};
  return json.dump(2, ' ', true, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace scree
