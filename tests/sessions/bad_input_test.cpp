// Bad input from end to end: each gets a clear answer, the server goes on ticking and carving, and the client
// beside notices nothing: it gets every tick, and its field is the server's.
#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <unistd.h>

#include "shared/base/limits.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/holds.h"
#include "tests/support/raw_client.h"
#include "tests/support/session_support.h"

namespace scree {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;

CarveMessage good_carve(uint32_t request) {
  CarveRequest carve;
  carve.shape = sphere({0.0F, -0.4F, 0.0F}, 1.0F);
  carve.seeds = 4;
  carve.random_seed = request;
  return carve_message(carve, request);
}

class BadInputTest : public ::testing::Test {
 protected:
  static LiveConfig flat() {
    LiveConfig config;
    config.world.terrain = flat_terrain;
    config.net.stall_seconds = 1.5;
    return config;
  }
  void SetUp() override {
    ASSERT_EQ(session.failure, "");
    witness = &session.join({0.0F, 2.0F, 0.0F}, 64.0F);
    ASSERT_EQ(session.failure, "");
  }
  /// The witness misses no tick, and can carve.
  void expect_witness_unmoved() {
    const ReplyMessage* reply = session.ask(*witness, good_carve(++asked));
    ASSERT_NE(reply, nullptr) << session.failure;
    EXPECT_EQ(reply->refusal, "");
    ASSERT_TRUE(session.steps(3)) << session.failure;
    EXPECT_EQ(witness->mirror().field().hash(), session.field().hash());
    EXPECT_EQ(witness->mirror().mismatches(), 0U);
  }
  /// A client of its own sends the carve and is answered; it stays welcome.
  void expect_answered(const CarveMessage& carve, const std::string& because) {
    SessionClient& client = session.join({0.0F, 2.0F, 0.0F}, 64.0F);
    const uint64_t hash = session.field().hash();
    const ReplyMessage* reply = session.ask(client, carve);
    ASSERT_NE(reply, nullptr) << session.failure;
    EXPECT_TRUE(holds(reply->refusal, because)) << reply->refusal;
    EXPECT_EQ(session.field().hash(), hash);
    EXPECT_TRUE(client.client().connected());
    expect_witness_unmoved();
  }
  /// A client that no client of ours could be: told why, and closed.
  void expect_closed(const std::vector<uint8_t>& bytes, const std::string& because, bool ends = false) {
    RawClient client(session.server().port());
    ASSERT_TRUE(client.send_bytes(bytes));
    if (ends) client.finish_sending();
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal.has_value());
    EXPECT_TRUE(holds(refusal->reason, because)) << refusal->reason;
    EXPECT_TRUE(client.closed_within(seconds(10)));
    expect_witness_unmoved();
  }
  void expect_radius_closes(float radius_m) {
    CarveMessage carve = good_carve(100);
    carve.shape.radius_m = radius_m;
    std::vector<uint8_t> bytes = encode(ClientMessage(HelloMessage{}));
    const std::vector<uint8_t> bad = encode(ClientMessage(carve));
    bytes.insert(bytes.end(), bad.begin(), bad.end());
    expect_closed(bytes, "radius");
  }

  LoopbackSession session{flat()};
  SessionClient* witness = nullptr;
  uint32_t asked = 0;
};

TEST_F(BadInputTest, radius_that_is_not_a_number) {
  expect_radius_closes(std::nanf(""));
}

TEST_F(BadInputTest, infinite_radius) {
  expect_radius_closes(HUGE_VALF);
  expect_radius_closes(-HUGE_VALF);
}

TEST_F(BadInputTest, negative_radius) {
  CarveMessage carve = good_carve(100);
  carve.shape.radius_m = -2.0F;
  expect_answered(carve, "the radius is negative");
}

TEST_F(BadInputTest, carve_over_the_limits) {
  CarveMessage large = good_carve(100);
  large.shape.radius_m = limits::edit_reach_max_m * 2.0F;
  expect_answered(large, "and may be at most 8 m");
  CarveMessage many = good_carve(101);
  many.seeds = limits::seeds_max + 1;
  expect_answered(many, "seeds are over the limit of 4096");
  CarveMessage fast = good_carve(102);
  fast.blast_speed_m_s = limits::blast_speed_max_m_s * 2.0F;
  expect_answered(fast, "the blast speed must lie from 0 to 30 m/s");
}

TEST_F(BadInputTest, carve_far_away) {
  CarveMessage carve = good_carve(100);
  carve.shape.a.x = 1e7F;
  expect_answered(carve, "the place is outside the world");
}

TEST_F(BadInputTest, wrong_protocol_version) {
  expect_closed(encode(ClientMessage(HelloMessage{protocol_version + 76, "old", {}, 8.0F})),
                "protocol version " + std::to_string(protocol_version) + ", the client version " +
                    std::to_string(protocol_version + 76));
}

TEST_F(BadInputTest, garbage) {
  expect_closed({8, 0, 0, 0, 0xFF, 0xFE, 0xFD, 0xFC, 0xFB, 0xFA, 0xF9, 0xF8},
                "not a protobuf of this protocol");
}

TEST_F(BadInputTest, truncated_frame) {
  std::vector<uint8_t> bytes = encode(ClientMessage(HelloMessage{}));
  bytes.pop_back();
  bytes.pop_back();
  expect_closed(bytes, "the connection ended in the middle of a message", true);
}

TEST_F(BadInputTest, oversized_frame) {
  expect_closed({0xFF, 0xFF, 0xFF, 0x7F}, std::to_string(limits::hello_bytes_max));
}

TEST_F(BadInputTest, client_that_never_reads) {
  RawClient deaf(session.server().port(), 4096);
  ASSERT_TRUE(deaf.send(HelloMessage{protocol_version, "deaf", {0.0F, 2.0F, 0.0F}, 64.0F}));
  const auto deadline = std::chrono::steady_clock::now() + seconds(60);
  const auto net = [&] { return session.server().report().net; };
  while (net().sessions_disconnected == 0 && std::chrono::steady_clock::now() < deadline)
    ASSERT_TRUE(session.step()) << session.failure;
  EXPECT_EQ(net().sessions_disconnected, 1U);
  EXPECT_EQ(net().sessions, 1U);
  expect_witness_unmoved();
}

TEST_F(BadInputTest, recording_that_is_none) {
  const fs::path folder = fs::temp_directory_path() / ("scree_bad_input_" + std::to_string(::getpid()));
  fs::create_directories(folder);
  LiveConfig config;
  config.replay.path = (folder / "letter.txt").string();
  const auto refused = [&](const std::string& because) {
    const LoopbackSession none(config);
    EXPECT_TRUE(holds(none.failure, config.replay.path)) << none.failure;
    EXPECT_TRUE(holds(none.failure, because)) << none.failure;
  };
  refused("no such file");
  std::ofstream(config.replay.path) << "This is a letter, and not a recording of anything at all, however "
                                       "long it may go on for, and it does go on for some time.";
  refused("not an SQLite file");
  fs::remove_all(folder);
  expect_witness_unmoved();
}

TEST_F(BadInputTest, port_in_use) {
  LiveConfig config = flat();
  config.pacing = Pacing::by_hand;
  config.net.port = session.server().port();
  const auto second = LiveServer::start(config);
  ASSERT_FALSE(second.has_value());
  EXPECT_TRUE(holds(second.error().message, std::to_string(config.net.port) + ": the port is in use"))
      << second.error().message;
  expect_witness_unmoved();
}

}  // namespace
}  // namespace scree
