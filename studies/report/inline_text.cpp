#include "studies/report/inline_text.h"

#include <cmark-gfm.h>
#include <cstdlib>
#include <memory>
#include <vector>

#include "shared/base/check.h"
#include "shared/base/text.h"

namespace scree {
namespace {

struct Free {
  void operator()(cmark_node* node) const { cmark_node_free(node); }
  void operator()(cmark_iter* nodes) const { cmark_iter_free(nodes); }
  void operator()(char* text) const { std::free(text); }
};
using Node = std::unique_ptr<cmark_node, Free>;

/// Stands before a text while it is read: at a paragraph's start, # or - would make a heading or a list of
/// it.
constexpr std::string_view lead = "x ";

bool is_target(std::string_view target) {
  return target.starts_with("https://") || target.starts_with("http://") ||
         target.find(':') == std::string_view::npos;
}

cmark_node* text_node(const char* text) {
  cmark_node* const node = cmark_node_new(CMARK_NODE_TEXT);
  CHECK(cmark_node_set_literal(node, text) == 1);
  return node;
}

std::vector<cmark_node*> nodes_of(cmark_node* root) {
  std::vector<cmark_node*> nodes;
  const std::unique_ptr<cmark_iter, Free> next(cmark_iter_new(root));
  for (auto event = cmark_iter_next(next.get()); event != CMARK_EVENT_DONE;
       event = cmark_iter_next(next.get()))
    if (event == CMARK_EVENT_ENTER) nodes.push_back(cmark_iter_get_node(next.get()));
  return nodes;
}

/// A document with one paragraph. `line` is not empty, and does not end with a space.
Node parsed(std::string_view line) {
  const std::string led = std::string(lead).append(line);
  Node document(cmark_parse_document(led.data(), led.size(), CMARK_OPT_DEFAULT));
  const std::vector<cmark_node*> nodes = nodes_of(document.get());
  for (cmark_node* const node : nodes) {
    const cmark_node_type type = cmark_node_get_type(node);
    const bool leads = type == CMARK_NODE_LINK || type == CMARK_NODE_IMAGE;
    if (leads && !is_target(cmark_node_get_url(node))) cmark_node_set_url(node, "");
    if (type != CMARK_NODE_HTML_INLINE) continue;
    cmark_node_replace(node, text_node(cmark_node_get_literal(node)));
    cmark_node_free(node);
  }
  cmark_node* const first = cmark_node_first_child(cmark_node_first_child(document.get()));
  const std::string words = cmark_node_get_literal(first);
  CHECK(words.starts_with(lead));
  cmark_node_set_literal(first, words.substr(lead.size()).c_str());
  return document;
}

std::string trimmed_line(std::string_view text) {
  std::string line = one_line(text);
  line.resize(line.find_last_not_of(' ') + 1);  // npos + 1 is 0
  return line;
}

/// The HTML of a document's one paragraph, without its element.
std::string html_of(cmark_node* document) {
  constexpr std::string_view open = "<p>", close = "</p>\n";
  const std::unique_ptr<char, Free> html(cmark_render_html(document, CMARK_OPT_DEFAULT, nullptr));
  const std::string_view all = html.get();
  CHECK(all.starts_with(open) && all.ends_with(close));
  return std::string(all.substr(open.size(), all.size() - open.size() - close.size()));
}

}  // namespace

std::string inline_markdown(std::string_view text, MarkdownPlace place) {
  const std::string line = trimmed_line(text);
  if (line.empty()) return line;
  const Node document = parsed(line);
  const std::unique_ptr<char, Free> markdown(cmark_render_commonmark(document.get(), CMARK_OPT_DEFAULT, 0));
  std::string out;
  for (const char* c = markdown.get(); *c != '\n' && *c != '\0'; ++c) {
    // A table is cut into cells before its code is looked at.
    if (*c == '|' && place == MarkdownPlace::cell) out += '\\';
    out += *c;
  }
  return out;
}

std::string inline_html(std::string_view text) {
  const std::string line = trimmed_line(text);
  return line.empty() ? line : html_of(parsed(line).get());
}

std::string html_escaped(std::string_view text) {
  const Node document(cmark_node_new(CMARK_NODE_DOCUMENT));
  cmark_node* const paragraph = cmark_node_new(CMARK_NODE_PARAGRAPH);
  cmark_node_append_child(document.get(), paragraph);
  cmark_node_append_child(paragraph, text_node(std::string(text).c_str()));
  return html_of(document.get());
}

std::string one_line(std::string_view text) {
  return showable(text, text.size());
}

}  // namespace scree
