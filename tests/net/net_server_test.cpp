// Misbehaving clients on loopback: each is told what was wrong, and the well-behaved one beside it goes on.
#include "server/net/net_server.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <string>

#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"

namespace scree {
namespace {

TEST_F(NetServerTest, welcome_says_what_a_client_needs_to_know) {
  start([](NetConfig& config) { config.tick_rate_hz = 30; });
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  const auto welcome = client.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome.has_value());
  EXPECT_EQ(welcome->protocol, protocol_version);
  EXPECT_EQ(welcome->tick_rate_hz, 30U);
  EXPECT_EQ(welcome->terrain, flat_terrain);
  EXPECT_FLOAT_EQ(welcome->interest_radius_m, 64.0F);
  tick({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 4)});
  const auto frame = client.receive_as<FrameMessage>();
  ASSERT_TRUE(frame.has_value());
  EXPECT_EQ(frame->operations.size(), 1U);
}

TEST_F(NetServerTest, wrong_protocol_version_is_refused_naming_both) {
  start();
  for (const uint32_t version : {protocol_version - 1, 77U}) {
    RawClient client(server->port());
    ASSERT_TRUE(client.send(hello(version)));
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal.has_value());
    EXPECT_TRUE(holds(refusal->reason, "server speaks protocol version " + std::to_string(protocol_version) +
                                           ", the client version " + std::to_string(version)));
    EXPECT_TRUE(client.closed_within(seconds(10)));
  }
  expect_witness_unmoved();
}

TEST_F(NetServerTest, garbage_is_refused) {
  start();
  RawClient client(server->port());
  const std::vector<uint8_t> garbage{12, 0, 0, 0, 0xFF, 0xFF, 0xFF, 0xFF, 0x01, 2, 3, 4, 5, 6, 7, 8};
  ASSERT_TRUE(client.send_bytes(garbage));
  expect_refused(client, "not a protobuf of this protocol");
}

TEST_F(NetServerTest, message_cut_short_is_refused) {
  start();
  RawClient client(server->port());
  const std::vector<uint8_t> whole = encode(ClientMessage(hello()));
  ASSERT_TRUE(client.send_bytes(std::span(whole).first(whole.size() - 3)));
  client.finish_sending();
  expect_refused(client, "middle of a message");
}

TEST_F(NetServerTest, silent_connection_is_refused_in_the_end) {
  start([](NetConfig& config) { config.hello_seconds = 1.0; });  // the witness needs some
  RawClient client(server->port());
  expect_refused(client, "no hello within");
}

TEST_F(NetServerTest, request_before_hello_is_refused) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(CarveMessage{}));
  expect_refused(client, "must be a hello");
}

TEST_F(NetServerTest, second_hello_is_refused) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  ASSERT_TRUE(client.send(hello()));
  expect_refused(client, "joined already");
}

TEST_F(NetServerTest, too_many_sessions_are_refused_naming_the_limit) {
  start([](NetConfig& config) { config.service.sessions_max = 2; });
  RawClient second(server->port());
  ASSERT_TRUE(second.send(hello()));
  ASSERT_TRUE(second.receive_as<WelcomeMessage>().has_value());
  RawClient third(server->port());
  ASSERT_TRUE(third.send(hello()));
  expect_refused(third, "2 sessions");
}

TEST_F(NetServerTest, port_in_use_is_said_in_words) {
  start();
  NetConfig config;
  config.port = server->port();
  const auto second = NetServer::listen(config, commands, TickDelta());
  ASSERT_FALSE(second.has_value());
  EXPECT_NE(second.error().message.find("in use"), std::string::npos) << second.error().message;
  EXPECT_NE(second.error().message.find(std::to_string(config.port)), std::string::npos);
  expect_witness_unmoved();
}

TEST_F(NetServerTest, bind_address_that_is_none_is_said_in_words) {
  NetConfig config;
  config.bind = "nowhere";
  const auto listening = NetServer::listen(config, commands, TickDelta());
  ASSERT_FALSE(listening.has_value());
  EXPECT_NE(listening.error().message.find("nowhere"), std::string::npos);
}

TEST_F(NetServerTest, a_client_that_moves_gets_what_is_near_it_now) {
  start();
  tick({source.carve({400.0F, 0.0F, 0.0F}, 1.0F, 4)});
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  ASSERT_TRUE(client.receive_as<WelcomeMessage>().has_value());
  ASSERT_TRUE(client.send(InterestMessage{{400.0F, 2.0F, 0.0F}, 64.0F}));
  std::optional<ChunkMessage> chunk;
  const auto deadline = std::chrono::steady_clock::now() + seconds(10);
  while (!chunk && std::chrono::steady_clock::now() < deadline) {
    tick();
    chunk = client.receive_as<ChunkMessage>(milliseconds(5));
  }
  ASSERT_TRUE(chunk.has_value());
  EXPECT_NEAR(chunk->chunk.x, 50, 1);
}

TEST_F(NetServerTest, requests_over_the_rate_get_a_reply_each) {
  start([](NetConfig& config) { config.service.requests_per_second = 1.0; });
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  for (uint32_t i = 1; i <= 8; ++i) ASSERT_TRUE(client.send(carve(i)));
  const auto reply = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(reply.has_value());
  EXPECT_NE(reply->refusal.find("1 requests a second"), std::string::npos) << reply->refusal;
  expect_witness_unmoved();
}

TEST_F(NetServerTest, a_tick_that_grants_fewer_requests_holds_for_who_is_connected) {
  start([](NetConfig& config) { config.service.requests_per_second = 1000.0; });
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  ASSERT_TRUE(client.receive_as<WelcomeMessage>().has_value());
  TickDelta delta = *source.step();
  delta.service = ServiceLimits{.requests_per_second = 0.25};
  server->publish(std::make_shared<const TickDelta>(delta));
  server->flush();
  for (uint32_t i = 1; i <= 2; ++i) ASSERT_TRUE(client.send(carve(i)));
  const auto reply = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(reply.has_value());
  EXPECT_EQ(reply->request, 2U) << "one is granted at once, however few a second";
  EXPECT_NE(reply->refusal.find("0.25 requests a second (requests-per-second)"), std::string::npos)
      << reply->refusal;
}

TEST_F(NetServerTest, a_tick_that_grants_fewer_sessions_refuses_new_ones_and_ends_none) {
  start();
  TickDelta delta = *source.step();
  delta.service = ServiceLimits{.sessions_max = 1};
  server->publish(std::make_shared<const TickDelta>(delta));
  server->flush();
  RawClient second(server->port());
  ASSERT_TRUE(second.send(hello()));
  expect_refused(second, "1 sessions (sessions-max)");
}

TEST_F(NetServerTest, full_command_queue_is_answered_naming_the_limit) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  for (uint32_t i = 1; i <= 5; ++i) ASSERT_TRUE(client.send(FillMessage{{sphere({}, 1.0F)}, i}));
  const auto reply = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(reply.has_value());
  EXPECT_EQ(reply->request, 5U);
  EXPECT_NE(reply->refusal.find("4 commands"), std::string::npos) << reply->refusal;
  const std::vector<Command> waiting = commands.drain();
  ASSERT_EQ(waiting.size(), 4U);
  EXPECT_EQ(waiting[3].request, 4U);
  EXPECT_NE(waiting[0].session, 0U);
  expect_witness_unmoved();
}

TEST_F(NetServerTest, carve_of_a_replay_is_refused_by_a_reply) {
  start([](NetConfig& config) { config.replay = true; });
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  const auto welcome = client.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome.has_value());
  EXPECT_TRUE(welcome->replay);
  ASSERT_TRUE(client.send(carve(3)));
  const auto reply = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(reply.has_value());
  EXPECT_NE(reply->refusal.find("recording"), std::string::npos);
  ASSERT_TRUE(client.send(AddPropMessage{{}, 4}));  // which takes another role where no recording is played
  const auto of_prop = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(of_prop.has_value());
  EXPECT_EQ(of_prop->refusal_name, "replay");
}

TEST_F(NetServerTest, client_that_never_reads_is_cut_off_and_no_other_notices) {
  start([](NetConfig& config) { config.stall_seconds = 0.3; });
  RawClient deaf(server->port(), 4096);
  ASSERT_TRUE(deaf.send(hello()));
  tick({source.carve({0.0F, 0.0F, 0.0F}, 2.0F, 64)});
  const auto deadline = std::chrono::steady_clock::now() + seconds(30);
  while (server->stats().sessions_disconnected == 0 && std::chrono::steady_clock::now() < deadline) {
    for (PieceId piece = 1; piece <= 64; ++piece)
      if (source.pieces().contains(piece)) source.move(piece, {0.0F, 0.0625F, 0.0F});
    for (int i = 0; i < 3; ++i) expect_witness_unmoved();
    if (HasFatalFailure()) return;
  }
  EXPECT_EQ(server->stats().sessions_disconnected, 1U);
  EXPECT_EQ(server->stats().sessions, 1U);
  expect_witness_unmoved();
}

TEST_F(NetServerTest, what_waits_for_one_client_is_bounded_whatever_it_is) {
  start([](NetConfig& config) { config.stall_seconds = 1000.0; });
  RawClient deaf(server->port(), 4096);
  ASSERT_TRUE(deaf.send(hello()));
  const auto welcome = deaf.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome.has_value());
  const auto reply_with = [&](size_t bytes) {
    auto delta = std::make_shared<TickDelta>(*source.step());
    const std::string refusal(limits::reason_bytes_max, 'x');
    delta->replies.resize(bytes / refusal.size(), Reply{welcome->session, 1, refusal, 0});
    server->publish(delta);
    server->flush();
  };
  reply_with(limits::outbox_hard_bytes * 3 / 4);
  EXPECT_EQ(server->stats().sessions_disconnected, 0U);
  reply_with(limits::outbox_hard_bytes);
  EXPECT_EQ(server->stats().sessions_disconnected, 1U) << "twice limits.outbox_hard_bytes wait";
  expect_witness_unmoved();
}

TEST_F(NetServerTest, message_flood_is_refused) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  std::vector<uint8_t> flood;
  const std::vector<uint8_t> ack = encode(ClientMessage(AckMessage{1}));
  for (int i = 0; i < 20000; ++i) flood.insert(flood.end(), ack.begin(), ack.end());
  client.send_bytes(flood);
  expect_refused(client, "messages a second");
}

TEST_F(NetServerTest, every_refusal_is_counted_under_its_reason_and_told_in_the_status) {
  start([](NetConfig& config) {
    config.service.sessions_max = 2;
    config.admin_token = "a token of some length";
    config.tick_rate_hz = limits::tick_rate_min_hz;  // a status after ten ticks
  });
  const auto refused_after = [&](const ClientMessage& first, const std::optional<ClientMessage>& second) {
    RawClient client(server->port());
    ASSERT_TRUE(client.send(first));
    if (second) {
      ASSERT_TRUE(client.send(*second));
    }
    ASSERT_TRUE(client.receive_as<RefusalMessage>().has_value());
    ASSERT_TRUE(client.closed_within(seconds(10)));
  };
  refused_after(hello(77), {});
  refused_after(CarveMessage{}, {});
  refused_after(hello(), hello());
  refused_after(hello(), AdminMessage{1, "another token", {}});
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  for (uint32_t i = 1; i <= 7; ++i) ASSERT_TRUE(client.send(carve(i)));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(client.receive_as<ReplyMessage>().has_value());
  refused_after(hello(), {});  // a third session

  auto delta = std::make_shared<TickDelta>(*source.step());
  delta->replies = {{1, 1, "too fast", 0, Refusal::blast_speed}, {1, 2, "", 4, std::nullopt}};
  server->publish(delta);
  for (uint32_t tick = 1; tick < limits::tick_rate_min_hz; ++tick) server->publish(source.step());
  server->flush();
  const NetStats stats = server->stats();
  EXPECT_EQ(stats.refusals.of(Refusal::protocol_version), 1U);
  EXPECT_EQ(stats.refusals.of(Refusal::hello_missing), 1U);
  EXPECT_EQ(stats.refusals.of(Refusal::hello_repeated), 1U);
  EXPECT_EQ(stats.refusals.of(Refusal::admin_token_wrong), 1U);
  EXPECT_EQ(stats.refusals.of(Refusal::sessions_max), 1U);
  EXPECT_EQ(stats.refusals.of(Refusal::commands_waiting), 3U);
  EXPECT_EQ(stats.refusals.of(Refusal::blast_speed), 1U);
  EXPECT_EQ(stats.refusals.total(), stats.sessions_refused + stats.requests_refused + 1);
  const auto status = client.receive_as<StatusMessage>();
  ASSERT_TRUE(status.has_value());
  uint64_t told = 0;
  for (const RefusalCount& refusal : status->refusals) told += refusal.count;
  EXPECT_EQ(told, stats.refusals.total());
  EXPECT_NE(std::ranges::find(status->refusals, RefusalCount{"commands_waiting", 3}), status->refusals.end());
}

TEST_F(NetServerTest, stopping_says_goodbye) {
  start();
  server->stop();
  const auto refusal = witness->receive_as<RefusalMessage>();
  ASSERT_TRUE(refusal.has_value());
  EXPECT_EQ(refusal->reason, "the server stops");
  server->publish(source.step());  // harmless
}

TEST_F(NetServerTest, clients_that_come_and_go_leave_nothing_behind) {
  start();
  for (int i = 0; i < 50; ++i) {
    RawClient client(server->port());
    ASSERT_TRUE(client.send(hello()));
    ASSERT_TRUE(client.receive_as<WelcomeMessage>().has_value());
    tick();
  }
  const auto deadline = std::chrono::steady_clock::now() + seconds(10);
  const auto settled = [&] { return server->stats().sessions_joined == 51 && server->stats().sessions == 1; };
  while (!settled() && std::chrono::steady_clock::now() < deadline) {
    expect_witness_unmoved();
    if (HasFatalFailure()) return;
  }
  EXPECT_TRUE(settled());
}

}  // namespace
}  // namespace scree
