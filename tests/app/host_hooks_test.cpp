// A host's own rules in a live server: it refuses, changes and adds commands, reads the world, and hears of
// ticks and lines. The recording holds the commands that it let through.
#include "server/host/host_hooks.h"

#include <gtest/gtest.h>
#include <thread>

#include "server/app/live_server.h"
#include "server/replay/verify.h"
#include "server/store/recording_reader.h"
#include "server/world/limits.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/raw_client.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

CarveRequest hosted_carve(float x_m, float radius_m = 1.0F) {
  CarveRequest carve;
  carve.shape = sphere({x_m, 0.0F, 0.0F}, radius_m);
  carve.seeds = 6;
  carve.random_seed = 7;
  carve.impact_m = {x_m, 1.0F, 0.0F};
  return carve;
}

class HostHooksTest : public ::testing::Test {
 protected:
  void SetUp() override {
    config.world.terrain = flat_terrain;
    config.pacing = Pacing::by_hand;
  }
  void start() {
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started.has_value()) << started.error().message;
    server = std::move(*started);
  }
  std::unique_ptr<RawClient> join(const std::string& name = "Ann") {
    auto client = std::make_unique<RawClient>(server->port());
    HelloMessage hello{protocol_version, "test", {0.0F, 2.0F, 0.0F}, 64.0F};
    hello.name = name;
    hello.meets = true;
    EXPECT_TRUE(client->send(hello));
    EXPECT_TRUE(client->receive_as<WelcomeMessage>().has_value());
    return client;
  }
  /// The answer of a tick to the client's carve, whose number is 1.
  ReplyMessage answer(RawClient& client, const CarveRequest& carve) {
    EXPECT_TRUE(client.send(CarveMessage{{carve}, 1}));
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (std::chrono::steady_clock::now() < deadline) {
      EXPECT_TRUE(server->step_once());
      if (auto reply = client.receive_as<ReplyMessage>(std::chrono::milliseconds(5))) return *reply;
    }
    ADD_FAILURE() << "no answer";
    return {};
  }

  const TestFolder folder;
  LiveConfig config;
  std::unique_ptr<LiveServer> server;
};

TEST_F(HostHooksTest, a_refused_command_changes_nothing_and_its_client_gets_the_hosts_words) {
  std::string name;
  config.hooks.before = [&](const World&, TickCommands& commands) {
    for (size_t i = 0; i < commands.all().size(); ++i) commands.refuse(i, "not on a Sunday", name);
  };
  start();
  const auto client = join();
  ReplyMessage reply = answer(*client, hosted_carve(0.0F));
  EXPECT_EQ(reply.refusal, "not on a Sunday");
  EXPECT_EQ(reply.refusal_name, "host");
  EXPECT_GT(reply.tick, 0U);
  name = "sunday";
  reply = answer(*client, hosted_carve(0.0F));
  EXPECT_EQ(reply.refusal_name, "game:sunday");
  EXPECT_EQ(server->world()->field().edited_brick_count(), 0U);
  EXPECT_EQ(server->report().net.refusals.of(Refusal::host), 2U);
}

TEST_F(HostHooksTest, a_rule_reads_the_world_and_changes_what_a_client_asks_for) {
  config.hooks.before = [](const World& world, TickCommands& commands) {
    for (size_t i = 0; i < commands.all().size(); ++i) {
      const auto* carve = std::get_if<CarveRequest>(&commands.all()[i].body);
      if (carve == nullptr) continue;
      const glm::vec3 centre_voxels = centre_of(carve->shape) / voxel_m;
      const float distance =
          sample(world.field(), centre_voxels - glm::vec3(0.0F, 1.0F, 0.0F)).distance_voxels;
      if (distance > 0.0F) {
        commands.refuse(i, "there is nothing to carve");
        continue;
      }
      CarveRequest tamed = *carve;
      tamed.seeds = 2;
      commands.change(i, tamed);
    }
  };
  start();
  const auto client = join();
  EXPECT_EQ(answer(*client, hosted_carve(0.0F)).pieces, 2U);
  EXPECT_EQ(answer(*client, hosted_carve(0.0F)).refusal, "there is nothing to carve");
}

TEST_F(HostHooksTest, a_recording_holds_what_the_host_let_through_and_verifies_without_it) {
  config.record_path = folder / "session";
  uint32_t refused = 0;
  config.hooks.before = [&](const World& world, TickCommands& commands) {
    for (size_t i = 0; i < commands.all().size(); ++i) {
      const Command& command = commands.all()[i];
      if (command.request % 3 == 0) {
        ++refused;
        commands.refuse(i, "every third is too much");
      } else if (command.request % 3 == 1) {
        CarveRequest tamed = std::get<CarveRequest>(command.body);
        tamed.seeds = 3;
        commands.change(i, tamed);
      }
    }
    if (world.tick() % 20 == 5)
      commands.add(hosted_carve(12.0F + static_cast<float>(world.tick() % 7)), 1000);
  };
  start();
  for (uint32_t request = 1; request <= 9; ++request) {
    ASSERT_TRUE(server->push({0, request, hosted_carve(-2.0F * static_cast<float>(request))}));
    for (int tick = 0; tick < 8; ++tick) ASSERT_TRUE(server->step_once());
  }
  const auto stopped = server->stop();
  ASSERT_TRUE(stopped.has_value()) << stopped.error().message;
  EXPECT_EQ(refused, 3U);
  auto reader = RecordingReader::open(config.record_path);
  ASSERT_TRUE(reader.has_value()) << reader.error().message;
  uint32_t let_through = 0, added = 0;
  for (Tick tick = 1; tick <= (*reader)->last_tick(); ++tick) {
    const auto commands = (*reader)->commands(tick);
    ASSERT_TRUE(commands.has_value()) << commands.error().message;
    for (const Command& command : *commands) {
      added += command.request == 1000 ? 1 : 0;
      if (command.request == 1000) continue;
      ++let_through;
      EXPECT_NE(command.request % 3, 0U) << "the host refused it";
      EXPECT_EQ(std::get<CarveRequest>(command.body).seeds, command.request % 3 == 1 ? 3U : 6U);
    }
  }
  EXPECT_EQ(let_through, 6U);
  EXPECT_EQ(added, 4U);
  const auto report = verify(**reader);
  ASSERT_TRUE(report.has_value()) << report.error().message;
  EXPECT_TRUE(report->agrees()) << report->difference;
  EXPECT_EQ(report->field_hash, server->world()->field().hash());
}

TEST_F(HostHooksTest, after_gets_each_tick_with_the_replies_to_the_hosts_commands_and_to_refused_ones) {
  std::vector<Tick> ticks;
  std::vector<Reply> replies;
  config.hooks.before = [](const World&, TickCommands& commands) {
    for (size_t i = 0; i < commands.all().size(); ++i)
      if (commands.all()[i].request == 2) commands.refuse(i, "no");
  };
  config.hooks.after = [&](const TickDelta& delta) {
    ticks.push_back(delta.tick);
    replies.insert(replies.end(), delta.replies.begin(), delta.replies.end());
  };
  start();
  std::thread([&] {
    EXPECT_TRUE(server->push({0, 1, hosted_carve(0.0F)}));
    EXPECT_TRUE(server->push({0, 2, hosted_carve(4.0F)}));
  }).join();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(server->step_once());
  EXPECT_EQ(ticks, (std::vector<Tick>{1, 2, 3}));
  ASSERT_EQ(replies.size(), 2U);
  EXPECT_EQ(replies[0].request, 1U);
  EXPECT_EQ(replies[0].pieces, 6U);
  EXPECT_EQ(replies[1].request, 2U);
  EXPECT_EQ(replies[1].refusal, "no");
  ASSERT_TRUE(server->stop().has_value());
  EXPECT_FALSE(server->push({0, 3, hosted_carve(0.0F)})) << "nobody would carry it out";
}

TEST_F(HostHooksTest, edits_that_the_host_refuses_reserve_no_memory) {
  config.world.memory_max_mb = limits::memory_max_min_mb;
  config.hooks.before = [](const World&, TickCommands& commands) {
    for (size_t i = 0; i < commands.all().size(); ++i)
      if (commands.all()[i].request == 2) commands.refuse(i, "no");
  };
  std::vector<Reply> replies;
  config.hooks.after = [&](const TickDelta& delta) {
    replies.insert(replies.end(), delta.replies.begin(), delta.replies.end());
  };
  start();
  for (int at = 0; at < 600; ++at) {
    const glm::vec3 centre_m{static_cast<float>(40 * (at % 40) - 800), 0.0F,
                             static_cast<float>(40 * (at / 40))};
    ASSERT_TRUE(server->push({0, 2, PaintRequest{box(centre_m, glm::vec3(4.6F)), material::ice}}));
    if (at % 10 == 9) {
      ASSERT_TRUE(server->step_once());
    }
  }
  ASSERT_EQ(replies.size(), 600U);
  for (const Reply& reply : replies) ASSERT_EQ(reply.refusal, "no");
  ASSERT_TRUE(server->push({0, 1, PaintRequest{box(glm::vec3(0.0F), glm::vec3(4.6F)), material::ice}}));
  ASSERT_TRUE(server->step_once());
  ASSERT_EQ(replies.size(), 601U);
  EXPECT_EQ(replies.back().refusal, "") << "there is room for it";
}

TEST_F(HostHooksTest, a_line_that_the_host_keeps_is_heard_by_nobody) {
  std::vector<std::string> kept;
  config.hooks.said = [&](const SaidMessage& line) {
    const bool is_order = line.text.starts_with("/");
    if (is_order) kept.push_back(line.name + " " + line.text);
    return !is_order;
  };
  start();
  const auto ann = join("Ann"), bob = join("Bob");
  ASSERT_TRUE(ann->send(SayMessage{"/restart"}));
  ASSERT_TRUE(ann->send(SayMessage{"good morning"}));
  for (RawClient* const person : {ann.get(), bob.get()}) {
    const auto heard = person->receive_as<SaidMessage>();
    ASSERT_TRUE(heard.has_value());
    EXPECT_EQ(heard->text, "good morning");
  }
  ASSERT_TRUE(server->stop().has_value());
  EXPECT_EQ(kept, std::vector<std::string>{"Ann /restart"});
}

TEST_F(HostHooksTest, a_replay_takes_no_commands_of_its_host) {
  config.record_path = folder / "session";
  start();
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(server->step_once());
  ASSERT_TRUE(server->stop().has_value());
  LiveConfig replay;
  replay.pacing = Pacing::by_hand;
  replay.replay.path = config.record_path;
  replay.hooks.before = [](const World&, TickCommands&) {};
  const auto refused = LiveServer::start(replay);
  ASSERT_FALSE(refused.has_value());
  EXPECT_NE(refused.error().message.find("replay"), std::string::npos);
  replay.hooks.before = nullptr;
  Tick last = 0;
  replay.hooks.after = [&](const TickDelta& delta) { last = delta.tick; };
  const auto played = LiveServer::start(replay);
  ASSERT_TRUE(played.has_value()) << played.error().message;
  EXPECT_TRUE((*played)->step_once());
  EXPECT_GT(last, 0U);
  EXPECT_FALSE((*played)->push({0, 1, hosted_carve(0.0F)}));
}

TEST_F(HostHooksTest, what_a_host_must_not_do_is_checked) {
  TickCommands commands({{7, 1, hosted_carve(0.0F)}, {7, 2, LeaveRequest{}}});
  EXPECT_DEATH(commands.refuse(2, "no"), "CHECK failed: index < commands_.size\\(\\) \\(2, 2\\)");
  EXPECT_DEATH(commands.refuse(0, ""), "a refusal without words");
  EXPECT_DEATH(commands.refuse(0, "no", "Not this"), "a refusal's name");
  EXPECT_DEATH(commands.refuse(0, "no", std::string(host_name_bytes_max + 1, 'a')), "a refusal's name");
  EXPECT_DEATH(commands.refuse(1, "no"), "a session that leaves");
  EXPECT_DEATH(commands.change(1, hosted_carve(0.0F)), "network side");
  EXPECT_DEATH(commands.change(0, LeaveRequest{}), "network side");
  EXPECT_DEATH(commands.add(LeaveRequest{}), "network side");
  start();
  EXPECT_DEATH(static_cast<void>(server->push({7, 1, hosted_carve(0.0F)})), "CHECK failed: command.session");
  EXPECT_DEATH(static_cast<void>(server->push({0, 1, LeaveRequest{}})), "the host is not a session");
}

TEST(TickCommands, keep_their_order_and_their_clients) {
  TickCommands commands({{7, 1, hosted_carve(0.0F)}, {8, 2, hosted_carve(1.0F)}, {9, 3, LeaveRequest{}}});
  commands.refuse(0, "no");
  commands.change(1, hosted_carve(5.0F));
  commands.add(hosted_carve(6.0F), 4);
  EXPECT_TRUE(commands.is_refused(0));
  EXPECT_FALSE(commands.is_refused(3));
  const std::vector<Command> wanted{
      {8, 2, hosted_carve(5.0F)}, {9, 3, LeaveRequest{}}, {0, 4, hosted_carve(6.0F)}};
  EXPECT_EQ(commands.let_through(), wanted);
  const std::vector<Reply> refused = commands.refused();
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(refused[0].session, 7U);
  EXPECT_EQ(refused[0].request, 1U);
  EXPECT_EQ(refusal_name(refused[0]), "host");
}

}  // namespace
}  // namespace scree
