// A server skips and counts messages of a later release, answers requests with unknown values, and finds the
// protocol that both sides speak.
#include <gtest/gtest.h>

#include "tests/support/growing_relay.h"
#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"

namespace scree {
namespace {

class GrowthServerTest : public NetServerTest {
 protected:
  static constexpr const char* token = "an-admin-token";

  void start_with_admin() {
    start([](NetConfig& config) { config.admin_token = token; });
  }
  static bool join(RawClient& client, const std::string& with_token = {}) {
    HelloMessage message = hello();
    message.token = with_token;
    return client.send(message) && client.receive_as<WelcomeMessage>().has_value();
  }
  /// A paint with a material that no palette has. Its numbers: request 9, material 255.
  static std::vector<uint8_t> paint_with_unknown_material() {
    PaintMessage paint;
    paint.request = 9;
    paint.shape = sphere({}, 1.0F);
    paint.material = Material{materials_max};
    return encode(ClientMessage(paint));
  }
};

TEST_F(GrowthServerTest, a_message_of_an_unknown_kind_is_skipped_and_counted) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(join(client));
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(client.send_bytes(unknown_message));
  ASSERT_TRUE(client.send(carve(1)));
  // The request comes after the unknown messages, so they are counted once it waits for the simulation.
  const auto deadline = std::chrono::steady_clock::now() + seconds(10);
  while (commands.drain().empty() && std::chrono::steady_clock::now() < deadline)
    std::this_thread::sleep_for(milliseconds(5));
  tick({source.carve({0.0F, 0.0F, 0.0F}, 1.0F, 4)});
  EXPECT_TRUE(client.receive_as<FrameMessage>().has_value());
  expect_witness_unmoved();
  EXPECT_EQ(server->stats().messages_unknown, 3U);
  EXPECT_EQ(server->stats().sessions_refused, 0U);
}

TEST_F(GrowthServerTest, unknown_messages_count_against_the_limit_of_messages) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(join(client));
  std::vector<uint8_t> many;
  for (int i = 0; i < 2 * static_cast<int>(limits::messages_burst_max); ++i)
    many.insert(many.end(), unknown_message.begin(), unknown_message.end());
  ASSERT_TRUE(client.send_bytes(many));
  expect_refused(client, "limits.messages_per_second_max");
}

TEST_F(GrowthServerTest, unknown_messages_count_against_the_limit_of_bytes) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(join(client));
  // Field 1,001 of the envelope, nearly as long as a message may be.
  constexpr uint32_t content = 60000, body = content + 5;
  std::vector<uint8_t> large{body & 0xFFU,
                             body >> 8U,
                             0,
                             0,
                             0xCA,
                             0x3E,
                             (content & 0x7FU) | 0x80U,
                             ((content >> 7U) & 0x7FU) | 0x80U,
                             content >> 14U};
  large.resize(large.size() + content);
  for (size_t sent = 0; sent < 2 * limits::client_bytes_burst_max; sent += large.size())
    if (!client.send_bytes(large)) break;
  expect_refused(client, "limits.client_bytes_per_second_max");
}

TEST_F(GrowthServerTest, an_unknown_message_is_no_hello) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send_bytes(unknown_message));
  expect_refused(client, "must be a hello");
}

TEST_F(GrowthServerTest, a_request_with_an_unknown_value_is_answered_and_the_session_goes_on) {
  start_with_admin();
  RawClient client(server->port());
  ASSERT_TRUE(join(client, token));
  ASSERT_TRUE(client.send_bytes(paint_with_unknown_material()));
  const auto reply = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(reply.has_value());
  EXPECT_EQ(reply->request, 9U);
  EXPECT_EQ(reply->refusal_name, "value_unknown");
  EXPECT_TRUE(holds(reply->refusal, "material 255")) << reply->refusal;
  // An administrator's act of a later release leaves the act empty: it must not count as done.
  ASSERT_TRUE(client.send(AdminMessage{10, "", SettingsRequest{}}));
  const auto act = client.receive_as<ReplyMessage>();
  ASSERT_TRUE(act.has_value());
  EXPECT_EQ(act->request, 10U);
  EXPECT_EQ(act->refusal_name, "value_unknown");
  tick();
  EXPECT_TRUE(client.receive_as<FrameMessage>().has_value());
  EXPECT_EQ(commands.drain().size(), 0U) << "the world is asked for nothing";
}

TEST_F(GrowthServerTest, a_client_that_speaks_two_protocols_gets_the_one_of_the_server) {
  start();
  const auto answer = [&](uint32_t newest, uint32_t oldest) {
    HelloMessage message = hello(newest);
    message.oldest_protocol = oldest;
    RawClient client(server->port());
    EXPECT_TRUE(client.send(message));
    return client.receive();
  };
  const auto both = answer(protocol_version + 1, protocol_version);
  ASSERT_TRUE(both && std::holds_alternative<WelcomeMessage>(*both));
  EXPECT_EQ(std::get<WelcomeMessage>(*both).protocol, protocol_version);
  const auto later = answer(protocol_version + 2, protocol_version + 1);
  ASSERT_TRUE(later && std::holds_alternative<RefusalMessage>(*later));
  EXPECT_EQ(std::get<RefusalMessage>(*later).name, "protocol_version");
  EXPECT_TRUE(holds(std::get<RefusalMessage>(*later).reason,
                    "client versions " + std::to_string(protocol_version + 1) + " to " +
                        std::to_string(protocol_version + 2)));
  const auto earlier = answer(protocol_version - 1, 1);
  EXPECT_TRUE(earlier && std::holds_alternative<RefusalMessage>(*earlier));
}

}  // namespace
}  // namespace scree
