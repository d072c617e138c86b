// Bans of networks, names and tokens, the file that people and the server write both, and who goes for it.
#include <fstream>
#include <gtest/gtest.h>

#include "auth/access_token.h"
#include "server/doors/bans.h"
#include "server/doors/limits.h"
#include "tests/support/access_fixture.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

bool fits(const std::string& target, const BanSubject& subject) {
  const auto read = BanTarget::read(target);
  EXPECT_TRUE(read.has_value()) << target;
  return read && read->fits(subject);
}

TEST(BanTarget, networks_hold_their_addresses_and_no_others) {
  EXPECT_TRUE(fits("203.0.113.0/24", {"203.0.113.255"}));
  EXPECT_TRUE(fits("203.0.113.0/24", {"::ffff:203.0.113.7"})) << "the same address, written as IPv6";
  EXPECT_FALSE(fits("203.0.113.0/24", {"203.0.114.0"}));
  EXPECT_TRUE(fits("203.0.113.9", {"203.0.113.9"}));
  EXPECT_FALSE(fits("203.0.113.9", {"203.0.113.8"}));
  EXPECT_TRUE(fits("10.0.0.0/9", {"10.127.0.1"}));
  EXPECT_FALSE(fits("10.0.0.0/9", {"10.128.0.1"}));
  EXPECT_TRUE(fits("2001:db8::1", {"2001:db8::ffff"})) << "its network of 64 bits";
  EXPECT_TRUE(fits("2001:db8::/32", {"2001:db8:ffff::1"}));
  EXPECT_FALSE(fits("2001:db8::/32", {"2001:db9::1"}));
  EXPECT_FALSE(fits("2001:db8::1/128", {"2001:db8::2"}));
  EXPECT_FALSE(fits("10.0.0.1", {"no address"}));
  for (const char* wide : {"::2", "::/16", "::/64"}) {
    EXPECT_TRUE(fits(wide, {"::3"})) << wide;
    EXPECT_FALSE(fits(wide, {"203.0.113.9"}))
        << wide << " holds the bytes of every IPv4 address, and none of them";
  }
}

TEST(BanTarget, names_and_tokens_are_the_very_same) {
  EXPECT_TRUE(fits("name:Ann", {"10.0.0.1", "Ann"}));
  EXPECT_TRUE(fits("name:Ann", {"10.0.0.1", "aNN"}));
  EXPECT_FALSE(fits("name:Ann", {"10.0.0.1", "Anna"}));
  EXPECT_FALSE(fits("name:Ann", {"10.0.0.1"}));
  EXPECT_TRUE(fits("name:Ann%20B%25", {"10.0.0.1", "Ann B%"}));
  EXPECT_TRUE(fits("token:00000000000000ab", {"10.0.0.1", "", 0xAB}));
  EXPECT_FALSE(fits("token:00000000000000ab", {"10.0.0.1", "", 0xAC}));
  EXPECT_FALSE(fits("token:0000000000000000", {"10.0.0.1", "", 0})) << "who has none";
}

TEST(BanTarget, is_written_in_one_way_and_refuses_what_it_is_not) {
  for (const auto& [text, key] : {std::pair{"203.0.113.77/24", "203.0.113.0/24"},
                                  {"203.0.113.9/32", "203.0.113.9"},
                                  {"::ffff:10.0.0.1", "10.0.0.1"},
                                  {"2001:db8:1:2:3::", "2001:db8:1:2::/64"},
                                  {"::1", "::1"},
                                  {"name:Ann B", "name:Ann%20B"},
                                  {"token:00000000000000AB", "token:00000000000000ab"}}) {
    EXPECT_EQ(ban_key(text).value_or("refused"), key);
    EXPECT_EQ(ban_key(key).value_or("refused"), key) << "and again";
  }
  for (const char* bad :
       {"", "nowhere", "10.0.0.0/7", "10.0.0.0/33", "10.0.0.0/", "2001::/15", "10.0.0.0/8x",
        "name:", "name:a\nb", "name:123456789012345678901234567890123", "token:12", "token:"})
    EXPECT_FALSE(ban_key(bad).has_value()) << bad;
}

class BanFileTest : public ::testing::Test {
 protected:
  std::string text() const {
    std::ifstream file(path);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  const TestFolder folder;
  const std::string path = folder / "bans.txt";
};

TEST_F(BanFileTest, lines_and_comments_of_people_survive_what_the_server_writes) {
  std::ofstream(path) << "# neighbours\n10.0.0.1 0   two  words\n\n";
  auto bans = Bans::open(path);
  ASSERT_TRUE(bans.has_value()) << bans.error().message;
  std::ofstream(path, std::ios::app) << "# by hand, while it runs\nname:Bob 0 rude\n";
  ASSERT_TRUE(bans->add("10.0.0.2", {0, "shouts"}, 50));
  EXPECT_EQ(text(),
            "# neighbours\n10.0.0.1 0   two  words\n\n# by hand, while it runs\nname:Bob 0 rude\n"
            "10.0.0.2 0 shouts\n");
  EXPECT_TRUE(bans->find({"1.2.3.4", "Bob"}, 60).has_value()) << "it counts at once";
  ASSERT_TRUE(bans->lift("10.0.0.1"));
  EXPECT_EQ(text(), "# neighbours\n\n# by hand, while it runs\nname:Bob 0 rude\n10.0.0.2 0 shouts\n");
}

TEST_F(BanFileTest, what_people_take_out_or_change_counts_and_nothing_that_they_wrote_is_lost) {
  auto bans = Bans::open(path);
  ASSERT_TRUE(bans->add("10.0.0.1", {0, "a"}, 50));
  ASSERT_TRUE(bans->add("10.0.0.2", {0, "b"}, 50));
  std::ofstream(path) << "10.0.0.2 99 changed\nthis is no ban\n";
  EXPECT_TRUE(holds(bans->read_again().error().message, "line 2"));
  EXPECT_FALSE(bans->find({"10.0.0.1"}, 60).has_value()) << "its line was taken out";
  EXPECT_EQ(bans->find({"10.0.0.2"}, 60)->ban.reason, "changed");
  EXPECT_FALSE(bans->find({"10.0.0.2"}, 99).has_value());
  ASSERT_TRUE(bans->add("10.0.0.3", {0, "c"}, 60));
  EXPECT_EQ(text(), "10.0.0.2 99 changed\nthis is no ban\n10.0.0.3 0 c\n");
  std::filesystem::remove(path);
  ASSERT_TRUE(bans->add("10.0.0.4", {0, "d"}, 60));
  EXPECT_EQ(text(), "10.0.0.2 99 changed\n10.0.0.3 0 c\n10.0.0.4 0 d\n") << "a file that is gone lifts none";
}

TEST_F(BanFileTest, who_empties_it_lifts_all) {
  auto bans = Bans::open(path);
  ASSERT_TRUE(bans->add("10.0.0.1", {0, "a"}, 50));
  std::ofstream(path).close();
  EXPECT_TRUE(bans->read_again());
  EXPECT_FALSE(bans->find({"10.0.0.1"}, 60).has_value());
  ASSERT_TRUE(bans->add("10.0.0.2", {0, "b"}, 60));
  EXPECT_EQ(text(), "10.0.0.2 0 b\n");
}

TEST_F(BanFileTest, a_ban_that_is_made_again_has_one_line) {
  auto bans = Bans::open(path);
  ASSERT_TRUE(bans->add("10.0.0.1", {100, "a"}, 50));
  ASSERT_TRUE(bans->add("10.0.0.1", {0, "for ever"}, 60));
  EXPECT_EQ(text(), "10.0.0.1 0 for ever\n");
  ASSERT_TRUE(bans->add("10.0.0.2", {70, "short"}, 60));
  ASSERT_TRUE(bans->add("10.0.0.3", {0, ""}, 80));
  EXPECT_EQ(text(), "10.0.0.1 0 for ever\n10.0.0.3 0\n") << "those that ended go";
}

using BanServerTest = AccessTest;

TEST_F(BanServerTest, who_is_banned_by_hand_goes_when_the_files_are_read_again) {
  config.access.bans_path = folder / "bans";
  start();
  const auto client = join(token(Role::builder, 0x15), Role::builder);
  const auto other = join(token(Role::builder, 0x16), Role::builder);
  std::ofstream(folder / "bans") << "token:0000000000000015 0 griefing\n";
  ASSERT_TRUE(server->reload());
  const auto refused = client->receive_as<RefusalMessage>();
  ASSERT_TRUE(refused);
  EXPECT_EQ(refused->reason, "this token is banned from the server: griefing");
  ASSERT_TRUE(other->send(AdminMessage{9, "", ListBansRequest{}}));
  EXPECT_TRUE(other->receive_as<ReplyMessage>()) << "no other goes";
}

TEST_F(BanServerTest, bans_that_have_ended_are_not_listed) {
  config.access.bans_path = folder / "bans";
  std::ofstream(folder / "bans") << "10.0.0.1 1 long ago\n10.0.0.2 0 for ever\n";
  start();
  const auto bans = list_bans(admin(the_admin_token));
  ASSERT_TRUE(bans) << bans.error().message;
  EXPECT_EQ(*bans, (std::vector<BanRow>{{"10.0.0.2", 0, "for ever"}}));
}

}  // namespace
}  // namespace scree
