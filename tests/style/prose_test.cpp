// The pages are written in plain English, as far as a program can tell; and the rules catch samples that are
// not.
#include <algorithm>
#include <gtest/gtest.h>

#include "tests/style/pages.h"
#include "tests/style/prose_rules.h"

namespace scree::style {
namespace {

std::string joined(const Complaints& complaints) {
  std::string text;
  for (const std::string& complaint : complaints) text += "\n  " + complaint;
  return text;
}

TEST(Prose, pages_are_plain_english) {
  EXPECT_GE(documentation_pages().size(), 10U);
  for (const SourceFile& page : documentation_pages()) {
    const Complaints complaints = check_page(page);
    EXPECT_TRUE(complaints.empty()) << joined(complaints);
  }
}

TEST(Prose, the_readme_is_short) {
  const std::string text = documentation_pages().front().text;
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 150);
}

/// Sentences of `count` words each.
std::string sentences(size_t count, size_t words) {
  std::string text;
  for (size_t s = 0; s < count; ++s) {
    for (size_t w = 0; w < words; ++w) text += w == 0 ? "Word" : w % 12 == 0 ? "\nword" : " word";
    text += ".\n";
  }
  return text;
}

size_t complaints_of(const std::string& text) {
  return check_page({"docs/a.md", text}).size();
}

TEST(ProseRules, sentences_end_at_full_stops_before_spaces) {
  const std::vector<std::string> wanted = {"It takes 0.5 s (e.g. here).", "Does it end?", "So it ends"};
  EXPECT_EQ(sentences_of("It takes 0.5 s (e.g. here). Does it\nend? So it ends"), wanted);
  EXPECT_TRUE(sentences_of(" \n").empty());
}

TEST(ProseRules, words_are_counted_without_dashes) {
  EXPECT_EQ(words_in("one – two, 3 …"), 3U);
}

TEST(ProseRules, a_long_sentence_is_caught) {
  EXPECT_EQ(complaints_of(sentences(1, sentence_words_max) + sentences(4, 5)), 0U);
  EXPECT_EQ(complaints_of(sentences(1, sentence_words_max + 1) + sentences(4, 5)), 1U);
}

TEST(ProseRules, a_long_mean_is_caught) {
  EXPECT_EQ(complaints_of(sentences(4, sentence_words_mean_max)), 0U);
  EXPECT_EQ(complaints_of(sentences(4, sentence_words_mean_max + 1)), 1U);
}

TEST(ProseRules, a_long_cell_of_a_table_is_caught) {
  EXPECT_EQ(complaints_of("| short | " + std::string(80, ' ') + "cell |\n"), 0U);
  std::string cell;
  for (size_t w = 0; w <= sentence_words_max; ++w) cell += "word ";
  EXPECT_EQ(complaints_of("| a | " + cell + "|\n"), 1U);
}

TEST(ProseRules, a_long_line_is_caught_but_for_code_tables_and_addresses) {
  const std::string wide(prose_columns_max, 'x');
  EXPECT_EQ(complaints_of(wide + "\n"), 0U);
  EXPECT_EQ(complaints_of(wide + "x\n"), 1U);
  EXPECT_EQ(complaints_of("[word](" + wide + ")\n\n    " + wide + "\n\n```sh\n" + wide + "x\n```\n| " + wide +
                          " |\n"),
            0U);
}

TEST(ProseRules, turns_of_phrase_are_caught) {
  EXPECT_EQ(complaints_of("Of bytes no more are kept.\n"), 1U);
  EXPECT_EQ(complaints_of("- Of bytes no more are kept.\n"), 1U);
  EXPECT_EQ(complaints_of("It ends for whoever\nasked.\n"), 1U);
  EXPECT_EQ(complaints_of("A flag stands over the file.\n"), 1U);
  EXPECT_EQ(complaints_of("A flag overrides the file.\n"), 0U);
}

TEST(ProseRules, code_headings_and_comments_are_not_read) {
  EXPECT_EQ(complaints_of("# Of headings\n<!-- Of\ncomments -->\n\n    Of code\n\n```\nOf code\n```\n"), 0U);
  EXPECT_EQ(words_in(text_of_page("Run `a b c` [there](x.md), ![now](y.png).").paragraphs.front()), 4U);
}

}  // namespace
}  // namespace scree::style
