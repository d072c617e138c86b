// Sixty sessions of one party that ask for all they can, and an honest session beside them: what it asks for
// comes as soon as if the party were one session. Where each session counts as a party, as before there were
// any, the same attack bites.
#include <gtest/gtest.h>

#include "tests/support/publisher_fixture.h"

namespace scree {
namespace {

constexpr uint64_t first_attacker = 1000;
constexpr size_t greedy_clients = 60;
constexpr uint64_t honest = 1;

class StreamTurnsTest : public PublisherTest {
 protected:
  /// `as_one`: the greedy_clients are one party.
  void join_greedy_clients(bool as_one, float radius_m) {
    for (uint64_t session = first_attacker; session < first_attacker + greedy_clients; ++session)
      publisher.join(session, {0.0F, 2.0F, 0.0F}, radius_m, 0, false, as_one ? first_attacker : session);
  }
  void join_honest(float radius_m) {
    publisher.join(honest, {0.0F, 2.0F, 0.0F}, radius_m, 0);
    followers.try_emplace(honest);
  }
  /// What the greedy_clients get is not looked at.
  void tick_for_honest() {
    const auto delta = source.step({});
    const auto backlog = [](uint64_t) { return Backlog(); };
    const auto receive_own = [&](const std::vector<Outgoing>& outgoing) {
      for (const Outgoing& one : outgoing)
        if (one.session == honest) followers.at(honest).receive(one);
    };
    receive_own(publisher.publish(*delta, backlog));
    receive_own(publisher.stream(backlog));
  }

  /// Ticks until the honest session has its 100 chunks of ground, 2000 at most.
  int ticks_for_ground(bool as_one) {
    join_greedy_clients(as_one, 2000.0F);
    for (size_t i = 0; i < greedy_clients; ++i) {
      std::vector<ChunkCoord> far;  // each its own, with the surface in them
      for (int k = 0; k < 24; ++k) far.push_back({k - 12, -1, 20 + static_cast<int>(i)});
      EXPECT_TRUE(publisher.ask_ground(first_attacker + i, {far}));
    }
    tick_for_honest();
    join_honest(200.0F);
    std::vector<ChunkCoord> near;
    for (int x = -5; x < 5; ++x)
      for (int z = -5; z < 5; ++z) near.push_back({x, -1, z});
    EXPECT_TRUE(publisher.ask_ground(honest, {near}));
    int ticks = 0;
    for (; followers.at(honest).grounds.size() < near.size() && ticks < 2000; ++ticks) tick_for_honest();
    return ticks;
  }
};

TEST_F(StreamTurnsTest, ground_comes_at_half_of_the_pace_beside_a_party_of_sixty) {
  publisher.set_ground_work(16);
  const int ticks = ticks_for_ground(true);
  EXPECT_LE(ticks, 105) << "two chunks a tick, every second one its own";
  for (const GroundMessage& ground : followers.at(honest).grounds) EXPECT_FALSE(ground.beyond);
}

TEST_F(StreamTurnsTest, the_attack_bites_where_each_of_its_sessions_is_a_party) {
  publisher.set_ground_work(16);
  EXPECT_GT(ticks_for_ground(false), 600);
}

TEST_F(StreamTurnsTest, an_idle_network_thread_generates_more) {
  publisher.set_ground_work(limits::ground_work_max);
  EXPECT_LE(ticks_for_ground(true), 30) << "eight chunks a tick";
}

/// Interests that move in every tick, over so many edited chunks that few can be scanned in a tick.
class ScanTurnsTest : public StreamTurnsTest {
 protected:
  void SetUp() override {
    std::vector<std::pair<BrickCoord, Brick>> bricks;
    for (int x = 0; x < 110; ++x)
      for (int z = 0; z < 100; ++z)
        bricks.emplace_back(BrickCoord{x * chunk_bricks, 40, z * chunk_bricks}, solid_brick());
    auto delta = changed(source.step({}), bricks);
    static_cast<void>(publisher.publish(*delta, [](uint64_t) { return Backlog(); }));
    ASSERT_EQ(publisher.state().chunks().size(), 11000U);
  }
  /// Ticks until a step of the honest session shows: the chunks at its new place are wanted.
  int ticks_for_a_step(bool as_one) {
    join_greedy_clients(as_one, 2000.0F);
    join_honest(20.0F);
    const auto move_greedy_clients = [&](int tick) {
      for (uint64_t session = first_attacker; session < first_attacker + greedy_clients; ++session)
        publisher.set_interest(session, {tick % 2 == 0 ? 0.0F : 400.0F, 2.0F, 0.0F}, 2000.0F);
    };
    for (int tick = 0; tick < 40; ++tick) {
      move_greedy_clients(tick);
      tick_for_honest();
    }
    const glm::vec3 there_m{100.0F, 82.0F, 100.0F};
    publisher.set_interest(honest, there_m, 20.0F);
    int ticks = 0;
    for (; publisher.view(honest)->held().empty() && publisher.view(honest)->wanted_chunks() == 0 &&
           ticks < 100;
         ++ticks) {
      move_greedy_clients(ticks);
      tick_for_honest();
    }
    return ticks;
  }
};

TEST_F(ScanTurnsTest, a_step_shows_at_once_beside_a_party_of_sixty_that_moves_to_and_fro) {
  EXPECT_LE(ticks_for_a_step(true), 2);
}

/// A file that answers slowly: two chunks a tick, and there is room for eight.
class NarrowSupply final : public ChunkSupply {
 public:
  explicit NarrowSupply(Field& field) : field_(field) {}
  size_t bricks_max() override { return 0; }
  Tick saved_tick() override { return saved; }
  bool has_room() override { return asked_.size() < 8; }
  void ask(ChunkCoord chunk) override {
    if (has_room() && std::ranges::count(asked_, chunk) == 0) asked_.push_back(chunk);
  }
  std::vector<SuppliedChunk> collect(size_t) override {
    std::vector<SuppliedChunk> chunks;
    for (; chunks.size() < 2 && !asked_.empty(); asked_.pop_front()) {
      SuppliedChunk& one = chunks.emplace_back(SuppliedChunk{asked_.front(), {}});
      for (const BrickCoord brick : field_.edited_bricks(one.chunk))
        one.bricks.push_back({brick, field_.brick(brick), field_.materials(brick)});
    }
    return chunks;
  }

  Tick saved = 0;

 private:
  Field& field_;
  std::deque<ChunkCoord> asked_;
};

/// Ticks until the honest session has the one chunk near it, 500 at most.
int ticks_for_a_paged_chunk(TickSource& source, Workers& workers, bool as_one) {
  const auto supply = std::make_shared<NarrowSupply>(source.field());
  Publisher paged(PublisherConfig{.terrain = flat_terrain, .chunks = supply}, workers);
  const auto backlog = [](uint64_t) { return Backlog(); };
  const auto play = [&](const TickDelta& delta) { static_cast<void>(paged.publish(delta, backlog)); };
  TickDelta delta = *source.step({});
  for (int i = 0; i < 1500; ++i) {
    const BrickCoord coord{chunk_bricks * (i % 40), 40, chunk_bricks * (i / 40)};
    source.field().set_brick(coord, solid_brick());
    delta.bricks.push_back(
        {coord, std::make_shared<const Brick>(solid_brick()), brick_hash(coord, solid_brick())});
    const ChunkCoord chunk = chunk_of(coord);
    delta.chunks.push_back({chunk, source.field().chunk_hash(chunk), uint64_t{1} << index_in_chunk(coord)});
  }
  std::ranges::sort(delta.bricks, {}, &BrickState::coord);
  std::ranges::sort(delta.chunks, {}, &ChunkState::chunk);
  delta.field_hash = source.field().hash();
  play(delta);
  supply->saved = source.tick();
  play(*source.step({}));
  EXPECT_EQ(paged.state().bricks_in(), 0U);
  for (uint64_t k = 0; k < greedy_clients; ++k) {  // each wants other chunks
    const glm::vec3 eye_m{32.0F * static_cast<float>(k % 10) + 4.0F, 84.0F,
                          48.0F * static_cast<float>(k / 10) + 4.0F};
    paged.join(2 + k, eye_m, 14.0F, operation_kinds, false, as_one ? 2 : 2 + k);
  }
  for (int i = 0; i < 2; ++i) play(*source.step({}));
  paged.join(100, {308.0F, 84.0F, 292.0F}, 5.0F, operation_kinds);
  int ticks = 0;
  for (; paged.view(100)->held().empty() && ticks < 500; ++ticks) play(*source.step({}));
  return ticks;
}

TEST_F(PublisherTest, a_chunk_is_read_soon_for_who_wants_one_beside_a_party_that_wants_all) {
  EXPECT_LE(ticks_for_a_paged_chunk(source, workers, true), 12);
}

TEST_F(PublisherTest, reading_for_who_wants_one_takes_long_where_each_session_is_a_party) {
  EXPECT_GT(ticks_for_a_paged_chunk(source, workers, false), 20);
}

}  // namespace
}  // namespace scree
