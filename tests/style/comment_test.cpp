// The rules of comments catch samples that break them; style_test.cpp holds all sources to them.
#include <gtest/gtest.h>

#include "tests/style/comment_rules.h"

namespace scree::style {
namespace {

TEST(CommentRules, lines_of_a_comment_are_one_text) {
  const std::vector<std::string> wanted = {"It is one text.", "It trails."};
  EXPECT_EQ(paragraphs_of_comments("// It is\n// one text.\nint a;  ///< It trails.\n"), wanted);
}

TEST(CommentRules, a_blank_line_ends_a_paragraph) {
  const std::vector<std::string> wanted = {"One.", "Two."};
  EXPECT_EQ(paragraphs_of_comments("/// One.\n///\n/// Two.\n"), wanted);
}

TEST(CommentRules, a_layout_is_no_text) {
  const std::vector<std::string> wanted = {"Bytes:", "Then it ends."};
  EXPECT_EQ(paragraphs_of_comments("// Bytes:\n//   u32  count\n// Then it ends.\n"), wanted);
}

TEST(CommentRules, an_item_of_a_list_goes_on_indented) {
  const std::vector<std::string> wanted = {"One item that goes on.", "Another."};
  EXPECT_EQ(paragraphs_of_comments("// - One item\n//   that goes on.\n// - Another.\n"), wanted);
}

TEST(CommentRules, a_sentence_without_a_subject_is_caught) {
  EXPECT_EQ(check_comments({"a.h", "/// Of a chunk.\n"}).size(), 1U);
  EXPECT_EQ(check_comments({"a.h", "/// The mass of a chunk.\n"}).size(), 0U);
}

TEST(CommentRules, a_long_sentence_is_caught_but_in_a_specification_of_bytes) {
  std::string text = "//";
  for (int word = 0; word < 41; ++word) text += " word";
  EXPECT_EQ(check_comments({"a.h", text + ".\n// Short.\n"}).size(), 1U);
  EXPECT_EQ(check_comments({"a.proto", text + ".\n// Short.\n"}).size(), 0U);
}

}  // namespace
}  // namespace scree::style
