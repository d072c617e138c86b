// The rules of messages catch samples that break them; style_test.cpp holds all sources to them.
#include <gtest/gtest.h>

#include "tests/style/message_rules.h"
#include "tests/style/prose_rules.h"

namespace scree::style {
namespace {

std::vector<std::string> texts_of(const std::string& source) {
  std::vector<std::string> texts;
  for (const Literal& literal : literals_of(source)) texts.push_back(literal.text);
  return texts;
}

size_t message_complaints_of(const std::string& source) {
  return check_messages({"server/a.cpp", source}).size();
}

TEST(MessageRules, adjacent_literals_are_one) {
  const std::vector<std::string> wanted = {"one text", "another"};
  EXPECT_EQ(texts_of("f(\"one \"  // a \"comment\"\n  \"text\", \"another\");"), wanted);
}

TEST(MessageRules, escapes_are_undone) {
  const std::vector<std::string> wanted = {"say \"this\"\nthen"};
  EXPECT_EQ(texts_of(R"(f("say \"this\"\nthen");)"), wanted);
}

TEST(MessageRules, characters_directives_and_raw_literals_are_no_messages) {
  EXPECT_TRUE(texts_of("#include \"a.h\"\n#define A \\\n  \"b\"\nchar c = '\"', d = '\\'';\nint e = 1'000;\n")
                  .empty());
  EXPECT_TRUE(texts_of("auto a = R\"x(say \"this\")x\";").empty());
}

TEST(MessageRules, an_option_is_known_by_its_call) {
  const std::vector<Literal> found =
      literals_of("app.add_option_function<int>(\"--a\", f(\"b\"), \"c\");\nsay(\"d\");");
  ASSERT_EQ(found.size(), 4U);
  EXPECT_TRUE(found[0].in_option);
  EXPECT_FALSE(found[1].in_option);
  EXPECT_TRUE(found[2].in_option);
  EXPECT_FALSE(found[3].in_option);
  EXPECT_EQ(found[3].line, 2U);
}

TEST(MessageRules, turns_of_phrase_are_caught) {
  EXPECT_EQ(message_complaints_of("f(\"whoever knows it may come\");"), 1U);
  EXPECT_EQ(message_complaints_of("f(\"the flag stands \"\n  \"over the file\");"), 1U);
  EXPECT_EQ(message_complaints_of("f(\"a port; unless said, 4177\");"), 1U);
  EXPECT_EQ(message_complaints_of("f(\"It ended. Of bytes no more are kept.\");"), 1U);
  EXPECT_EQ(message_complaints_of("f(\"the flag overrides the file\");"), 0U);
}

TEST(MessageRules, an_option_names_its_thing) {
  EXPECT_EQ(message_complaints_of("app.add_option(\"--seed\", seed, \"of the terrain\");"), 1U);
  EXPECT_EQ(message_complaints_of("app.add_option(\"--seed\", seed, \"random seed of the terrain\");"), 0U);
  EXPECT_EQ(message_complaints_of("say(count, \"of the pieces\");"), 0U);
}

TEST(MessageRules, a_long_sentence_is_caught) {
  std::string words;
  for (size_t word = 0; word < sentence_words_max; ++word) words += "word ";
  EXPECT_EQ(message_complaints_of("f(\"" + words + "\");"), 0U);
  EXPECT_EQ(message_complaints_of("f(\"" + words + "\"\n  \"word\");"), 1U);
  EXPECT_EQ(message_complaints_of("f(\"" + words + "\\nword\");"), 0U);
}

TEST(MessageRules, tests_may_say_anything) {
  EXPECT_TRUE(check_messages({"tests/a.cpp", "f(\"whoever knows it\");"}).empty());
}

}  // namespace
}  // namespace scree::style
