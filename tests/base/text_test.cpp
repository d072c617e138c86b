#include "shared/base/text.h"

#include <gtest/gtest.h>

#include "shared/base/random.h"

namespace scree {
namespace {

TEST(Text, an_ipv6_address_with_a_port_stands_in_brackets) {
  EXPECT_EQ(endpoint_text("127.0.0.1", 7777), "127.0.0.1:7777");
  EXPECT_EQ(endpoint_text("::1", 7777), "[::1]:7777");
  EXPECT_EQ(endpoint_text("192.0.2.7", 0), "192.0.2.7");
  EXPECT_EQ(endpoint_text("[fe80::2]", 1), "[fe80::2]:1");
  EXPECT_EQ(endpoint_text("scree.example", 80), "scree.example:80");
  EXPECT_EQ(endpoint_text("127.0.0.1:5100", 5100), "127.0.0.1:5100:5100") << "a mistake, and no IPv6 address";
}

TEST(Text, every_script_may_be_shown) {
  for (const char* text : {"", "scree", "Größe 5 µm", "Привет", "日本語", "𝔘𝔫𝔦", "\xE2\x82\xAC"})
    EXPECT_FALSE(fault_of_text(text).has_value()) << text;
}

TEST(Text, what_is_no_utf8_is_named) {
  for (const char* text :
       {"\x80", "\xC3", "\xC0\xAF", "\xE0\x80\xAF", "\xED\xA0\x80", "\xF4\x90\x80\x80", "\xFF", "a\xE2\x82"})
    EXPECT_EQ(fault_of_text(text), "is not UTF-8");
}

TEST(Text, what_steers_a_terminal_or_turns_the_text_round_is_named) {
  for (const char* text : {"a\nb", "\x1b[31m", "\x7f",
                           "\xC2\x9B"
                           "31m",
                           "\xE2\x80\xA8"})
    EXPECT_EQ(fault_of_text(text), "holds control characters");
  for (const char* text : {"\xE2\x80\xAE"
                           "gpj",
                           "\xE2\x81\xA6", "\xD8\x9C", "\xE2\x80\x8F"})
    EXPECT_EQ(fault_of_text(text), "holds characters that set its direction");
}

TEST(Text, what_nobody_sees_is_named_but_what_shapes_another_character_may_follow_it) {
  for (const char* text :
       {"a\u200Bb", "\uFEFF", "a\u2060", "\u00AD", "\u3164", "\U000E0041", "\u200D", "\uFE0F", "a \u200D"})
    EXPECT_EQ(fault_of_text(text), "holds invisible characters") << text;
  for (const char* text : {"می\u200Cخواهم", "\u2764\uFE0F\u200D\U0001F525"})
    EXPECT_FALSE(fault_of_text(text).has_value()) << text;
  EXPECT_EQ(showable("\u200B\u200Da\uFE0F", 64), "  a\uFE0F");
}

TEST(Text, anything_becomes_showable_within_its_limit) {
  EXPECT_EQ(showable("a\nb\xE2\x80\xAE"
                     "c\xFF",
                     64),
            "a b c?");
  EXPECT_EQ(showable("\xE2\x82\xAC\xE2\x82\xAC", 5), "\xE2\x82\xAC");
  Random random(7);
  for (int round = 0; round < 2000; ++round) {
    std::string text(random.below(40), ' ');
    for (char& c : text) c = static_cast<char>(random.below(256));
    const size_t limit = random.below(40);
    const std::string shown = showable(text, limit);
    EXPECT_LE(shown.size(), limit);
    EXPECT_FALSE(fault_of_text(shown).has_value());
  }
}

}  // namespace
}  // namespace scree
