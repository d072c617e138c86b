// Persons and chat, as the server passes them on.
#include "server/net/talk.h"

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>
#include <sstream>

#include "proto/limits.h"
#include "server/net/limits.h"
#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"

namespace scree {
namespace {

TEST(Talk, lines_go_to_all_cleaned_and_with_the_speakers_name) {
  Talk talk(true);
  talk.join(3, 3, "Ann", Role::builder);
  const auto heard = talk.say(3, "  mind\n the edge ", 10.0);
  ASSERT_TRUE(heard && heard->by_all);
  EXPECT_EQ(heard->line.session, 3U);
  EXPECT_EQ(heard->line.name, "Ann");
  EXPECT_EQ(heard->line.text, "mind  the edge");
  EXPECT_FALSE(talk.say(3, "   ", 10.0));
  EXPECT_FALSE(talk.say(4, "who is not in the list says nothing", 10.0));
}

TEST(Talk, who_says_too_much_is_told_so_alone_and_may_go_on_later) {
  Talk talk(true);
  talk.join(3, 3, "Ann", Role::builder);
  const auto passed = [&](double now_s) {
    const auto heard = talk.say(3, "again", now_s);
    return heard && heard->by_all;
  };
  int count = 0;
  while (passed(10.0)) ++count;
  EXPECT_EQ(count, static_cast<int>(limits::lines_burst_max));
  EXPECT_EQ(talk.say(3, "again", 10.0)->line.session, 0U);
  EXPECT_TRUE(passed(10.0 + 1.0 / limits::lines_per_second_max));
}

TEST(Talk, all_together_say_no_more_than_everybody_can_be_sent) {
  Talk talk(true);
  int count = 0;
  for (uint64_t session = 1; session <= 4096; ++session) talk.join(session, session, "", Role::viewer);
  for (uint64_t session = 1; session <= 4096; ++session) {
    const auto heard = talk.say(session, "all at once", 5.0);
    count += heard && heard->by_all ? 1 : 0;
  }
  EXPECT_EQ(count, static_cast<int>(limits::lines_per_second_all * limits::lines_burst_s));
}

TEST(Talk, a_hundred_parties_that_write_without_a_pause_silence_nobody) {
  Talk talk(true);
  for (uint64_t session = 1; session <= 401; ++session)
    talk.join(session, session == 401 ? 1000 : session % 100, "", Role::viewer);
  size_t honest = 0, others = 0;
  for (int tenth = 0; tenth < 300; ++tenth) {
    const double now_s = 10.0 + 0.1 * tenth;
    for (uint64_t session = 1; session <= 400; ++session) {
      const auto heard = talk.say(session, "flood", now_s);
      others += heard && heard->by_all ? 1U : 0U;
    }
    if (tenth % 33 != 20) continue;
    const auto heard = talk.say(401, "mind the edge", now_s);
    ASSERT_TRUE(heard);
    honest += heard->by_all ? 1U : 0U;
  }
  EXPECT_EQ(honest, 9U);
  EXPECT_LE(static_cast<double>(others),
            (30.0 + limits::lines_burst_s) * limits::lines_heard_per_second / 401.0 + 100.0);
}

TEST(Talk, who_is_many_does_not_hide_the_others_from_the_list) {
  Talk talk(true);
  for (uint64_t session = 1; session <= 2 * limits::persons_max; ++session)
    talk.join(session, 7, "many", Role::viewer);
  talk.join(9999, 8, "Ann", Role::viewer);
  const PersonsMessage list = talk.list();
  EXPECT_EQ(list.persons.size(), limits::persons_max);
  EXPECT_EQ(list.persons.back().name, "Ann");
}

TEST(Talk, those_of_one_party_do_not_silence_the_others_nor_say_more_by_coming_again) {
  Talk talk(true);
  talk.join(1000, 2, "Bob", Role::viewer);
  int count = 0;
  for (uint64_t session = 1; session <= 100; ++session) {
    talk.join(session, 1, "", Role::viewer);
    const auto heard = talk.say(session, "all at once", 5.0);
    count += heard && heard->by_all ? 1 : 0;
    talk.leave(session);
  }
  EXPECT_EQ(count, static_cast<int>(limits::lines_burst_party));
  EXPECT_TRUE(talk.say(1000, "of another party", 5.0)->by_all);
  talk.join(101, 1, "", Role::viewer);
  EXPECT_TRUE(talk.say(101, "later", 5.0 + limits::lines_memory_s)->by_all);
}

TEST(Talk, a_server_without_chat_says_so_and_lists_persons_all_the_same) {
  Talk talk(false);
  talk.join(3, 3, "Ann", Role::builder);
  const auto heard = talk.say(3, "hello", 10.0);
  ASSERT_TRUE(heard);
  EXPECT_FALSE(heard->by_all);
  EXPECT_TRUE(holds(heard->line.text, "--chat"));
  EXPECT_FALSE(talk.list().chat);
  EXPECT_EQ(talk.list().persons.size(), 1U);
}

TEST(Talk, a_list_is_told_when_it_changed_and_not_too_often) {
  Talk talk(true);
  talk.join(3, 3, "Ann", Role::builder);
  EXPECT_EQ(talk.untold(10.0), std::vector<uint64_t>{3});
  talk.told(3, 10.0);
  EXPECT_TRUE(talk.untold(100.0).empty());
  talk.join(5, 5, "Bob", Role::viewer);
  talk.told(3, 100.0);
  EXPECT_TRUE(talk.untold(100.0 + 0.5 * limits::persons_interval_s).empty());
  EXPECT_EQ(talk.untold(100.0 + limits::persons_interval_s), std::vector<uint64_t>{5});
  talk.leave(5);
  EXPECT_EQ(talk.untold(200.0), std::vector<uint64_t>{3});
}

TEST(Talk, a_new_name_is_told_to_all_and_stands_before_further_lines) {
  Talk talk(true);
  talk.join(3, 3, "Ann", Role::builder);
  talk.told(3, 10.0);
  talk.rename(3, "Ann (2)");
  talk.rename(4, "nobody there");
  EXPECT_EQ(talk.untold(100.0), std::vector<uint64_t>{3});
  ASSERT_EQ(talk.list().persons.size(), 1U);
  EXPECT_EQ(talk.list().persons[0].name, "Ann (2)");
  EXPECT_EQ(talk.say(3, "it is me", 100.0)->line.name, "Ann (2)");
}

TEST(Talk, a_list_that_not_all_fit_into_is_told_more_seldom) {
  Talk talk(true);
  for (uint64_t session = 1; session <= limits::persons_max + 2; ++session)
    talk.join(session, session, "", Role::viewer);
  EXPECT_EQ(talk.list().persons.size(), limits::persons_max);
  EXPECT_EQ(talk.list().more, 2U);
  talk.told(1, 10.0);
  EXPECT_TRUE(talk.untold(10.0 + 0.9 * limits::persons_many_interval_s).empty());
  EXPECT_EQ(talk.untold(10.0 + limits::persons_many_interval_s).size(), limits::persons_max + 1);
}

/// A client that meets others, and one as there were before.
class TalkServer : public NetServerTest {
 protected:
  std::unique_ptr<RawClient> person(const std::string& name) {
    auto client = std::make_unique<RawClient>(server->port());
    HelloMessage greeting = hello();
    greeting.name = name;
    greeting.meets = true;
    EXPECT_TRUE(client->send(greeting));
    EXPECT_TRUE(client->receive_as<WelcomeMessage>());
    return client;
  }
};

TEST_F(TalkServer, persons_and_lines_come_to_who_meets_others_and_to_nobody_else) {
  start();
  const auto ann = person("Ann");
  const auto first = ann->receive_as<PersonsMessage>();
  ASSERT_TRUE(first);
  ASSERT_EQ(first->persons.size(), 1U);
  const auto bob = person("Bob");
  auto both = ann->receive_as<PersonsMessage>();
  while (both && both->persons.size() < 2) both = ann->receive_as<PersonsMessage>();
  ASSERT_TRUE(both);
  EXPECT_EQ(both->persons[0].name, "Ann");
  EXPECT_EQ(both->persons[1].name, "Bob");
  EXPECT_TRUE(both->chat);
  ASSERT_TRUE(bob->send(SayMessage{"mind the edge"}));
  for (RawClient* client : {ann.get(), bob.get()}) {
    const auto said = client->receive_as<SaidMessage>();
    ASSERT_TRUE(said);
    EXPECT_EQ(said->name, "Bob");
    EXPECT_EQ(said->text, "mind the edge");
  }
  tick();
  for (;;) {
    const auto other = witness->receive(seconds(10));
    ASSERT_TRUE(other);
    ASSERT_FALSE(std::holds_alternative<PersonsMessage>(*other) ||
                 std::holds_alternative<SaidMessage>(*other));
    if (std::holds_alternative<FrameMessage>(*other)) break;
  }
}

TEST_F(TalkServer, lines_are_logged_where_that_is_asked_for_and_else_not) {
  for (const bool logs : {false, true}) {
    const auto before = spdlog::default_logger();
    std::ostringstream log;
    const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(log);
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("talk", sink));
    start([logs](NetConfig& config) { config.log_chat = logs; });
    {
      const auto bob = person("Bob");
      ASSERT_TRUE(bob->send(SayMessage{"mind the edge"}));
      ASSERT_TRUE(bob->receive_as<SaidMessage>());
    }
    server->stop();
    spdlog::set_default_logger(before);
    EXPECT_EQ(log.str().find("(Bob) says: mind the edge") != std::string::npos, logs) << log.str();
  }
}

TEST_F(TalkServer, without_chat_the_speaker_alone_hears_why) {
  start([](NetConfig& config) { config.chat = false; });
  const auto ann = person("Ann");
  ASSERT_TRUE(ann->send(SayMessage{"hello"}));
  const auto said = ann->receive_as<SaidMessage>();
  ASSERT_TRUE(said);
  EXPECT_EQ(said->session, 0U);
  EXPECT_TRUE(holds(said->text, "--chat"));
}

}  // namespace
}  // namespace scree
