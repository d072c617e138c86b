// Clients served by several threads: what a client gets does not depend on how many there are, nor on what
// becomes of the sessions beside it.
#include <deque>
#include <gtest/gtest.h>
#include <map>

#include "server/net/flush_rate.h"
#include "shared/base/random.h"
#include "shared/base/workers.h"
#include "tests/support/net_server_fixture.h"
#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

constexpr std::initializer_list<size_t> thread_counts{1, 2, 4};

/// Sessions that are sent messages in each of so many ticks, when one's write takes so long and all are
/// queued some in every tick; `longest`: ticks that any of them waited.
struct Turns {
  size_t least = SIZE_MAX, most = 0;
  uint64_t longest = 0;
};

Turns flush_turns(FlushRate& rate, size_t sessions, double session_s, bool more) {
  std::deque<uint64_t> waiting;  // since when
  Turns turns;
  for (uint64_t tick = 0; tick < 240; ++tick) {
    while (waiting.size() < sessions) waiting.push_back(tick);
    size_t waited = 0;
    while (waited < sessions && tick - waiting[waited] + 1 >= limits::ticks_per_flush_max) ++waited;
    const size_t sent = rate.due(sessions, waited, more);
    rate.flushed(sent, static_cast<double>(sent) * session_s);
    if (sent > 0) turns.longest = std::max(turns.longest, tick - waiting.front());
    waiting.erase(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(sent));
    if (tick < 120) continue;  // the average has come near
    turns.least = std::min(turns.least, sent);
    turns.most = std::max(turns.most, sent);
  }
  return turns;
}

TEST(FlushRate, sends_to_all_with_every_tick_while_that_is_quick_and_else_by_turns) {
  FlushRate rate(60);
  const Turns quick = flush_turns(rate, 1000, 8e-6, false);  // 8 ms, less than half of a tick
  EXPECT_EQ(quick.least, 1000U);
  EXPECT_EQ(quick.longest, 0U);
  const Turns slower = flush_turns(rate, 1000, 12e-6, false);
  EXPECT_EQ(slower.least, 500U) << "half of them with each tick";
  EXPECT_EQ(slower.most, 500U);
  EXPECT_EQ(slower.longest, 1U);
  const Turns slow = flush_turns(rate, 1000, 1e-3, false);
  EXPECT_EQ(slow.least, 250U) << "limits.ticks_per_flush_max";
  EXPECT_EQ(slow.most, 250U);
  EXPECT_EQ(slow.longest, limits::ticks_per_flush_max - 1);
  EXPECT_EQ(flush_turns(rate, 10, 1e-6, false).least, 10U) << "quick again";
}

TEST(FlushRate, a_tick_that_the_next_one_follows_at_once_waits_for_it_but_not_for_ever) {
  FlushRate rate(60);
  const Turns lagging = flush_turns(rate, 1000, 1e-6, true);
  EXPECT_EQ(lagging.least, 0U);
  EXPECT_EQ(lagging.most, 1000U);
  EXPECT_EQ(lagging.longest, limits::ticks_per_flush_max - 1);
}

/// Every message to every session of a crowd, and the counts: near and far eyes, some that move, some without
/// kernels, some that read slowly, some that join late and some that leave.
struct CrowdsBytes {
  std::map<uint64_t, std::vector<uint8_t>> by_session;
  PublisherStats stats;
};

CrowdsBytes serve_crowd(size_t threads) {
  constexpr uint64_t crowd = 150;
  CrowdsBytes got;
  TickSource source(flat_terrain);
  Workers workers(threads);
  Publisher publisher({.terrain = flat_terrain}, workers);
  Random random(11);
  const auto somewhere = [&] { return glm::vec3(80.0F * random.unit() - 40.0F, 2.0F, 0.0F); };
  const auto backlog_bytes = [&](uint64_t session) -> size_t {
    const uint64_t turn = (session + source.tick()) % 24;
    if (session % 9 == 0) return turn < 8 ? 1 : limits::outbox_soft_bytes + 1;
    return session % 10 == 0 && turn > 2 ? limits::outbox_resync_bytes + 1 : 0;
  };
  const auto backlog = [&](uint64_t session) { return Backlog{backlog_bytes(session)}; };
  for (uint64_t tick = 1; tick <= 90; ++tick) {
    if (tick == 1 || tick == 40)
      for (uint64_t session = tick; session < tick + crowd / 2; ++session)
        publisher.join(session * 2, somewhere(), 24.0F, session % 7 != 0 ? operation_kinds : 0);
    if (tick % 20 == 0) publisher.leave(2 * tick);
    for (uint64_t session = tick % 13; session < crowd; session += 13)
      publisher.set_interest(2 * session, somewhere(), 24.0F);
    std::vector<Operation> operations;
    if (tick % 6 == 1) operations.push_back(source.carve(somewhere() - glm::vec3(0.0F, 2.0F, 0.0F), 1.5F, 5));
    if (tick % 6 == 4) operations.push_back(source.stamp(source.pieces().begin()->first));
    for (const auto& [piece, volume] : source.pieces())
      if ((piece + tick) % 3 == 0) source.move(piece, {0.0F, 0.01F * random.unit(), 0.0F});
    for (const Outgoing& outgoing : publisher.publish(*source.step(operations), backlog)) {
      std::vector<uint8_t>& bytes = got.by_session[outgoing.session];
      bytes.insert(bytes.end(), outgoing.bytes->begin(), outgoing.bytes->end());
    }
  }
  got.stats = publisher.stats();
  return got;
}

TEST(Workers, serve_each_client_the_same_bytes_however_many_they_are) {
  const CrowdsBytes alone = serve_crowd(1);
  EXPECT_GT(alone.stats.resets, 0U);
  EXPECT_GT(alone.stats.chunk_bytes, 0U);
  EXPECT_GT(alone.stats.piece_bytes, 0U);
  for (const size_t threads : {2U, 4U}) {
    const CrowdsBytes shared = serve_crowd(threads);
    EXPECT_EQ(shared.by_session, alone.by_session) << threads;
    EXPECT_EQ(shared.stats.sent_bytes, alone.stats.sent_bytes);
    EXPECT_EQ(shared.stats.transform_bytes, alone.stats.transform_bytes);
    EXPECT_EQ(shared.stats.resets, alone.stats.resets);
  }
}

class CrowdOnSocketsTest : public NetServerTest {
 protected:
  static constexpr size_t steady = 40, others = 10;

  std::unique_ptr<RawClient> joined() {
    auto client = std::make_unique<RawClient>(server->port());
    EXPECT_TRUE(client->send(hello()));
    EXPECT_TRUE(client->receive_as<WelcomeMessage>().has_value());
    return client;
  }
  /// All frames of one client up to a tick, as bytes.
  static std::vector<uint8_t> frames_until(RawClient& client, Tick last) {
    std::vector<uint8_t> all;
    while (const auto frame = client.receive_as<FrameMessage>()) {
      const std::vector<uint8_t> bytes = encode(ServerMessage(*frame));
      all.insert(all.end(), bytes.begin(), bytes.end());
      if (frame->tick == last) return all;
    }
    ADD_FAILURE() << "no frame of tick " << last;
    return all;
  }
  /// What the steady clients get while others leave and break the rules.
  std::vector<std::vector<uint8_t>> frames_beside_the_unruly(size_t threads) {
    TickSource world(flat_terrain);
    start([&](NetConfig& config) { config.net_threads = threads; });
    std::vector<std::unique_ptr<RawClient>> crowd, leaving, rude;
    for (size_t i = 0; i < steady; ++i) crowd.push_back(joined());
    for (size_t i = 0; i < others; ++i) {
      leaving.push_back(joined());
      rude.push_back(joined());
    }
    for (size_t i = 0; i < others; ++i) {
      server->publish(world.step({world.carve({2.0F * static_cast<float>(i % 4), 0.0F, 0.0F}, 1.5F, 5)}));
      leaving[i].reset();
      rude[i]->send(hello());
      for (int more = 0; more < 4; ++more) {
        for (const auto& [piece, volume] : world.pieces()) world.move(piece, {0.0F, 0.01F, 0.0F});
        server->publish(world.step());
      }
    }
    server->flush();
    std::vector<std::vector<uint8_t>> got;
    for (const auto& client : crowd) got.push_back(frames_until(*client, world.tick()));
    for (const auto& client : rude) EXPECT_TRUE(client->receive_as<RefusalMessage>().has_value());
    return got;
  }
};

TEST_F(CrowdOnSocketsTest, steady_clients_get_the_same_frames_whoever_ends_beside_them) {
  const auto alone = frames_beside_the_unruly(1);
  for (const std::vector<uint8_t>& one : alone) EXPECT_EQ(one, alone.front());
  for (const size_t threads : {2U, 4U}) EXPECT_EQ(frames_beside_the_unruly(threads), alone) << threads;
}

TEST_F(CrowdOnSocketsTest, reply_floods_end_sessions_within_a_tick_and_nobody_else) {
  start([](NetConfig& config) {
    config.net_threads = 4;
    config.stall_seconds = 1000.0;
  });
  std::vector<std::unique_ptr<RawClient>> crowd;
  for (size_t i = 0; i < steady; ++i) crowd.push_back(joined());
  auto delta = std::make_shared<TickDelta>(*source.step());
  const std::string refusal(limits::reason_bytes_max, 'x');
  // To two of them more than may wait. The witness is session 1.
  for (const uint64_t session : {5U, 25U})
    delta->replies.resize(delta->replies.size() + limits::outbox_hard_bytes / refusal.size() * 9 / 8,
                          Reply{session, 1, refusal, 0});
  server->publish(delta);
  server->flush();
  EXPECT_EQ(server->stats().sessions_disconnected, 2U);
  EXPECT_EQ(server->stats().refusals.of(Refusal::outbox_full), 2U);
  EXPECT_EQ(server->stats().sessions, 1 + steady - 2);
  expect_witness_unmoved();
}

}  // namespace
}  // namespace scree
