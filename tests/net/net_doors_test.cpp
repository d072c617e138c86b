// Crowds, floods and guesses on loopback: clients that behave come in and stay.
#include <gtest/gtest.h>
#include <set>
#include <string>
#include <thread>

#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/patience.h"

namespace scree {
namespace {

TEST_F(NetServerTest, the_oldest_silent_connection_goes_for_the_newest_and_whoever_says_hello_comes_in) {
  start([](NetConfig& config) { config.hello_seconds = 1000.0; });
  std::vector<std::unique_ptr<RawClient>> silent;
  for (size_t i = 0; i < limits::outsiders_max + 20; ++i) {
    silent.push_back(std::make_unique<RawClient>(server->port()));
    if (i % 100 != 0) continue;
    RawClient honest(server->port());
    ASSERT_TRUE(honest.send(hello()));
    ASSERT_TRUE(honest.receive_as<WelcomeMessage>().has_value()) << "beside " << i;
  }
  await(*server, &NetStats::sessions_disconnected, uint64_t{20});
  EXPECT_TRUE(silent.front()->closed_within(seconds(10)));
  EXPECT_EQ(server->stats().refusals.of(Refusal::outsiders_max), server->stats().sessions_disconnected);
  ASSERT_TRUE(silent.back()->send(hello()));
  EXPECT_TRUE(silent.back()->receive_as<WelcomeMessage>().has_value());
  expect_witness_unmoved();
}

TEST_F(NetServerTest, a_client_that_does_nothing_makes_room_when_the_server_is_full) {
  start([](NetConfig& config) { config.service.sessions_max = 3; });
  const Within inert_seconds(limits::inert_seconds_max);
  RawClient inert(server->port());
  ASSERT_TRUE(inert.send(hello()));
  ASSERT_TRUE(inert.receive_as<WelcomeMessage>().has_value());
  RawClient acts(server->port());
  ASSERT_TRUE(acts.send(hello()));
  ASSERT_TRUE(acts.receive_as<WelcomeMessage>().has_value());
  ASSERT_TRUE(acts.send(AckMessage{1}));
  RawClient at_once(server->port());
  ASSERT_TRUE(at_once.send(hello()));
  const auto full = at_once.receive_as<RefusalMessage>();
  if (inert_seconds.over()) GTEST_SKIP() << "the machine stood still: a place is free already";
  ASSERT_TRUE(full.has_value());
  EXPECT_TRUE(holds(full->reason, "the server is full")) << full->reason;
  std::this_thread::sleep_for(std::chrono::duration<double>(limits::inert_seconds_max));
  RawClient later(server->port());
  ASSERT_TRUE(later.send(hello()));
  EXPECT_TRUE(later.receive_as<WelcomeMessage>().has_value());
  expect_refused(inert, "another client has your place");
  EXPECT_EQ(server->stats().refusals.of(Refusal::idle_made_room), 1U);
}

TEST_F(NetServerTest, an_address_opens_and_holds_so_many_connections_and_no_more) {
  start([](NetConfig& config) { config.door = {3, 0.0, 5.0, false}; });
  RawClient second(server->port());
  RawClient third(server->port());
  RawClient fourth(server->port());
  expect_refused(fourth, "connections-per-address");
  RawClient fifth(server->port());
  expect_refused(fifth, "connections-per-address");
  RawClient sixth(server->port());
  expect_refused(sixth, "connects-per-second");
  const NetStats stats = server->stats();
  EXPECT_EQ(stats.turned_away, 3U);
  EXPECT_EQ(stats.refusals.of(Refusal::connections_per_address), 2U);
  EXPECT_EQ(stats.refusals.of(Refusal::connects_per_second), 1U);
  ASSERT_TRUE(third.send(hello()));
  EXPECT_TRUE(third.receive_as<WelcomeMessage>().has_value());
}

TEST_F(NetServerTest, sessions_of_one_address_are_one_party_and_this_machines_own_are_not) {
  const auto parties_of_two = [&] {
    RawClient second(server->port());
    EXPECT_TRUE(second.send(hello()));
    const auto welcome = second.receive_as<WelcomeMessage>();
    EXPECT_TRUE(welcome.has_value());
    EXPECT_TRUE(witness->send(carve(1)) && second.send(carve(2)));
    std::vector<Command> asked;
    for (const auto deadline = std::chrono::steady_clock::now() + patience;
         asked.size() < 2 && std::chrono::steady_clock::now() < deadline;)
      for (Command& command : commands.drain())
        if (!std::holds_alternative<LeaveRequest>(command.body)) asked.push_back(std::move(command));
    std::set<uint64_t> parties;
    for (const Command& command : asked) parties.insert(party_of(command));
    return parties;
  };
  start();
  EXPECT_EQ(parties_of_two().size(), 2U);
  start([](NetConfig& config) { config.door.loopback_is_free = false; });
  EXPECT_EQ(parties_of_two().size(), 1U);
}

TEST_F(NetServerTest, messages_are_short_and_shorter_before_the_hello) {
  start();
  const auto announced = [](size_t bytes) {
    std::vector<uint8_t> length(length_prefix_bytes);
    for (size_t i = 0; i < length.size(); ++i) length[i] = static_cast<uint8_t>(bytes >> (8 * i));
    return length;
  };
  RawClient stranger(server->port());
  stranger.send_bytes(announced(limits::hello_bytes_max + 1));
  expect_refused(stranger, std::to_string(limits::hello_bytes_max));
  RawClient joined(server->port());
  ASSERT_TRUE(joined.send(hello()));
  ASSERT_TRUE(joined.receive_as<WelcomeMessage>().has_value());
  joined.send_bytes(announced(limits::client_message_bytes_max + 1));
  expect_refused(joined, std::to_string(limits::client_message_bytes_max));
}

TEST_F(NetServerTest, more_bytes_than_any_client_needs_are_refused) {
  start();
  RawClient client(server->port());
  ASSERT_TRUE(client.send(hello()));
  std::vector<uint8_t> message = encode(ClientMessage(AckMessage{1}));
  constexpr size_t filling = 60000;  // in a field that nobody knows
  message.insert(message.end(), {0x7a, (filling & 0x7f) | 0x80, (filling >> 7 & 0x7f) | 0x80, filling >> 14});
  message.resize(message.size() + filling);
  const size_t body = message.size() - length_prefix_bytes;
  for (size_t i = 0; i < length_prefix_bytes; ++i) message[i] = static_cast<uint8_t>(body >> (8 * i));
  for (int i = 0; i < 10; ++i) client.send_bytes(message);
  expect_refused(client, "bytes a second");
}

TEST_F(NetServerTest, tokens_are_guessed_once_a_second_and_then_more_slowly) {
  start([](NetConfig& config) { config.admin_token = "a token of some length"; });
  const auto guess = [&](const std::string& token) {
    RawClient client(server->port());
    EXPECT_TRUE(client.send(hello()));
    EXPECT_TRUE(client.receive_as<WelcomeMessage>().has_value());
    EXPECT_TRUE(client.send(AdminMessage{1, token, {}}));
    const auto refusal = client.receive_as<RefusalMessage>();
    return refusal ? refusal->reason : std::string();
  };
  const Within wait(limits::guess_wait_min_s);
  EXPECT_TRUE(holds(guess("no token"), "does not know the token"));
  for (int i = 0; i < 5; ++i) {
    const std::string said = guess("a token of some length");
    if (wait.over()) GTEST_SKIP() << "the machine stood still: the next guess is looked at";
    EXPECT_TRUE(holds(said, "checks the next one in")) << said;
  }
  expect_witness_unmoved();
  EXPECT_EQ(server->stats().refusals.of(Refusal::admin_token_wrong), 1U);
  EXPECT_EQ(server->stats().refusals.of(Refusal::token_guesses), 5U);
}

}  // namespace
}  // namespace scree
