// Text of a report: plain, but for Markdown's `code`, **strong** and [links](target) within a line. A mark
// that is not closed is text, and so is a link that leads elsewhere than to a page (http, https) or a file
// beside the report. What may not be shown (shared/base/text.h) becomes a space.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace scree {

struct InlineSpan {
  enum class Kind { text, code, strong, link };
  Kind kind = Kind::text;
  std::string text;                ///< of text and code
  std::vector<InlineSpan> inside;  ///< of strong and links
  std::string target;              ///< of links
};

std::vector<InlineSpan> parse_inline(std::string_view text);

/// As Markdown (GitHub's) that shows the same, in a paragraph or in a cell of a table.
enum class MarkdownPlace { paragraph, cell };
std::string inline_markdown(std::string_view text, MarkdownPlace place);

/// As HTML that shows the same.
std::string inline_html(std::string_view text);

/// Text without marks for HTML, in an element or in an attribute between quotes.
std::string html_escaped(std::string_view text);

/// The text on one line, of characters that may be shown.
std::string one_line(std::string_view text);

}  // namespace scree
