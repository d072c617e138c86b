// Other persons, as one sees and hears of them: lines, figures, and the line that one writes.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "client/viewer/base/limits.h"
#include "client/viewer/figures/figures.h"
#include "client/viewer/input/text_line.h"
#include "client/viewer/session/conversation.h"

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

/// As if every limb ended in balls of its least radius.
float reach_m(const std::vector<Limb>& limbs, float way) {
  float most_m = -1e9F;
  for (const Limb& limb : limbs) {
    const glm::quat turn(limb.rotation.w, limb.rotation.x, limb.rotation.y, limb.rotation.z);
    const float end_m = std::abs((turn * glm::vec3(0.0F, limb.half_m, 0.0F)).y);
    const float round_m = std::min({limb.radius_m.x, limb.radius_m.y, limb.radius_m.z});
    most_m = std::max(most_m, way * limb.middle_m.y + end_m + round_m);
  }
  return way * most_m;
}
float lowest_m(const std::vector<Limb>& limbs) {
  return reach_m(limbs, -1.0F);
}
float highest_m(const std::vector<Limb>& limbs) {
  return reach_m(limbs, 1.0F);
}

TEST(Figures, are_bodies_under_the_eye_but_not_around_ones_own) {
  Figures figures;
  figures.step({{3, "Ann", {0.0F, 2.0F, 0.0F}, {0.0F, 0.0F, 5.0F}}}, 10.0);
  const std::vector<Limb> limbs = figures.limbs({5.0F, 2.0F, 0.0F}, {}, false);
  ASSERT_FALSE(limbs.empty());
  EXPECT_NEAR(lowest_m(limbs), 2.0F - 1.55F, 0.06F);
  EXPECT_NEAR(highest_m(limbs), 2.15F, 0.08F);
  EXPECT_TRUE(figures.limbs({0.1F, 2.0F, 0.0F}, {}, false).empty());
  EXPECT_TRUE(figures.limbs({5.0F, 2.0F, 0.0F}, 3, false).empty())
      << "nor around the eye that one looks through";
  EXPECT_TRUE(figures.limbs({5.0F, 2.0F, 0.0F}, {}, true).empty())
      << "who has no body is no part of the world";
}

TEST(Figures, walk_by_the_way_they_go_and_keep_a_foot_on_the_ground) {
  Figures figures;
  PersonFacts facts;
  for (int tick = 0; tick < 60; ++tick) {
    const float x_m = 4.0F * static_cast<float>(tick) / 60.0F;
    facts.feet_m[3] = {x_m, 1.0F, 0.0F};
    figures.step({{3, "Ann", {}, {x_m + 10.0F, 2.55F, 0.0F}}}, 10.0 + tick / 60.0, facts);
    const std::vector<Limb> limbs = figures.limbs({0.0F, 9.0F, 0.0F}, {}, true);
    ASSERT_FALSE(limbs.empty());
    EXPECT_NEAR(lowest_m(limbs), 1.0F, 0.06F) << tick;
  }
  EXPECT_NEAR(figures.all().at(3).walked_m, 4.0F, 0.1F);
  EXPECT_NEAR(figures.all().at(3).speed_m_s, 4.0F, 0.1F);
  EXPECT_TRUE(figures.all().at(3).stands);
}

float distance_of(LineColour a, LineColour b) {
  const auto part = [](uint8_t x, uint8_t y) { return static_cast<float>(x) - static_cast<float>(y); };
  return std::hypot(part(a.red, b.red), part(a.green, b.green), part(a.blue, b.blue));
}

TEST(PersonColours, never_coincide_and_stay) {
  PersonColours colours;
  std::vector<uint64_t> sessions{7};
  colours.follow(sessions);
  const LineColour first = colours.of(7);
  for (uint64_t session = 8; session < 72; ++session) sessions.push_back(session);
  colours.follow(sessions);
  EXPECT_EQ(distance_of(first, colours.of(7)), 0.0F);
  for (const uint64_t a : sessions)
    for (const uint64_t b : sessions)
      EXPECT_TRUE(a == b || distance_of(colours.of(a), colours.of(b)) > 4.0F) << a << " and " << b;
  PersonColours few;
  few.follow(std::vector<uint64_t>{1, 2, 3, 4, 5, 6});
  for (uint64_t a = 1; a < 7; ++a)
    for (uint64_t b = 1; b < a; ++b) EXPECT_GT(distance_of(few.of(a), few.of(b)), 60.0F) << a << " and " << b;
}

}  // namespace
}  // namespace scree
