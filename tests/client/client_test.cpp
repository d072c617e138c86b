// The client that all programs have, against a server that the test plays: what it tells its owner, and what
// it answers by itself.
#include "client/session/client.h"

#include <deque>
#include <gtest/gtest.h>

#include "client/mirror/limits.h"
#include "client/session/limits.h"
#include "tests/support/flat_welcome.h"

namespace scree {
namespace {

/// The far end of a client's connections, one after the other.
struct PlayedServer {
  struct Channel;

  std::optional<ConnectionEnd> refuses;  ///< the next attempt
  WelcomeMessage welcome = flat_welcome();
  std::vector<HelloMessage> hellos;
  std::deque<ServerMessage> coming;
  std::vector<ClientMessage> sent;  ///< by the client
  bool open = false;
  size_t goodbyes = 0, closed = 0, waits = 0;
  double arrives_s = 0.0;  ///< what comes next

  template <typename Message>
  std::vector<Message> all_sent() const {
    std::vector<Message> all;
    for (const ClientMessage& message : sent)
      if (const auto* one = std::get_if<Message>(&message)) all.push_back(*one);
    return all;
  }
};

struct PlayedServer::Channel final : ServerChannel {
  explicit Channel(PlayedServer& server) : server_(server) { server_.open = true; }
  ~Channel() override { ++server_.closed; }
  const WelcomeMessage& welcome() const override { return server_.welcome; }
  std::vector<Received> poll() override {
    using std::chrono::steady_clock;
    const std::chrono::duration<double> arrived(server_.arrives_s);
    std::vector<Received> all;
    for (ServerMessage& message : server_.coming)
      all.push_back({std::move(message), 10,
                     steady_clock::time_point(std::chrono::duration_cast<steady_clock::duration>(arrived))});
    server_.coming.clear();
    return all;
  }
  void await(std::chrono::milliseconds /*within*/) override { ++server_.waits; }
  void send(const ClientMessage& message) override { server_.sent.push_back(message); }
  bool connected() const override { return server_.open; }
  ConnectionEnd end() const override { return {{"the link broke"}, {}}; }
  ConnectionCounters counters() const override { return {.sent_messages = server_.sent.size()}; }
  void leave() override { ++server_.goodbyes; }

 private:
  PlayedServer& server_;
};

class PlayedConnector final : public Connector {
 public:
  explicit PlayedConnector(PlayedServer& server) : server_(server) {}
  void begin(Rejoin& rejoin, const HelloMessage& hello, double /*now_s*/) override {
    server_.hellos.push_back(rejoin.open("played", hello).hello);
    busy_ = true;
  }
  bool busy() const override { return busy_; }
  void await(std::chrono::milliseconds /*within*/) override {}
  std::optional<Attempt> poll(double /*now_s*/) override {
    if (!std::exchange(busy_, false)) return std::nullopt;
    if (server_.refuses) return Attempt{nullptr, *std::exchange(server_.refuses, std::nullopt)};
    return Attempt{std::make_unique<PlayedServer::Channel>(server_), {}};
  }
  std::string where() const override { return "played"; }

 private:
  PlayedServer& server_;
  bool busy_ = false;
};

FrameMessage empty_frame(Tick tick) {
  FrameMessage frame;
  frame.tick = tick;
  return frame;
}

CarveRequest small_carve() {
  CarveRequest carve;
  carve.shape = sphere({0.0F, -0.5F, 0.0F}, 1.0F);
  carve.seeds = 4;
  carve.impact_m = {0.0F, 0.0F, 0.0F};
  return carve;
}

CarveOperation made_of(const CarveRequest& carve) {
  return {.shape = carve.shape,
          .pattern = carve.pattern,
          .seeds = carve.seeds,
          .random_seed = carve.random_seed,
          .impact_m = carve.impact_m,
          .first_piece = 1};
}

class ClientTest : public ::testing::Test {
 protected:
  void start(const ClientOptions& options = {}) {
    client_ = std::make_unique<Client>(std::make_unique<PlayedConnector>(server_), options);
  }
  /// Joins, and takes the event.
  void join() {
    client_->join({protocol_version, "test", {1.0F, 2.0F, 3.0F}, 32.0F}, 0.0);
    const std::vector<Client::Event> events = events_at(0.0);
    ASSERT_EQ(events.size(), 1U);
    ASSERT_TRUE(std::holds_alternative<Client::Joined>(events[0]));
  }
  std::vector<Client::Event> events_at(double now_s) {
    client_->poll(now_s);
    std::vector<Client::Event> events;
    while (std::optional<Client::Event> event = client_->next()) events.push_back(std::move(*event));
    return events;
  }

  PlayedServer server_;
  std::unique_ptr<Client> client_;
};

TEST_F(ClientTest, each_event_is_told_when_the_mirror_is_as_of_it) {
  start();
  EXPECT_EQ(client_->mirror(), nullptr);
  join();
  EXPECT_EQ(server_.hellos.at(0).client, "test");
  for (const Tick tick : {5U, 6U, 7U}) server_.coming.push_back(empty_frame(tick));
  client_->poll(1.0);
  for (const Tick tick : {5U, 6U, 7U}) {
    const std::optional<Client::Event> event = client_->next();
    ASSERT_TRUE(event);
    const auto& applied = std::get<Client::Applied>(*event);
    EXPECT_EQ(std::get<FrameMessage>(applied.received.message).tick, tick);
    EXPECT_EQ(client_->mirror()->tick(), tick);
    EXPECT_EQ(applied.received.bytes, 10U);
  }
  EXPECT_FALSE(client_->next());
  server_.coming.push_back(ReplyMessage{4, "no", 7});
  const std::vector<Client::Event> events = events_at(2.0);
  ASSERT_EQ(events.size(), 1U);
  const auto& reply = std::get<Client::Applied>(events[0]).received.message;
  EXPECT_EQ(std::get<ReplyMessage>(reply).request, 4U);
}

TEST_F(ClientTest, who_has_no_place_is_where_the_welcome_says_and_who_has_one_stays) {
  server_.welcome.spawn = Spawn{{40.0F, 5.0F, -6.0F}, 0.0F, 0.0F};
  start();
  join();
  EXPECT_FALSE(server_.hellos.at(0).at_spawn);
  EXPECT_EQ(client_->eye_m(), glm::vec3(1.0F, 2.0F, 3.0F));
  HelloMessage hello{protocol_version, "test", {1.0F, 2.0F, 3.0F}, 32.0F};
  hello.at_spawn = true;
  client_->join(hello, 0.0);
  static_cast<void>(events_at(0.0));
  EXPECT_TRUE(server_.hellos.at(1).at_spawn);
  EXPECT_EQ(client_->eye_m(), glm::vec3(40.0F, 5.0F, -6.0F));
  server_.welcome.spawn.reset();
  client_->join(hello, 0.0);
  static_cast<void>(events_at(0.0));
  EXPECT_EQ(client_->eye_m(), glm::vec3(1.0F, 2.0F, 3.0F)) << "an older server says none";
}

TEST_F(ClientTest, messages_that_came_with_the_welcome_are_told_after_it_in_the_same_poll) {
  start();
  server_.coming.push_back(empty_frame(1));
  client_->join({}, 0.0);
  const std::vector<Client::Event> events = events_at(0.0);
  ASSERT_EQ(events.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<Client::Joined>(events[0]));
  EXPECT_TRUE(std::holds_alternative<Client::Applied>(events[1]));
}

TEST_F(ClientTest, nobody_waits_while_messages_that_came_are_not_told) {
  start();
  server_.coming = {empty_frame(1), empty_frame(2)};
  client_->join({}, 0.0);
  client_->poll(0.0);
  ASSERT_TRUE(std::holds_alternative<Client::Joined>(client_->next().value()));
  client_->wait(std::chrono::hours(1));
  EXPECT_EQ(server_.waits, 0U) << "they came with the welcome, so nothing else may come";
  EXPECT_EQ(events_at(0.0).size(), 2U);
  client_->wait(std::chrono::milliseconds(1));
  EXPECT_EQ(server_.waits, 1U);
}

TEST_F(ClientTest, a_carve_tells_its_bricks_and_pieces) {
  start();
  join();
  FrameMessage frame = empty_frame(1);
  frame.operations = {made_of(small_carve())};
  server_.coming.push_back(frame);
  const std::vector<Client::Event> events = events_at(1.0);
  const MirrorChanges& changes = std::get<Client::Applied>(events.at(0)).changes;
  EXPECT_FALSE(changes.bricks.empty());
  EXPECT_EQ(changes.pieces_added.size(), client_->mirror()->pieces().size());
  EXPECT_FALSE(changes.pieces_added.empty());
}

TEST_F(ClientTest, frames_are_acknowledged_a_few_times_a_second_and_none_twice) {
  start();
  join();
  Tick tick = 0;
  for (int i = 0; i < 60; ++i) {
    server_.coming.push_back(empty_frame(++tick));
    events_at(1.0 + i / 60.0);
  }
  const size_t in_a_second = server_.all_sent<AckMessage>().size();
  EXPECT_GE(in_a_second, 3U);
  EXPECT_LE(in_a_second, 1.0 + 1.0 / limits::acknowledge_interval_s);
  events_at(3.0);
  const std::vector<AckMessage> all = server_.all_sent<AckMessage>();
  EXPECT_EQ(all.back().tick, tick);
  events_at(4.0);
  EXPECT_EQ(server_.all_sent<AckMessage>().size(), all.size()) << "nothing newer has come";
}

TEST_F(ClientTest, a_failed_check_is_followed_by_a_request_for_repair) {
  start();
  join();
  FrameMessage frame = empty_frame(1);
  frame.operations = {made_of(small_carve())};
  frame.has_check = true;
  frame.check = 1;
  server_.coming.push_back(frame);
  events_at(1.0);
  const std::vector<RepairMessage> repairs = server_.all_sent<RepairMessage>();
  ASSERT_EQ(repairs.size(), 1U);
  EXPECT_EQ(repairs[0].tick, 1U);
  EXPECT_FALSE(repairs[0].chunks.empty());
  EXPECT_EQ(client_->mirror()->mismatches(), 1U);
}

TEST_F(ClientTest, a_lost_connection_is_told_after_all_that_came_by_it_and_the_world_stays) {
  start();
  join();
  server_.coming = {empty_frame(1), empty_frame(2)};
  server_.open = false;
  EXPECT_EQ(events_at(1.0).size(), 2U);
  const std::vector<Client::Event> events = events_at(2.0);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<Client::Lost>(events[0]).end.message, "the link broke");
  EXPECT_FALSE(client_->connected());
  EXPECT_EQ(client_->mirror()->tick(), 2U);
  EXPECT_EQ(client_->welcome(), nullptr);
  EXPECT_TRUE(events_at(3.0).empty()) << "it does not join by itself";
  const size_t sent = server_.sent.size();
  client_->send(SayMessage{"hello"});
  client_->ask(small_carve(), 1, 3.0);
  EXPECT_EQ(server_.sent.size(), sent);
}

TEST_F(ClientTest, a_new_welcome_tells_whether_the_world_is_another_one) {
  start();
  for (const uint64_t world : {7U, 7U, 8U}) {
    server_.welcome.world = world;
    client_->join({}, 0.0);
    const std::vector<Client::Event> events = events_at(0.0);
    EXPECT_EQ(std::get<Client::Joined>(events.at(0)).other_world, server_.closed != 1) << server_.closed;
    EXPECT_EQ(client_->mirror()->tick(), 0U);
  }
  EXPECT_EQ(server_.closed, 2U) << "each attempt ends the connection before it";
  EXPECT_EQ(server_.goodbyes, 0U) << "which the server may take for lost";
}

TEST_F(ClientTest, the_next_attempt_has_the_ticket_of_the_last_welcome) {
  start();
  server_.welcome.ticket = "the way back";
  join();
  client_->drop();
  EXPECT_FALSE(client_->connected());
  EXPECT_TRUE(events_at(1.0).empty()) << "who drops a connection knows";
  client_->join({}, 1.0);
  EXPECT_EQ(server_.hellos.at(0).ticket, "");
  EXPECT_EQ(server_.hellos.at(1).ticket, "the way back");
}

TEST_F(ClientTest, a_refusal_is_told_with_its_name) {
  start();
  server_.refuses = ConnectionEnd{{"you are banned"}, "banned"};
  client_->join({}, 0.0);
  EXPECT_TRUE(client_->joining());
  const std::vector<Client::Event> events = events_at(0.0);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(std::get<Client::Lost>(events[0]).end.refusal, "banned");
  EXPECT_FALSE(client_->joining());
  EXPECT_EQ(client_->mirror(), nullptr);
}

TEST_F(ClientTest, a_message_that_cannot_be_applied_ends_the_connection) {
  start();
  join();
  FrameMessage frame = empty_frame(1);
  frame.operations = {StampOperation{77, {}, 0}};  // there is no such piece
  server_.coming = {frame, empty_frame(2)};
  const std::vector<Client::Event> events = events_at(1.0);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NE(std::get<Client::Lost>(events[0]).end.message.find("cannot be applied"), std::string::npos);
  EXPECT_EQ(server_.closed, 1U);
}

TEST_F(ClientTest, an_owner_who_stops_early_gets_the_rest_later_and_the_server_its_answers) {
  start();
  join();
  server_.coming = {empty_frame(1), empty_frame(2), empty_frame(3)};
  client_->poll(1.0);
  ASSERT_TRUE(client_->next());
  client_->poll(1.0 + 2.0 * limits::acknowledge_interval_s);
  EXPECT_EQ(server_.all_sent<AckMessage>().size(), 1U);
  ASSERT_TRUE(client_->next());
  EXPECT_EQ(client_->mirror()->tick(), 2U);
  server_.open = false;
  const std::vector<Client::Event> events = events_at(5.0);
  ASSERT_EQ(events.size(), 2U) << "the rest, and only then the end";
  EXPECT_TRUE(std::holds_alternative<Client::Lost>(events[1]));
}

TEST_F(ClientTest, delayed_frames_wait_for_the_clock_behind_the_server) {
  start({.delayed = true});
  join();
  server_.arrives_s = 10.0;
  server_.coming = {empty_frame(60), empty_frame(61)};
  EXPECT_TRUE(events_at(10.0).empty());
  EXPECT_EQ(events_at(10.0 + limits::playback_delay_s).size(), 2U);
}

TEST_F(ClientTest, a_request_is_shown_at_once_where_that_is_wanted) {
  server_.welcome.role = Role::carver;
  for (const bool wanted : {false, true}) {
    start();
    client_->predict(wanted);
    join();
    server_.coming.push_back(empty_frame(1));
    events_at(1.0);
    EXPECT_TRUE(client_->loaded(2.0));
    client_->ask(small_carve(), 9, 2.0);
    EXPECT_EQ(server_.all_sent<CarveMessage>().back().request, 9U);
    MirrorChanges changes;
    client_->settle(2.0, changes);
    EXPECT_EQ(client_->predictions()->outstanding(), wanted ? 1U : 0U);
    EXPECT_EQ(changes.bricks.empty(), !wanted);
    EXPECT_EQ(&client_->field() == &client_->mirror()->field(), !wanted);
    EXPECT_EQ(client_->mirror()->field().hash(), 0U) << "the mirror stays the server's";
  }
  server_.coming.push_back(ReplyMessage{9, "no room", 0});
  events_at(2.1);
  MirrorChanges changes;
  client_->settle(2.1, changes);
  EXPECT_EQ(client_->predictions()->outstanding(), 0U);
  EXPECT_EQ(&client_->field(), &client_->mirror()->field());
}

TEST_F(ClientTest, the_interest_goes_to_the_server_and_is_remembered) {
  start();
  join();
  EXPECT_EQ(client_->eye_m(), glm::vec3(1.0F, 2.0F, 3.0F));
  client_->follow({4.0F, 5.0F, 6.0F}, 48.0F);
  const std::vector<InterestMessage> told = server_.all_sent<InterestMessage>();
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].eye_m, client_->eye_m());
  EXPECT_EQ(told[0].interest_radius_m, 48.0F);
  EXPECT_EQ(client_->radius_m(), 48.0F);
}

TEST_F(ClientTest, a_client_that_is_closed_says_goodbye) {
  start();
  join();
  client_.reset();
  EXPECT_EQ(server_.goodbyes, 1U);
  EXPECT_EQ(server_.closed, 1U);
}

}  // namespace
}  // namespace scree
