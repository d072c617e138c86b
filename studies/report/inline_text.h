// Text of a report: Markdown within a line, such as `code`, **strong** and [links](target). libcmark-gfm
// reads it. HTML in it is text, and a link leads to a page (http, https) or a file beside the report, else
// nowhere. Characters that may not be shown (shared/base/text.h) become spaces.
#pragma once

#include <string>
#include <string_view>

namespace scree {

/// As Markdown (GitHub's) that shows the same, in a paragraph or in a cell of a table.
enum class MarkdownPlace { paragraph, cell };
std::string inline_markdown(std::string_view text, MarkdownPlace place);

/// As HTML that shows the same.
std::string inline_html(std::string_view text);

/// Text without marks for HTML, in an element or in an attribute between double quotes.
std::string html_escaped(std::string_view text);

/// The text on one line, of characters that may be shown.
std::string one_line(std::string_view text);

}  // namespace scree
