// A network side on loopback, and a well-behaved client beside those that misbehave.
#pragma once

#include <algorithm>
#include <chrono>
#include <functional>
#include <gtest/gtest.h>
#include <memory>
#include <string>
#include <thread>

#include "server/net/net_server.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/raw_client.h"
#include "tests/support/tick_source.h"

namespace scree {

using std::chrono::milliseconds;
using std::chrono::seconds;

inline HelloMessage hello(uint32_t protocol = protocol_version) {
  return {protocol, "test", {0.0F, 2.0F, 0.0F}, 64.0F};
}

inline CarveMessage carve(uint32_t request) {
  CarveMessage message;
  message.request = request;
  message.shape = sphere({}, 1.0F);
  return message;
}

class NetServerTest : public ::testing::Test {
 protected:
  void start(const std::function<void(NetConfig&)>& change = {}) {
    NetConfig config;
    config.terrain = flat_terrain;
    config.heartbeat_s = 0.0;
    if (change) change(config);
    auto listening = NetServer::listen(config, commands, source.keyframe());
    ASSERT_TRUE(listening.has_value()) << listening.error().message;
    server = std::move(*listening);
    witness = std::make_unique<RawClient>(server->port());
    ASSERT_TRUE(witness->send(hello()));
    ASSERT_TRUE(witness->receive_as<WelcomeMessage>().has_value());
    ASSERT_TRUE(witness->send(AckMessage{1}));  // who does nothing gives way in a full server
  }
  void tick(const std::vector<Operation>& operations = {}) { server->publish(source.step(operations)); }

  /// The well-behaved client still gets every tick.
  void expect_witness_unmoved() {
    tick();
    const Tick wanted = source.tick();
    for (;;) {
      const auto frame = witness->receive_as<FrameMessage>();
      ASSERT_TRUE(frame.has_value());
      ASSERT_EQ(frame->tick, ++seen);
      if (frame->tick == wanted) return;
    }
  }
  void expect_refused(RawClient& client, const std::string& because) {
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal.has_value());
    EXPECT_NE(refusal->reason.find(because), std::string::npos) << refusal->reason;
    EXPECT_TRUE(client.closed_within(seconds(10)));
    expect_witness_unmoved();
  }

  CommandQueue commands{4};
  TickSource source{flat_terrain};
  std::unique_ptr<NetServer> server;
  std::unique_ptr<RawClient> witness;
  Tick seen = 0;
};

/// Waits until a count of the server's has come so far.
template <typename Count>
void await(const NetServer& server, Count NetStats::*count, Count wanted) {
  const auto deadline = std::chrono::steady_clock::now() + seconds(10);
  while (server.stats().*count < wanted && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(milliseconds(5));
  EXPECT_GE(server.stats().*count, wanted);
}

}  // namespace scree
