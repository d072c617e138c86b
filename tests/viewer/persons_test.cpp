// Other persons, as one sees and hears of them: lines, figures, and the line that one writes.
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "client/viewer/base/limits.h"
#include "client/viewer/input/text_line.h"
#include "client/viewer/session/conversation.h"
#include "client/viewer/session/figures.h"

namespace scree {
namespace {

std::string typed(const std::u32string& characters, size_t bytes_max = 200) {
  TextLine line(bytes_max);
  for (const char32_t character : characters) line.add(static_cast<uint32_t>(character));
  return line.text();
}

TEST(TextLine, takes_characters_of_any_length_and_none_that_may_not_be_shown) {
  EXPECT_EQ(typed(U"aé€\U0001F600"), "a\xC3\xA9\xE2\x82\xAC\xF0\x9F\x98\x80");
  EXPECT_EQ(typed(U"a\n\x1b\x202E\xFFFFFFFF"
                  U"b"),
            "ab");
}

TEST(TextLine, is_bounded_by_whole_characters_and_erased_by_them) {
  EXPECT_EQ(typed(U"ab€", 4), "ab");
  TextLine line(100);
  for (const uint32_t code : {0x61U, 0x20ACU, 0x1F600U}) line.add(code);
  line.erase();
  EXPECT_EQ(line.text(), "a\xE2\x82\xAC");
  line.erase();
  line.erase();
  line.erase();
  EXPECT_EQ(line.text(), "");
}

TEST(Conversation, lines_are_shown_for_a_while_and_kept_up_to_a_bound) {
  Conversation conversation;
  conversation.apply(SaidMessage{3, "Ann", "hello"}, 10.0);
  conversation.apply(SaidMessage{4, "", "hi"}, 20.0);
  conversation.apply(SaidMessage{0, "", "too many speak at once"}, 20.0);
  const std::vector<std::string> all{"Ann: hello", "client 4: hi", "server: too many speak at once"};
  EXPECT_EQ(conversation.lines(21.0, false), all);
  EXPECT_EQ(conversation.lines(10.5 + limits::line_shown_s, false).size(), 2U);
  EXPECT_TRUE(conversation.lines(1000.0, false).empty());
  EXPECT_EQ(conversation.lines(1000.0, true), all);
  for (int i = 0; i < 100; ++i) conversation.apply(SaidMessage{3, "Ann", "again"}, 30.0);
  EXPECT_EQ(conversation.lines(30.0, true).size(), limits::lines_kept_max);
}

TEST(Conversation, nobody_is_known_after_a_new_beginning) {
  Conversation conversation;
  conversation.apply(PersonsMessage{{{3, "Ann", Role::builder}}, 0, true});
  EXPECT_EQ(conversation.persons().persons.size(), 1U);
  conversation.begin();
  EXPECT_EQ(conversation.persons(), PersonsMessage{});
}

TEST(Figures, follow_their_cursors_smoothly_and_go_with_them) {
  Figures figures;
  figures.step({{3, "Ann", {0.0F, 2.0F, 0.0F}, {0.0F, 0.0F, 5.0F}}}, 10.0);
  EXPECT_EQ(figures.all().at(3).eye_m, glm::vec3(0.0F, 2.0F, 0.0F));
  const std::vector<PlayerCursor> moved{{3, "Ann", {1.0F, 2.0F, 0.0F}, {0.0F, 0.0F, 5.0F}}};
  figures.step(moved, 10.02);
  EXPECT_GT(figures.all().at(3).eye_m.x, 0.0F);
  EXPECT_LT(figures.all().at(3).eye_m.x, 0.5F);
  figures.step(moved, 12.0);
  EXPECT_NEAR(figures.all().at(3).eye_m.x, 1.0F, 0.01F);
  figures.step({{3, "Ann", {500.0F, 2.0F, 0.0F}, {}}}, 12.02);
  EXPECT_EQ(figures.all().at(3).eye_m.x, 500.0F);
  figures.step({}, 12.04);
  EXPECT_TRUE(figures.all().empty());
}

TEST(Figures, are_bodies_under_the_eye_but_not_around_ones_own) {
  Figures figures;
  figures.step({{3, "Ann", {0.0F, 2.0F, 0.0F}, {0.0F, 0.0F, 5.0F}}}, 10.0);
  LineList lines;
  figures.add_to(lines, {5.0F, 2.0F, 0.0F});
  ASSERT_FALSE(lines.corners().empty());
  EXPECT_EQ(lines.corners().size() % 3, 0U);
  float low_m = 1e9F, high_m = -1e9F;
  for (const LineVertex& corner : lines.corners()) {
    low_m = std::min(low_m, corner.place_m.y);
    high_m = std::max(high_m, corner.place_m.y);
  }
  EXPECT_NEAR(low_m, 2.0F - 1.55F, 0.01F);
  EXPECT_NEAR(high_m, 2.15F, 0.01F);
  lines.clear();
  figures.add_to(lines, {0.1F, 2.0F, 0.0F});
  EXPECT_TRUE(lines.corners().empty());
  figures.add_to(lines, {5.0F, 2.0F, 0.0F}, 3);
  EXPECT_TRUE(lines.corners().empty()) << "nor around the eye that one looks through";
}

}  // namespace
}  // namespace scree
