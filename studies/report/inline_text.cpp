#include "studies/report/inline_text.h"

#include <algorithm>
#include <cctype>

#include "shared/base/text.h"

namespace scree {
namespace {

bool is_word(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80;
}

bool is_target(std::string_view target) {
  if (target.empty() || target.find_first_of(" \"'<>()\\`") != std::string_view::npos) return false;
  return target.starts_with("https://") || target.starts_with("http://") ||
         target.find(':') == std::string_view::npos;
}

/// Takes a mark's span from the start of `rest`; false, and nothing is taken, where there is none.
bool parse_span(std::string_view& rest, InlineSpan& span) {
  const auto between = [&](std::string_view open, std::string_view close) {
    if (!rest.starts_with(open)) return std::string_view();
    const size_t end = rest.find(close, open.size());
    return end == std::string_view::npos ? std::string_view() : rest.substr(open.size(), end - open.size());
  };
  if (const auto code = between("`", "`"); !code.empty()) {
    span = {InlineSpan::Kind::code, std::string(code), {}, {}};
    rest.remove_prefix(code.size() + 2);
    return true;
  }
  if (const auto strong = between("**", "**"); !strong.empty()) {
    span = {InlineSpan::Kind::strong, {}, parse_inline(strong), {}};
    rest.remove_prefix(strong.size() + 4);
    return true;
  }
  const auto words = between("[", "](");
  if (words.empty()) return false;
  const std::string_view after = rest.substr(words.size() + 3);
  const size_t end = after.find(')');
  if (end == std::string_view::npos || !is_target(after.substr(0, end))) return false;
  span = {InlineSpan::Kind::link, {}, parse_inline(words), std::string(after.substr(0, end))};
  rest = after.substr(end + 1);
  return true;
}

/// Plain text as Markdown that shows it: what would be a mark has a backslash before it.
std::string escaped_markdown(const std::string& text, MarkdownPlace place) {
  std::string out;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    // Within a word it marks nothing.
    const bool within = i > 0 && i + 1 < text.size() && is_word(text[i - 1]) && is_word(text[i + 1]);
    if (c == '<')
      out += "&lt;";
    else if (c == '&')
      out += "&amp;";
    else if (std::string_view("\\`*[~").find(c) != std::string_view::npos || (c == '_' && !within) ||
             (c == '|' && place == MarkdownPlace::cell))
      out.append("\\").append(1, c);
    else
      out += c;
  }
  return out;
}

/// At a paragraph's start some characters would make a heading, a list, a quote or a rule.
std::string escaped_start(std::string text) {
  if (text.empty()) return text;
  if (std::string_view("#+-=>").find(text.front()) != std::string_view::npos) return "\\" + text;
  const size_t digits = static_cast<size_t>(
      std::ranges::find_if_not(text, [](char c) { return c >= '0' && c <= '9'; }) - text.begin());
  if (digits > 0 && digits < text.size() && (text[digits] == '.' || text[digits] == ')') &&
      (digits + 1 == text.size() || text[digits + 1] == ' '))
    text.insert(digits, "\\");
  return text;
}

std::string markdown_of(const std::vector<InlineSpan>& spans, MarkdownPlace place) {
  std::string out;
  for (const InlineSpan& span : spans) switch (span.kind) {
      case InlineSpan::Kind::text:
        out += escaped_markdown(span.text, place);
        break;
      case InlineSpan::Kind::code: {
        out += '`';
        for (const char c : span.text) {
          // A table is cut into cells before its code is looked at.
          if (c == '|' && place == MarkdownPlace::cell) out += '\\';
          out += c;
        }
        out += '`';
        break;
      }
      case InlineSpan::Kind::strong:
        out += "**" + markdown_of(span.inside, place) + "**";
        break;
      case InlineSpan::Kind::link:
        out += "[" + markdown_of(span.inside, place) + "](" + span.target + ")";
        break;
    }
  return out;
}

std::string html_of(const std::vector<InlineSpan>& spans) {
  std::string out;
  for (const InlineSpan& span : spans) switch (span.kind) {
      case InlineSpan::Kind::text:
        out += html_escaped(span.text);
        break;
      case InlineSpan::Kind::code:
        out += "<code>" + html_escaped(span.text) + "</code>";
        break;
      case InlineSpan::Kind::strong:
        out += "<strong>" + html_of(span.inside) + "</strong>";
        break;
      case InlineSpan::Kind::link:
        out += "<a href=\"" + html_escaped(span.target) + "\">" + html_of(span.inside) + "</a>";
        break;
    }
  return out;
}

}  // namespace

std::vector<InlineSpan> parse_inline(std::string_view text) {
  std::vector<InlineSpan> spans;
  while (!text.empty()) {
    InlineSpan span;
    if (parse_span(text, span)) {
      spans.push_back(std::move(span));
      continue;
    }
    if (spans.empty() || spans.back().kind != InlineSpan::Kind::text) spans.emplace_back();
    spans.back().text += text.front();
    text.remove_prefix(1);
  }
  return spans;
}

std::string inline_markdown(std::string_view text, MarkdownPlace place) {
  const std::string line = markdown_of(parse_inline(one_line(text)), place);
  return place == MarkdownPlace::paragraph ? escaped_start(line) : line;
}

std::string inline_html(std::string_view text) {
  return html_of(parse_inline(one_line(text)));
}

std::string html_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string one_line(std::string_view text) {
  return showable(text, text.size());
}

}  // namespace scree
