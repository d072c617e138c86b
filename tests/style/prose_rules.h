// Plain English that a program can check: short sentences and lines, and none of the turns of phrase that
// readers stumbled over. Pure functions of text, for pages in Markdown and for comments alike.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tests/style/style_rules.h"

namespace scree::style {

/// Words. A reader who learnt English late holds about 25 in mind; nobody reads 40 in one go.
inline constexpr size_t sentence_words_mean_max = 25;
inline constexpr size_t sentence_words_max = 40;
/// Columns of a line of prose, so that two pages stand side by side.
inline constexpr size_t prose_columns_max = 120;

/// The sentences of running text without markup. One ends at a full stop, question or exclamation mark before
/// a space, or with the text; abbreviations such as "e.g." do not end one.
std::vector<std::string> sentences_of(std::string_view text);

/// Words between spaces; what has no letter or digit, such as a dash, is none.
size_t words_in(std::string_view sentence);

/// The running text of a page in Markdown, without code, headings, pictures' and links' addresses.
struct PageText {
  std::vector<std::string> paragraphs;  ///< and items of lists
  std::vector<std::string> cells;       ///< of tables
};
PageText text_of_page(std::string_view markdown);

/// What is wrong with one sentence by itself: too long, or a turn of phrase; `where` says which text it is
/// of.
Complaints check_sentence(const std::string& where, const std::string& sentence);

/// Sentences, their mean length in paragraphs, and the lines of a page.
Complaints check_page(const SourceFile& page);

}  // namespace scree::style
