// Attacks on loopback, with honest clients beside each: one stays all the time, others come. All are served,
// their copies have the server's hash, each attack is counted under its name, and the log stays short.
#include <csignal>
#include <deque>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "shared/base/random.h"
#include "tests/support/attack_fixture.h"
#include "tests/support/holds.h"
#include "tests/support/proxied_client.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

/// Connections from another process, which has descriptors of its own.
class SilentCrowd {
 public:
  /// Before any thread is started.
  SilentCrowd() {
    EXPECT_EQ(::pipe(to_child_), 0);
    EXPECT_EQ(::pipe(from_child_), 0);
    child_ = ::fork();
    if (child_ != 0) return;
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_NOFILE, &limit);
    std::vector<std::unique_ptr<RawClient>> silent;
    for (uint16_t port = 0; ::read(to_child_[0], &port, sizeof port) == sizeof port;) {
      silent.push_back(std::make_unique<RawClient>(port));
      const char connected = silent.back()->connected() ? 1 : 0;
      if (::write(from_child_[1], &connected, 1) != 1) break;
    }
    ::_exit(0);
  }
  ~SilentCrowd() {
    ::kill(child_, SIGKILL);
    ::waitpid(child_, nullptr, 0);
    for (const int end : {to_child_[0], to_child_[1], from_child_[0], from_child_[1]}) ::close(end);
  }
  /// One more connection; false when there can be none.
  bool grow(uint16_t port) {
    char connected = 0;
    return ::write(to_child_[1], &port, sizeof port) == sizeof port &&
           ::read(from_child_[0], &connected, 1) == 1 && connected != 0;
  }

 private:
  int to_child_[2]{}, from_child_[2]{};
  pid_t child_ = 0;
};

/// For its time, this process may open so many files.
class Descriptors {
 public:
  explicit Descriptors(rlim_t count) {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    rlimit few = before_;
    few.rlim_cur = count;
    ::setrlimit(RLIMIT_NOFILE, &few);
  }
  ~Descriptors() { ::setrlimit(RLIMIT_NOFILE, &before_); }

 private:
  rlimit before_{};
};

TEST_F(AttackTest, silent_connections_in_greater_number_than_descriptors) {
  SilentCrowd crowd;
  const Descriptors descriptors(1024);
  open([](NetConfig& config) { config.hello_seconds = 1000.0; });
  for (int i = 1; i <= 1600; ++i) {
    ASSERT_TRUE(crowd.grow(server->port())) << i;
    if (i % 200 == 0) expect_honest_served();
  }
  expect_refused_as(Refusal::outsiders_max, 1000);
}

TEST_F(AttackTest, as_many_silent_connections_as_sessions_renewed_again_and_again) {
  open();
  std::deque<std::unique_ptr<RawClient>> silent;
  for (int i = 0; i < 640; ++i) {
    silent.push_back(std::make_unique<RawClient>(server->port()));
    if (silent.size() > 64) silent.pop_front();
    if (i % 80 == 79) expect_honest_served();
  }
}

/// As many as there are places, each of an address of its own, and whatever is ended comes again.
TEST_F(AttackTest, half_a_hello_from_more_addresses_than_there_are_places_renewed_all_the_time) {
  const Descriptors descriptors(6000);
  open([](NetConfig& config) {
    config.proxies = *Proxies::parse({"127.0.0.1"});
    config.hello_seconds = 1000.0;
  });
  const std::vector<uint8_t> whole = encode(ClientMessage(hello()));
  std::deque<ProxiedClient> crowd;
  const auto renew = [&](size_t count) {
    for (size_t i = 0; i < count; ++i) {
      static uint32_t next = 0;
      crowd.emplace_back(server->port(), fmt::format("10.{}.{}.7", next / 250 % 250, next % 250));
      crowd.back().send_bytes(std::span(whole).first(whole.size() / 2));
      if (crowd.size() > limits::outsiders_max + 500) crowd.pop_front();
      ++next;
    }
  };
  renew(limits::outsiders_max + 50);
  for (int i = 0; i < 10; ++i) {
    ProxiedClient newcomer(server->port(), fmt::format("203.0.113.{}", i + 1));
    renew(20);  // meanwhile
    EXPECT_TRUE(newcomer.join(hello())) << i;
  }
  expect_refused_as(Refusal::outsiders_max, 50);
}

TEST_F(AttackTest, half_a_hello_from_each_of_many) {
  open();
  const std::vector<uint8_t> whole = encode(ClientMessage(hello()));
  std::vector<std::unique_ptr<RawClient>> halves;
  for (size_t i = 0; i < 200; ++i) {
    halves.push_back(std::make_unique<RawClient>(server->port()));
    ASSERT_TRUE(halves.back()->send_bytes(std::span(whole).first(i % whole.size())));
  }
  expect_honest_served();
  for (const auto& half : halves) half->finish_sending();
  expect_refused_as(Refusal::message_cut_short, 190);
  expect_honest_served();
}

TEST_F(AttackTest, floods_of_every_kind_of_message) {
  open([](NetConfig& config) { config.admin_token = "a token of some length"; });
  for (const ClientMessage& message : samples::client_messages()) {
    const bool ends = std::holds_alternative<GoodbyeMessage>(message);  // nothing after it is read
    if (ends || std::holds_alternative<HelloMessage>(message)) continue;
    RawClient client(server->port());
    ASSERT_TRUE(client.send(hello()));
    const std::vector<uint8_t> one = encode(message);
    std::vector<uint8_t> flood;
    for (int i = 0; i < 3000; ++i) flood.insert(flood.end(), one.begin(), one.end());
    client.send_bytes(flood);
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal) << message.index();
    const bool admin = std::holds_alternative<AdminMessage>(message);
    const bool ground = std::holds_alternative<AskGroundMessage>(message) ||
                        std::holds_alternative<AskContentMessage>(message);
    const bool health = std::holds_alternative<AskHealthMessage>(message);  // for who has not joined
    EXPECT_TRUE(admin || ground || health || refusal->name == "messages_per_second") << refusal->name;
    commands.drain();
    expect_honest_served();
  }
  expect_refused_as(Refusal::messages_per_second, 6);
}

/// A message of a field that nobody knows, of so many bytes in all.
std::vector<uint8_t> filled(const ClientMessage& message, size_t body_bytes) {
  std::vector<uint8_t> bytes = encode(message);
  const size_t filling = body_bytes - (bytes.size() - length_prefix_bytes) - 4;
  bytes.insert(bytes.end(),
               {0x7a, static_cast<uint8_t>((filling & 0x7f) | 0x80),
                static_cast<uint8_t>((filling >> 7 & 0x7f) | 0x80), static_cast<uint8_t>(filling >> 14)});
  bytes.resize(bytes.size() + filling);
  for (size_t i = 0; i < length_prefix_bytes; ++i)
    bytes[i] = static_cast<uint8_t>((bytes.size() - length_prefix_bytes) >> (8 * i));
  return bytes;
}

TEST_F(AttackTest, the_largest_messages_before_and_after_the_hello) {
  open();
  for (int i = 0; i < 20; ++i) {
    RawClient client(server->port());
    ASSERT_TRUE(client.send_bytes(filled(hello(), limits::hello_bytes_max)));
    ASSERT_TRUE(client.receive_as<WelcomeMessage>()) << "as large as it may be";
    const std::vector<uint8_t> largest = filled(AckMessage{1}, limits::client_message_bytes_max);
    for (int sent = 0; sent < 12; ++sent) client.send_bytes(largest);
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->name, "bytes_per_second");
  }
  for (const size_t bytes : {limits::hello_bytes_max + 1, size_t{1} << 20U, size_t{0xFFFFFFFF}}) {
    RawClient client(server->port());
    std::vector<uint8_t> announced(length_prefix_bytes);
    for (size_t i = 0; i < announced.size(); ++i) announced[i] = static_cast<uint8_t>(bytes >> (8 * i));
    client.send_bytes(announced);
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->name, "message_malformed");
  }
  expect_honest_served();
  expect_refused_as(Refusal::bytes_per_second, 20);
}

TEST_F(AttackTest, valid_messages_in_every_wrong_order) {
  open([](NetConfig& config) { config.service.requests_per_second = 100000.0; });
  const std::vector<ClientMessage> messages = samples::client_messages();
  for (const ClientMessage& first : messages) {
    // Health is asked for in place of a hello, and answered.
    if (std::holds_alternative<HelloMessage>(first) || std::holds_alternative<AskHealthMessage>(first))
      continue;
    RawClient client(server->port());
    ASSERT_TRUE(client.send(first));
    client.send(hello());
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->name, "hello_missing");
  }
  Random random(99);
  for (int i = 0; i < 60; ++i) {
    RawClient client(server->port());
    ASSERT_TRUE(client.send(hello()));
    for (int sent = 0; sent < 30; ++sent) {
      const ClientMessage& next = messages[1 + random.below(static_cast<uint32_t>(messages.size() - 1))];
      if (!std::holds_alternative<GoodbyeMessage>(next)) client.send(next);
    }
    client.send(hello());
    const auto refusal = client.receive_as<RefusalMessage>();
    ASSERT_TRUE(refusal);
    EXPECT_EQ(refusal->name, "hello_repeated") << "all before it are right in any order";
    commands.drain();
  }
  expect_honest_served();
  expect_refused_as(Refusal::hello_repeated, 60);
  expect_refused_as(Refusal::hello_missing, 16);
}

TEST_F(AttackTest, readers_so_slow_that_nothing_new_reaches_them) {
  open([](NetConfig& config) { config.stall_seconds = 0.2; });
  std::vector<std::unique_ptr<RawClient>> deaf;
  for (int i = 0; i < 12; ++i) {
    deaf.push_back(std::make_unique<RawClient>(server->port(), 4096));
    ASSERT_TRUE(deaf.back()->send(hello()));
    ASSERT_TRUE(deaf.back()->receive_as<WelcomeMessage>());
  }
  auto loud = std::make_shared<TickDelta>(*source.step());
  for (uint64_t session = 3; session < 15; ++session)  // after the witness and the resident
    loud->replies.resize(loud->replies.size() + 1024, Reply{session, 1, std::string(1024, 'x'), 0});
  server->publish(loud);
  expect_refused_as(Refusal::reading_stalled, 12);
  expect_honest_served();
}

TEST_F(AttackTest, settings_that_the_world_refuses_are_not_logged_as_set) {
  open([](NetConfig& config) { config.admin_token = "the-admin-token"; });
  RawClient admin(server->port());
  HelloMessage as_admin = hello();
  as_admin.token = "the-admin-token";
  ASSERT_TRUE(admin.send(as_admin));
  const auto welcome = admin.receive_as<WelcomeMessage>();
  ASSERT_TRUE(welcome);
  ASSERT_TRUE(admin.send(AdminMessage{1, "", SettingsRequest{{{"dents", "false"}}}}));
  ASSERT_TRUE(admin.send(AdminMessage{2, "", SettingsRequest{{{"pieces-max", "0"}}}}));
  size_t taken = 0;
  const auto end = std::chrono::steady_clock::now() + patience;
  while (taken < 2 && std::chrono::steady_clock::now() < end) taken += commands.drain().size();
  ASSERT_EQ(taken, 2U);
  auto delta = std::make_shared<TickDelta>(*source.step());
  delta->replies.push_back({welcome->session, 1, "", 0});
  delta->replies.push_back({welcome->session, 2, "too few", 0, Refusal::settings_invalid});
  server->publish(delta);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(admin.receive_as<ReplyMessage>());
  const std::string log = logged();
  EXPECT_TRUE(holds(log, "sets dents=false")) << log;
  EXPECT_FALSE(holds(log, "pieces-max")) << log;
}

}  // namespace
}  // namespace scree
