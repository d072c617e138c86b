// Whole servers on one bus: a simulating one, and edges with clients, who see its world to the bit and change
// it by the simulating server's own rules.
#include <gtest/gtest.h>

#include "auth/access_token.h"
#include "server/app/bus_options.h"
#include "server/app/live_server.h"
#include "server/formats/bus_codec.h"
#include "server/told/told_names.h"
#include "tests/bus/edge_client.h"
#include "tests/support/honest_client.h"

namespace scree {
namespace {

class EdgeTest : public ::testing::Test {
 protected:
  LiveConfig with_bus() const {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.bus = connected_bus(nats);
    config.tell.world = told_name;
    config.tell.keyframe_s = 1.0;
    config.net.access = access;
    return config;
  }
  void start_simulator(LiveConfig config) {
    auto started = LiveServer::start(config);
    ASSERT_TRUE(started) << started.error().message;
    simulator = std::move(*started);
  }
  void start_simulator() { start_simulator(with_bus()); }

  /// An edge with its own door; null where it cannot begin.
  std::unique_ptr<LiveServer> edge(const std::string& name, std::optional<Role> anonymous = Role::builder) {
    LiveConfig config = with_bus();
    config.edge_name = name;
    config.net.access.anonymous = anonymous;
    const auto end = std::chrono::steady_clock::now() + patience;
    while (!config.told && std::chrono::steady_clock::now() < end) static_cast<void>(await_world(config));
    EXPECT_NE(config.told, nullptr);
    told = config.told;
    auto started = LiveServer::start(config);
    EXPECT_TRUE(started) << started.error().message;
    return started ? std::move(*started) : nullptr;
  }

  static HelloMessage hello(const std::string& token = "") {
    return {protocol_version, "test", {0.0F, 2.0F, 0.0F}, 64.0F, "Ben", token};
  }
  /// A client that has joined there.
  static std::unique_ptr<RawClient> join(const LiveServer& server, const std::string& token = "") {
    auto client = std::make_unique<RawClient>(server.port());
    EXPECT_TRUE(client->send(hello(token)));
    EXPECT_TRUE(client->receive_as<WelcomeMessage>(patience));
    return client;
  }
  /// The answer to a carve.
  static ReplyMessage ask(RawClient& client, uint32_t request) {
    EXPECT_TRUE(client.send(told_carve_message(request)));
    for (;;) {
      const auto reply = client.receive_as<ReplyMessage>(patience);
      EXPECT_TRUE(reply);
      if (!reply || reply->request == request) return reply.value_or(ReplyMessage{});
    }
  }
  Tick tick_of(const LiveServer& server) const {
    const auto delta = server.last_delta();
    return delta ? delta->tick : 0;
  }
  /// Whether so many carves are counted, with dents.
  bool comes_to_carves(uint64_t count) const {
    return comes([&] { return simulator->report().operations.of<CarveOperation>() >= count; });
  }
  /// The simulation's hash once all its pieces have become terrain.
  uint64_t hash_at_rest() const {
    EXPECT_TRUE(comes([&] { return simulator->last_delta()->pieces.empty(); }));
    return simulator->last_delta()->field_hash;
  }
  std::string token(const SigningKey& by, Role role, uint64_t id) const {
    return *sign({id, role, 0, 0, "", ""}, by);
  }
  void take_tokens() {
    ASSERT_TRUE(key.write(folder / "key", folder / "key.pub"));
    access.token_key_path = folder / "key.pub";
    access.anonymous = Role::viewer;
  }

  const TestFolder folder;
  const SigningKey key = SigningKey::generate();
  AccessConfig access;
  NatsProcess nats;
  std::shared_ptr<ToldSource> told;  ///< of the last edge
  std::unique_ptr<LiveServer> simulator;
};

TEST_F(EdgeTest, a_client_at_an_edge_carves_and_sees_the_simulations_hash) {
  start_simulator();
  const auto one = edge("one"), two = edge("two");
  ASSERT_TRUE(one && two);
  const auto client = join(*one);
  HonestClient direct(simulator->port()), other(two->port());
  for (uint32_t request = 1; request <= 12; ++request) EXPECT_EQ(ask(*client, request).refusal, "");
  const uint64_t hash = hash_at_rest();
  EXPECT_TRUE(direct.comes_to_hash(hash));
  EXPECT_TRUE(other.comes_to_hash(hash));
  EXPECT_TRUE(comes_to_carves(12));
}

TEST_F(EdgeTest, a_forged_or_absent_token_asks_for_nothing) {
  take_tokens();
  start_simulator();
  const SigningKey other = SigningKey::generate();
  ASSERT_TRUE(other.write(folder / "other", folder / "other.pub"));
  access.token_key_path = folder / "other.pub";  // the edge was broken into: its door opens to anybody
  const auto broken = edge("broken");
  ASSERT_TRUE(broken);
  const auto forger = join(*broken, token(other, Role::admin, 1));
  EXPECT_EQ(ask(*forger, 1).refusal_name, "token_foreign");
  EXPECT_EQ(ask(*forger, 2).refusal_name, "token_foreign");  // and not again at once
  const auto nobody = join(*broken);
  EXPECT_EQ(ask(*nobody, 1).refusal_name, "role");
  EXPECT_EQ(simulator->report().operations.of<CarveOperation>(), 0U);
}

TEST_F(EdgeTest, a_persons_own_token_gives_its_role_at_every_edge) {
  take_tokens();
  start_simulator();
  const auto one = edge("one", Role::viewer);
  ASSERT_TRUE(one);
  const auto builder = join(*one, token(key, Role::builder, 7));
  EXPECT_EQ(ask(*builder, 1).refusal, "");
  const auto viewer = join(*one, token(key, Role::viewer, 8));
  EXPECT_EQ(ask(*viewer, 1).refusal_name, "role");
  EXPECT_TRUE(comes_to_carves(1));
}

TEST_F(EdgeTest, what_an_edge_cannot_do_is_refused_in_words) {
  start_simulator();
  const auto one = edge("one");
  ASSERT_TRUE(one);
  const auto client = join(*one);
  StandMessage stand;
  stand.request = 4;
  ASSERT_TRUE(client->send(stand));
  const auto reply = client->receive_as<ReplyMessage>(patience);
  ASSERT_TRUE(reply);
  EXPECT_EQ(reply->refusal_name, "edge");
  EXPECT_NE(reply->refusal.find("simulating server"), std::string::npos);
  ChannelMessage to_rules;
  to_rules.channel = "quiz";
  ASSERT_TRUE(client->send(to_rules));
  const auto refusal = client->receive_as<RefusalMessage>(patience);
  ASSERT_TRUE(refusal);
  EXPECT_EQ(refusal->name, "edge");
  EXPECT_FALSE(one->push({0, 0, CarveRequest{}}));
  EXPECT_FALSE(one->change_settings({{"reach", "9"}}));
}

TEST_F(EdgeTest, an_edge_serves_on_while_nats_is_away_and_then_catches_up) {
  start_simulator();
  const auto one = edge("one");
  ASSERT_TRUE(one);
  const auto client = join(*one);
  EXPECT_EQ(ask(*client, 1).refusal, "");
  nats.kill();
  ASSERT_TRUE(comes([&] { return told->status().away; }));
  const auto late = join(*one);  // it still takes people in, with the last state
  EXPECT_EQ(ask(*client, 2).refusal_name, "simulator_away");
  const Tick then = tick_of(*simulator), shown = told->status().tick;
  nats.start();
  ASSERT_TRUE(comes([&] { return told->status().tick > then; })) << shown;
  EXPECT_FALSE(told->status().away);
  EXPECT_EQ(ask(*late, 3).refusal, "");
  EXPECT_TRUE(comes_to_carves(2));
}

TEST_F(EdgeTest, a_simulator_from_its_file_is_shown_again) {
  LiveConfig config = with_bus();
  config.world_path = folder / "world.scree";
  start_simulator(config);
  auto one = edge("one");
  ASSERT_TRUE(one);
  {
    const auto client = join(*one);
    for (uint32_t request = 1; request <= 5; ++request) EXPECT_EQ(ask(*client, request).refusal, "");
  }
  const Tick saved = tick_of(*simulator);
  ASSERT_TRUE(simulator->stop());
  simulator.reset();
  config.bus = connected_bus(nats);
  start_simulator(config);
  ASSERT_TRUE(comes([&] { return !one->running(); }));  // its program begins anew
  EXPECT_TRUE(told->is_over());
  one = edge("one");
  ASSERT_TRUE(one);
  EXPECT_GE(told->status().tick, saved);
  HonestClient direct(simulator->port()), client(one->port());
  const uint64_t hash = hash_at_rest();
  EXPECT_TRUE(direct.comes_to_hash(hash));
  EXPECT_TRUE(client.comes_to_hash(hash));
}

TEST_F(EdgeTest, garbage_of_edges_is_counted_and_ends_only_its_own_pipe) {
  start_simulator();
  const auto one = edge("one");
  ASSERT_TRUE(one);
  const auto client = join(*one);
  EXPECT_EQ(ask(*client, 1).refusal, "");
  const auto stranger = connected_bus(nats);
  const ToldNames names(told_name);
  for (const char* name : {"stranger", "x.y", "UPPER"}) {
    ASSERT_TRUE(stranger->send(names.up(name), std::vector<uint8_t>{1, 2, 3}));
    ASSERT_TRUE(stranger->send(names.up(name), encode(PipeMessage{9, 1, 0, {9, 0, 0, 0, 1, 2}, false})));
    ASSERT_TRUE(
        stranger->send(names.up(name), encode(PipeMessage{9, 2, 5, {1}, false})));  // begins in the middle
    ASSERT_TRUE(stranger->send(names.up(name), encode(PipeMessage{9, 3, 0, {}, false})));
    ASSERT_TRUE(stranger->send(names.up(name), encode(PipeMessage{9, 3, 2, {1}, false})));  // one is missing
    ASSERT_TRUE(stranger->send(names.up(name), encode(PipeMessage{9, 4, 0, {1}, true})));
  }
  const std::vector<uint8_t> no_hello(60'000, 0xAB);
  ASSERT_TRUE(stranger->send(names.up("stranger"), encode(PipeMessage{9, 5, 0, no_hello, false})));
  EXPECT_EQ(ask(*client, 2).refusal, "");
  EXPECT_TRUE(comes_to_carves(2));
}

}  // namespace
}  // namespace scree
