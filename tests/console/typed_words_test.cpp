// Lines of the console as words.
#include "client/admin/console/typed_words.h"

#include <gtest/gtest.h>

#include "client/admin/console/limits.h"
#include "tests/support/holds.h"

namespace scree {
namespace {

using Words = std::vector<std::string>;

Words words_of(std::string_view line) {
  const auto words = split_words(line);
  return words ? *words : Words{"error: " + words.error().message};
}

TEST(TypedWords, are_split_at_spaces_as_a_shell_does) {
  EXPECT_EQ(words_of(""), Words{});
  EXPECT_EQ(words_of(" \t "), Words{});
  EXPECT_EQ(words_of("kick  3\t--reason x "), (Words{"kick", "3", "--reason", "x"}));
  EXPECT_EQ(words_of("kick 3 --reason 'not here'"), (Words{"kick", "3", "--reason", "not here"}));
  EXPECT_EQ(words_of(R"(ban name:Ann\ B "a \"b\" \\ \n c" '\"')"),
            (Words{"ban", "name:Ann B", R"(a "b" \ \n c)", R"(\")"}));
  EXPECT_EQ(words_of(R"(a''b"c"'d' "")"), (Words{"abcd", ""}));
  EXPECT_EQ(words_of("undo --by=Jörg"), (Words{"undo", "--by=Jörg"}));
  EXPECT_EQ(words_of("$HOME `x` a|b > c;d *"), (Words{"$HOME", "`x`", "a|b", ">", "c;d", "*"}));
}

TEST(TypedWords, a_number_sign_begins_a_comment_at_the_begin_of_a_word_alone) {
  EXPECT_EQ(words_of("# all of it 'is"), Words{});
  EXPECT_EQ(words_of("show # the settings"), Words{"show"});
  EXPECT_EQ(words_of("kick a#b '#' \\#"), (Words{"kick", "a#b", "#", "#"}));
}

TEST(TypedWords, what_is_left_open_is_named) {
  for (const char* const line : {"kick 'a", "kick \"a", "kick \"a\\\""})
    EXPECT_EQ(words_of(line), Words{"error: a quote is not closed"}) << line;
  EXPECT_EQ(words_of("kick a\\"), Words{"error: nothing follows the last backslash"});
  EXPECT_TRUE(
      holds(words_of(std::string(limits::typed_line_bytes_max + 1, 'x')).front(), "at most 4096 bytes"));
}

TEST(TypedWords, a_line_that_is_being_typed_has_a_last_word_that_is_not_ended) {
  const auto expect = [](std::string_view line, const Words& before, const std::string& word, bool quoted) {
    const Typing typing = typing_of(line);
    EXPECT_EQ(typing.before, before) << line;
    EXPECT_EQ(typing.word, word) << line;
    EXPECT_EQ(typing.quoted, quoted) << line;
  };
  expect("", {}, "", false);
  expect("ki", {}, "ki", false);
  expect("kick ", {"kick"}, "", false);
  expect("set 'a b' im", {"set", "a b"}, "im", false);
  expect("set 'im", {"set"}, "im", true);
  expect("set i\\m", {"set"}, "im", true);
  expect("show # th", {"show"}, "", true);
}

}  // namespace
}  // namespace scree
