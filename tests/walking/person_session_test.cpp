// Persons on foot over the wire: what clients foresee is what the server does, and who lies moves nobody.
#include <array>
#include <chrono>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <thread>

#include "client/bot/bot.h"
#include "client/session/walk_prediction.h"
#include "tests/support/person_world.h"
#include "tests/support/session_support.h"

namespace scree {
namespace {

LiveConfig walking_server() {
  LiveConfig config;
  config.world = walking_world();
  config.world.spawn = Spawn{{0.0F, 2.0F, 0.0F}};
  return config;
}

/// Steps until the client's person is on foot.
bool put_on_foot(LoopbackSession& session, SessionClient& client) {
  client.send(StandMessage{{}, 900});
  for (int tick = 0; tick < 600 && !client.mirror().own_person(); ++tick)
    if (!session.step()) return false;
  return client.mirror().own_person().has_value();
}

/// The name of the refusal of a request.
std::string refusal_of(LoopbackSession& session, SessionClient& client, uint32_t request) {
  for (int tick = 0; tick < 600 && !client.replies.contains(request); ++tick) session.step();
  return client.replies.contains(request) ? client.replies[request].refusal_name : "no reply";
}

TEST(PersonSession, foresees_the_own_person_and_never_corrects_on_ground_that_lies_still) {
  LoopbackSession session(walking_server());
  ASSERT_EQ(session.failure, "");
  SessionClient& client = session.join({0.0F, 2.0F, 0.0F}, 64.0F);
  SessionClient& other = session.join({0.0F, 2.0F, 0.0F}, 64.0F);
  ASSERT_TRUE(session.steps(60));
  ASSERT_TRUE(put_on_foot(session, client)) << session.failure;
  WalkPrediction walk(60);
  walk.follow(client.mirror());
  ASSERT_TRUE(walk.on_foot());
  // At the pace of a server: a person whose inputs are too late stands still, and that is a correction.
  constexpr int walking = 150, still = 60, waiting = 6;
  for (int tick = 0; tick < walking + still; ++tick) {
    WalkInput input{{1.0F, 0.0F, tick % 60 < 30 ? 0.5F : -0.5F}, tick > 75, tick % 50 == 0};
    if (tick >= walking) input = {};
    const auto message = walk.step(input, {1.0F, 0.0F, 0.0F}, client.mirror());
    ASSERT_TRUE(message.has_value());
    client.send(*message);
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    ASSERT_TRUE(session.step()) << session.failure;
    walk.follow(client.mirror());
  }
  for (int tick = 0; tick < waiting; ++tick) {
    ASSERT_TRUE(session.step());
    walk.follow(client.mirror());
  }
  EXPECT_EQ(walk.corrections().count, 0U) << walk.corrections().worst_m << " m";
  EXPECT_GT(walk.walker().feet_m().x, 8.0F);
  EXPECT_EQ(client.mirror().own_person()->walker.feet_m, walk.walker().feet_m());
  // The other one knows whose body it sees, and where it is.
  ASSERT_EQ(other.mirror().persons().size(), 1U);
  const auto [body, whose] = *other.mirror().persons().begin();
  EXPECT_EQ(whose, client.client().welcome()->session);
  ASSERT_TRUE(other.mirror().props().contains(body));
  const glm::vec3 seen_m = other.mirror().props().at(body).to.position_m;
  EXPECT_LT(glm::distance(seen_m, walk.walker().feet_m() + glm::vec3(0.0F, 0.85F, 0.0F)), 0.02F);
  EXPECT_FALSE(other.mirror().own_person().has_value());
}

TEST(PersonSession, is_corrected_where_it_was_wrong) {
  LoopbackSession session(walking_server());
  SessionClient& client = session.join({0.0F, 2.0F, 0.0F}, 64.0F);
  ASSERT_TRUE(session.steps(60));
  ASSERT_TRUE(put_on_foot(session, client));
  WalkPrediction walk(60);
  walk.follow(client.mirror());
  for (int tick = 0; tick < 60; ++tick) {
    auto message = walk.step({.go = {1.0F, 0.0F, 0.0F}}, {1.0F, 0.0F, 0.0F}, client.mirror());
    ASSERT_TRUE(message.has_value());
    if (tick == 30) message->input.go = {-1.0F, 0.0F, 0.0F};  // another one than was foreseen
    client.send(*message);
    ASSERT_TRUE(session.step());
    walk.follow(client.mirror());
  }
  for (int tick = 0; tick < 14; ++tick) {
    ASSERT_TRUE(session.step());
    walk.follow(client.mirror());
  }
  EXPECT_GE(walk.corrections().count, 1U);
  EXPECT_EQ(client.mirror().own_person()->walker.feet_m, walk.walker().feet_m());
}

TEST(PersonSession, edits_from_where_its_person_is_whatever_it_says) {
  LoopbackSession session(walking_server());
  SessionClient& client = session.join({0.0F, 2.0F, 0.0F}, 64.0F);
  SessionClient& looker = session.join({0.0F, 2.0F, 0.0F}, 64.0F);
  ASSERT_TRUE(session.steps(60));
  ASSERT_TRUE(put_on_foot(session, client));
  const FillRequest far{sphere({200.0F, 0.0F, 0.0F}, 1.0F)};
  client.set_eye({200.0F, 2.0F, 0.0F});
  client.send(CursorMessage{{200.0F, 2.0F, 0.0F}, {200.0F, 0.0F, 0.0F}});
  client.send(FillMessage{far, 901});
  EXPECT_EQ(refusal_of(session, client, 901), "reach");
  client.send(FillMessage{{sphere({4.0F, 0.0F, 0.0F}, 1.0F)}, 902});
  EXPECT_EQ(refusal_of(session, client, 902), "");
  looker.send(FillMessage{{sphere({4.0F, 0.0F, 3.0F}, 1.0F)}, 903});
  EXPECT_EQ(refusal_of(session, looker, 903), "not_on_foot");
  // A place to stand is nobody's to choose but a director's.
  looker.send(StandMessage{{glm::vec3(90.0F, 1.0F, 0.0F)}, 904});
  EXPECT_EQ(refusal_of(session, looker, 904), "");
  ASSERT_TRUE(session.steps(6));
  ASSERT_TRUE(looker.mirror().own_person().has_value());
  EXPECT_LT(glm::length(looker.mirror().own_person()->walker.feet_m), 5.0F);
}

TEST(PersonSession, has_a_reach_and_a_sight_or_none) {
  LiveConfig config = walking_server();
  config.world.service.persons = Persons::fly;
  config.world.service.reach_m = 0.0;
  config.world.service.sight = true;
  LoopbackSession session(config);
  SessionClient& client = session.join({0.0F, 30.0F, 0.0F}, 64.0F);
  ASSERT_TRUE(session.steps(60));
  client.send(FillMessage{{sphere({300.0F, 0.5F, 0.0F}, 1.0F)}, 901});
  EXPECT_EQ(refusal_of(session, client, 901), "") << "no reach";
  client.send(FillMessage{{sphere({0.0F, -9.0F, 0.0F}, 1.0F)}, 902});
  EXPECT_EQ(refusal_of(session, client, 902), "out_of_sight") << "below the ground";
}

/// Two bots walk at random over a slow link, in real time.
TEST(PersonSession, walks_over_a_slow_link_without_corrections_or_rock) {
  LiveConfig config = walking_server();
  config.net.port = 0;
  auto server = LiveServer::start(config);
  ASSERT_TRUE(server.has_value()) << server.error().message;
  std::array<BotReport, 2> reports;
  std::vector<std::thread> bots;
  for (size_t i = 0; i < reports.size(); ++i)
    bots.emplace_back([&, i] {
      BotConfig bot;
      bot.port = (*server)->port();
      bot.carves = 0;
      bot.walks = 5;
      bot.random_seed = i + 1;
      bot.at_spawn = true;
      bot.link = *read_link("delay=100ms,jitter=30ms");
      reports[i] = Bot(bot).run();
    });
  for (std::thread& bot : bots) bot.join();
  EXPECT_TRUE((*server)->stop().has_value());
  for (const BotReport& report : reports) {
    EXPECT_EQ(report.failure, "");
    EXPECT_EQ(report.walks.done, 5U);
    EXPECT_EQ(report.walks.refused, 0U);
    EXPECT_LE(report.walks.depth_worst_m, Walker::skin_m + 1e-3F);
    EXPECT_LE(report.walks.corrections, 3U) << report.walks.correction_worst_m << " m";
  }
}

TEST(PersonSession, a_bot_that_may_never_stand_gives_up_with_the_servers_words) {
  LiveConfig config = walking_server();
  config.net.port = 0;
  config.world.service.persons = Persons::fly;
  auto server = LiveServer::start(config);
  ASSERT_TRUE(server.has_value()) << server.error().message;
  BotConfig bot;
  bot.port = (*server)->port();
  bot.carves = 0;
  bot.walks = 5;
  const BotReport report = Bot(bot).run();
  EXPECT_NE(report.failure.find("persons_fly"), std::string::npos) << report.failure;
  EXPECT_TRUE((*server)->stop().has_value());
}

}  // namespace
}  // namespace scree
