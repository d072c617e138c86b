// What the lines of a TOML file are held to before toml++ parses them. Its version 3.3 has undefined
// behaviour on characters beyond ASCII between words, and nests tables without a limit. Any thread.
#pragma once

#include <string>
#include <string_view>
#include <tl/expected.hpp>

namespace scree {

struct LineFault {
  size_t line = 1;
  std::string words;
};

/// The text with the characters of its comments that are not ASCII replaced, byte by byte, so that lines and
/// columns stay. Refuses such characters elsewhere, texts over several lines, and lines over
/// limits::palette_line_bytes_max. A mark of UTF-8 at the beginning becomes blanks.
tl::expected<std::string, LineFault> ascii_toml(std::string_view text);

}  // namespace scree
