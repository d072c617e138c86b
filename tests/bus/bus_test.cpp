// The bus beside a real server of NATS: it is found again by itself, keeps what its streams are to keep, and
// says what is wrong.
#include "server/bus/bus.h"

#include <gtest/gtest.h>
#include <mutex>

#include "tests/bus/nats_process.h"

namespace scree {
namespace {

std::vector<uint8_t> bytes_of_text(const std::string& text) {
  return {text.begin(), text.end()};
}

/// What a subscription got.
class Ear {
 public:
  Bus::Handler handler() {
    return [this](const std::string&, std::span<const uint8_t> bytes) {
      const std::scoped_lock lock(mutex_);
      heard_.emplace_back(bytes.begin(), bytes.end());
    };
  }
  bool has(const std::string& text) const {
    const std::scoped_lock lock(mutex_);
    return std::ranges::find(heard_, text) != heard_.end();
  }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> heard_;
};

TEST(Bus, a_server_that_is_away_at_the_start_is_found_later) {
  NatsProcess nats;
  nats.kill();
  auto bus = Bus::connect(bus_at(nats.url()));
  ASSERT_TRUE(bus) << bus.error().message;
  EXPECT_FALSE((*bus)->is_connected());
  EXPECT_FALSE((*bus)->fault().empty());
  EXPECT_FALSE((*bus)->send("a", bytes_of_text("lost")));
  nats.start();
  EXPECT_TRUE(comes([&] { return (*bus)->is_connected(); }));
  EXPECT_EQ((*bus)->connections(), 1U);
}

TEST(Bus, a_subscription_goes_on_after_the_server_was_killed) {
  NatsProcess nats;
  const auto bus = connected_bus(nats), other = connected_bus(nats);
  Ear ear;
  const auto subscription = bus->subscribe("a.*", ear.handler());
  ASSERT_TRUE(subscription);
  ASSERT_TRUE(comes([&] { return other->send("a.b", bytes_of_text("one")) && ear.has("one"); }));
  nats.kill();
  ASSERT_TRUE(comes([&] { return !bus->is_connected(); }));
  nats.start();
  ASSERT_TRUE(comes([&] { return bus->is_connected() && other->is_connected(); }));
  EXPECT_TRUE(comes([&] { return other->send("a.b", bytes_of_text("two")) && ear.has("two"); }));
  EXPECT_EQ(bus->connections(), 2U);
}

TEST(Bus, a_stream_has_the_last_messages_in_order_and_survives_the_servers_end) {
  NatsProcess nats;
  const auto bus = connected_bus(nats);
  ASSERT_TRUE(comes([&] { return bus->open_stream({"S", "s.*", 1 << 20, false}).has_value(); }));
  ASSERT_TRUE(bus->open_stream({"S", "s.*", 2 << 20, false}));  // again, with another bound
  EXPECT_EQ(bus->keep("s.a", bytes_of_text("one")), 1U);
  ASSERT_TRUE(bus->keep_later("s.b", bytes_of_text("two")));
  EXPECT_EQ(bus->keep("s.a", bytes_of_text("three")), 3U);
  nats.kill();
  ASSERT_TRUE(comes([&] { return !bus->is_connected(); }));
  EXPECT_FALSE(bus->kept("S", 1));
  nats.start();
  const auto first = [&] { return bus->kept("S", 1); };
  ASSERT_TRUE(comes([&] { return first().has_value(); }));
  EXPECT_EQ((*first())->bytes, bytes_of_text("one"));
  EXPECT_EQ((*bus->kept("S", 2))->bytes, bytes_of_text("two"));
  EXPECT_EQ((*bus->last_kept("S", "s.a"))->sequence, 3U);
  EXPECT_FALSE(bus->kept("S", 4)->has_value());
  EXPECT_FALSE(bus->last_kept("S", "s.c")->has_value());
}

TEST(Bus, a_full_stream_drops_its_oldest_messages) {
  NatsProcess nats;
  const auto bus = connected_bus(nats);
  ASSERT_TRUE(comes([&] { return bus->open_stream({"S", "s.*", 100'000, true}).has_value(); }));
  const std::vector<uint8_t> part(10'000, 7);
  for (int i = 0; i < 30; ++i) ASSERT_TRUE(bus->keep("s.a", part));
  EXPECT_FALSE(bus->kept("S", 1)->has_value());
  EXPECT_TRUE(bus->kept("S", 30)->has_value());
}

TEST(Bus, what_is_not_kept_is_counted) {
  NatsProcess nats;
  const auto bus = connected_bus(nats);
  ASSERT_TRUE(bus->keep_later("of.no.stream", bytes_of_text("lost")));
  EXPECT_TRUE(comes([&] { return bus->keep_failures() == 1; }));
  EXPECT_FALSE(bus->keep("of.no.stream", bytes_of_text("lost")));
}

TEST(Bus, a_user_needs_the_password_which_no_message_shows) {
  NatsProcess nats({"--user", "ann", "--pass", "the-secret"});
  auto wrong = Bus::connect(bus_at(nats.url("ann:wrong")));
  ASSERT_TRUE(wrong) << wrong.error().message;
  auto right = Bus::connect(bus_at(nats.url("ann:the-secret")));
  ASSERT_TRUE(right);
  EXPECT_TRUE(comes([&] { return (*right)->is_connected(); }));
  EXPECT_FALSE((*wrong)->is_connected());
  EXPECT_EQ(without_password("nats://ann:the-secret@host:4222"), "nats://host:4222");
  const auto none = Bus::connect(bus_at("nats://ann:the-secret@:not-a-port"));
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().message.find("the-secret"), std::string::npos) << none.error().message;
}

TEST(Bus, a_missing_file_of_credentials_is_refused_with_its_name) {
  BusConfig config = bus_at("nats://127.0.0.1:1");
  config.credentials_path = "/no/such.creds";
  const auto bus = Bus::connect(config);
  ASSERT_FALSE(bus);
  EXPECT_NE(bus.error().message.find("/no/such.creds"), std::string::npos);
}

TEST(Bus, names_are_parts_of_subjects) {
  for (const char* good : {"a", "quarry-2", "a_b"}) EXPECT_TRUE(is_bus_name(good)) << good;
  for (const char* bad : {"", "A", "a.b", "a*", ">", "a b", "ä"}) EXPECT_FALSE(is_bus_name(bad)) << bad;
  EXPECT_FALSE(is_bus_name(std::string(49, 'a')));
}

}  // namespace
}  // namespace scree
