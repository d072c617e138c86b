#include "content/toml_lines.h"

#include <algorithm>

#include "content/limits.h"
#include "shared/base/text.h"

namespace scree {

namespace {

bool is_ascii(char c) {
  return static_cast<unsigned char>(c) < 0x80;
}

/// Where the text in quotes ends that begins at `at`, just behind its last quote, or the line's end.
size_t end_of_quoted(std::string_view line, size_t at) {
  const char quote = line[at];
  for (size_t i = at + 1; i < line.size(); ++i) {
    if (line[i] == quote) return i + 1;
    if (line[i] == '\\' && quote == '"') ++i;
  }
  return line.size();
}

/// Where the line's comment begins, or its end. Fails on a text over several lines, whose lines would have to
/// be read otherwise.
tl::expected<size_t, std::string> begin_of_comment(std::string_view line) {
  for (size_t at = 0; at < line.size();) {
    const std::string_view rest = line.substr(at);
    if (rest.front() == '#') return at;
    if (rest.starts_with("\"\"\"") || rest.starts_with("'''"))
      return tl::unexpected(std::string("a text stands in one line, between one quote and another"));
    at = rest.front() == '"' || rest.front() == '\'' ? end_of_quoted(line, at) : at + 1;
  }
  return line.size();
}

tl::expected<void, std::string> make_ascii(char* line, size_t size) {
  if (size > limits::palette_line_bytes_max)
    return tl::unexpected("the line has " + std::to_string(size) + " bytes, over the limit of " +
                          std::to_string(limits::palette_line_bytes_max));
  const auto comment = begin_of_comment({line, size});
  if (!comment) return tl::unexpected(comment.error());
  if (!std::all_of(line, line + *comment, is_ascii))
    return tl::unexpected(std::string("only comments have other characters than those of ASCII"));
  if (!is_utf8({line + *comment, size - *comment}))
    return tl::unexpected(std::string("the comment is not UTF-8: save the file in that encoding"));
  std::replace_if(
      line + *comment, line + size, [](char c) { return !is_ascii(c); }, '?');
  return {};
}

}  // namespace

tl::expected<std::string, LineFault> ascii_toml(std::string_view text) {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  std::string ascii(text);
  if (text.starts_with(mark)) std::fill_n(ascii.begin(), mark.size(), ' ');
  size_t number = 1;
  for (size_t begin = 0; begin < ascii.size(); ++number) {
    const size_t end = std::min(ascii.find('\n', begin), ascii.size());
    if (const auto made = make_ascii(ascii.data() + begin, end - begin); !made)
      return tl::unexpected(LineFault{number, made.error()});
    begin = end + 1;
  }
  return ascii;
}

}  // namespace scree
