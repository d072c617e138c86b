// Sessions by simulated links. In simulated time: whatever the link, the client sees the present as far as
// the link lets it, and in the end the whole world; in real time: a session torn at any byte.
#include <gtest/gtest.h>

#include "client/connection/connection.h"
#include "client/mirror/mirror.h"
#include "server/net/client_session.h"
#include "server/net/reading_pace.h"
#include "shared/base/quantile.h"
#include "shared/base/random.h"
#include "tests/support/holds.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/patience.h"
#include "tests/support/simulated_time.h"
#include "transport/link_transport.h"

namespace scree {
namespace {

constexpr double ticks_per_second = 60.0;

TEST(ReadingPace, is_what_a_full_socket_takes_and_grows_while_it_takes_all) {
  ReadingPace pace;
  EXPECT_EQ(pace.bytes_max(), limits::outbox_soft_bytes);
  pace.took(1000, 1000, 5.0);
  EXPECT_EQ(pace.bytes_max(), limits::outbox_soft_bytes) << "who took all has no need to be fast";
  pace.took(500, 1000, 1.0);
  EXPECT_EQ(pace.bytes_max(), limits::outbox_soft_bytes) << "it is full from now on";
  pace.took(4000, 9000, 0.2);
  EXPECT_EQ(pace.bytes_max(), static_cast<size_t>(20000.0 * limits::outbox_wait_s));
  pace.took(10, 9000, 1.0);
  EXPECT_EQ(pace.bytes_max(), limits::outbox_soft_min_bytes);
  pace.took(300, 300, 1.0);  // ends what it was full of
  pace.took(400, 400, 0.0);
  EXPECT_EQ(pace.bytes_max(), limits::outbox_soft_min_bytes) << "little says nothing";
  pace.took(600, 600, 0.0);
  EXPECT_EQ(pace.bytes_max(), limits::outbox_soft_min_bytes + 600);
}

/// A server's side of one session, a link, and a client, all in simulated time.
class LinkedWorld final : public SessionHost {
 public:
  explicit LinkedWorld(const LinkConfig& link)
      : near_(std::make_shared<MemoryStream>(kernel_bytes)),
        far_(std::make_shared<MemoryStream>(kernel_bytes)),
        client_(std::make_shared<LinkTransport>(near_, link, time.clock())) {
    MemoryStream::join(near_, far_);
    SessionTimes times{1e9, 1e9, 1e9};
    times.now_s = [this] { return time.now_s; };
    session_ = std::make_shared<ClientSession>(far_, "memory", 1, *this, times, 0.0);
    session_->start();
    read();
    send(HelloMessage{protocol_version, "linked", {0.0F, 2.0F, 0.0F}, 64.0F});
  }
  ~LinkedWorld() override {
    client_->close();
    session_->close("the end");
  }
  LinkedWorld(const LinkedWorld&) = delete;
  LinkedWorld& operator=(const LinkedWorld&) = delete;

  void tick(const std::vector<Operation>& operations = {}) {
    time.run_until(static_cast<double>(source.tick() + 1) / ticks_per_second);
    const auto delta = source.step(operations);
    const auto backlog = [this](uint64_t) { return session_->backlog(); };
    for (const Outgoing& outgoing : publisher.publish(*delta, backlog)) session_->queue(outgoing.bytes);
    session_->settle();
    worst_backlog_bytes = std::max(worst_backlog_bytes, session_->backlog_bytes());
  }
  /// A carve twice a second, up to 60 pieces that are pushed about, the oldest become terrain.
  void storm(int ticks) {
    for (int i = 0; i < ticks; ++i) {
      std::vector<Operation> operations;
      if (i % 30 == 0)
        operations.emplace_back(
            source.carve({static_cast<float>(random_.below(30)) - 15.0F, 0.0F, 0.0F}, 1.5F, 16));
      if (source.pieces().size() > 60) operations.emplace_back(source.stamp(source.pieces().begin()->first));
      for (const auto& [piece, volume] : source.pieces())
        if (random_.below(4) == 0)
          source.move(piece, glm::vec3(random_.unit(), random_.unit(), random_.unit()) * 0.1F - 0.05F);
      tick(operations);
    }
  }

  SimulatedTime time;
  TickSource source{flat_terrain};
  Workers workers{1};
  Publisher publisher{PublisherConfig{.terrain = flat_terrain}, workers};
  std::unique_ptr<Mirror> mirror;
  std::vector<double> ages_s;
  size_t worst_backlog_bytes = 0;
  std::string failure;

 private:
  static constexpr size_t kernel_bytes = 4096;

  HealthMessage health() override { return {}; }
  tl::expected<WelcomeMessage, Refused> admit(ClientSession& session, const HelloMessage& hello) override {
    publisher.join(session.id(), hello.eye_m, hello.interest_radius_m, operation_kinds);
    WelcomeMessage welcome;
    welcome.terrain = flat_terrain;
    welcome.interest_radius_m = hello.interest_radius_m;
    return welcome;
  }
  tl::expected<void, Refused> receive(ClientSession& session, const ClientMessage& message) override {
    if (const auto* repair = std::get_if<RepairMessage>(&message)) publisher.repair(session.id(), *repair);
    return {};
  }
  void refused(ClientSession&, const Refused& refused) override { failure = refused.message; }
  void closed(ClientSession& session, const std::string&) override { publisher.leave(session.id()); }

  void read() {
    client_->read_some(buffer_, [this](const Moved& moved) {
      if (!moved) return void(failure = moved.error().why);
      reader_.push(std::span<const uint8_t>(buffer_).first(*moved));
      for (auto next = reader_.next(); next && *next && failure.empty(); next = reader_.next())
        receive(**next);
      read();
    });
  }
  void receive(std::span<const uint8_t> body) {
    const auto message = decode_server(body);
    if (!message) return void(failure = message.error().message);
    if (const auto* welcome = std::get_if<WelcomeMessage>(&*message))
      return void(mirror = std::make_unique<Mirror>(*welcome));
    if (const auto applied = mirror->apply(*message); !applied) failure = applied.error().message;
    if (const auto* frame = std::get_if<FrameMessage>(&*message))
      ages_s.push_back(time.now_s - static_cast<double>(frame->tick) / ticks_per_second);
    while (const auto repair = mirror->next_repair_request()) send(*repair);
  }
  void send(const ClientMessage& message) {
    const std::vector<uint8_t> bytes = encode(message);
    unsent_.insert(unsent_.end(), bytes.begin(), bytes.end());
    if (!sending_) write();
  }
  void write() {
    sending_ = !unsent_.empty();
    if (!sending_) return;
    const std::vector<uint8_t> bytes = std::exchange(unsent_, {});
    outgoing_ = bytes;
    const std::span<const uint8_t> all(outgoing_);
    client_->write_some({&all, 1}, [this](const Moved& moved) {
      if (!moved) return;
      unsent_.insert(unsent_.begin(), outgoing_.begin() + static_cast<ptrdiff_t>(*moved), outgoing_.end());
      write();
    });
  }

  std::shared_ptr<MemoryStream> near_, far_;
  std::shared_ptr<Transport> client_;
  std::shared_ptr<ClientSession> session_;
  FrameReader reader_;
  std::array<uint8_t, 4096> buffer_{};
  std::vector<uint8_t> unsent_, outgoing_;
  bool sending_ = false;
  Random random_{3};
};

struct LinkRow {
  LinkWay way;
  double age_p99_max_s;
};

TEST(LinkedSessions, show_the_present_as_far_as_the_link_lets_and_end_with_the_same_world) {
  const LinkRow rows[] = {
      {{}, 0.001},
      {{.delay_s = 0.2, .jitter_s = 0.04, .rate_bytes_per_s = 1.25e6}, 0.25},
      {{.delay_s = 0.05, .jitter_s = 0.04, .rate_bytes_per_s = 125e3}, 0.15},
      {{.delay_s = 0.2, .jitter_s = 0.1, .rate_bytes_per_s = 12.5e3}, 0.9},
  };
  for (const LinkRow& row : rows) {
    SCOPED_TRACE(row.way.rate_bytes_per_s);
    LinkedWorld world({row.way, row.way, 5});
    world.storm(600);
    ASSERT_EQ(world.failure, "");
    EXPECT_LE(quantile(world.ages_s, 0.99), row.age_p99_max_s);
    EXPECT_LE(world.worst_backlog_bytes, limits::outbox_soft_bytes / 2) << "what waits is of a tick or two";
    for (int i = 0; i < 400; ++i) world.tick();
    EXPECT_EQ(world.mirror->field().hash(), world.source.field().hash());
    EXPECT_EQ(world.mirror->pieces().size(), world.source.pieces().size());
    EXPECT_EQ(world.failure, "");
  }
}

TEST_F(NetServerTest, a_session_torn_at_any_byte_ends_with_the_reason_and_no_other_notices) {
  start();
  for (const bool up : {true, false})
    for (uint64_t bytes = 0; bytes <= 150; ++bytes) {
      LinkConfig link;
      (up ? link.up : link.down).cut_bytes = bytes;
      const std::string reason = "the simulated link was cut after " + std::to_string(bytes) + " bytes";
      const auto connected = Connection::connect({.port = server->port(), .link = link}, hello(), patience);
      if (!connected) {
        ASSERT_TRUE(holds(connected.error().message, reason)) << connected.error().message;
        continue;
      }
      const auto end = std::chrono::steady_clock::now() + patience;
      for (uint32_t i = 1; (*connected)->connected() && std::chrono::steady_clock::now() < end; ++i) {
        (*connected)->send(CursorMessage{{1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}});
        tick();
        static_cast<void>((*connected)->wait(milliseconds(1)));
      }
      ASSERT_TRUE(holds((*connected)->close_reason(), reason)) << (*connected)->close_reason();
    }
  const auto end = std::chrono::steady_clock::now() + patience;
  while (server->stats().sessions > 1 && std::chrono::steady_clock::now() < end) {
    tick();
    server->flush();
  }
  EXPECT_EQ(server->stats().sessions, 1U);
  // A reset that a write meets first reads as an end, possibly within a message.
  const RefusalCounts refusals = server->stats().refusals;
  EXPECT_EQ(refusals.total(), refusals.of(Refusal::message_cut_short));
  expect_witness_unmoved();
}

}  // namespace
}  // namespace scree
