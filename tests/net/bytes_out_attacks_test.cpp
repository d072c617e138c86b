// Many sessions of one address that draw all the bytes they can by few, and an honest session of another
// address beside them. Without a budget the same attack draws many times as much.
#include <gtest/gtest.h>

#include "shared/base/timing.h"
#include "tests/support/attack_fixture.h"
#include "tests/support/proxied_client.h"

namespace scree {
namespace {

constexpr double seconds_of_attack = 1.0;
constexpr size_t attackers = 30;
constexpr BytesOut::Rules budget{100.0e3, 0.0};
constexpr BytesOut::Rules no_budget{0.0, 0.0};

/// What the attackers drew, and how the honest one was served.
struct Drawn {
  double bytes = 0.0;
  double seconds = 0.0;
  bool honest_has_all = false;
  int honest_ticks = 0;

  /// By its budget, with what a session may be sent beyond its room.
  double allowed() const {
    return budget.per_address * (seconds + limits::bytes_out_saved_s) + attackers * 48.0 * 1024.0;
  }
};

class BytesOutAttackTest : public AttackTest {
 protected:
  /// There is rubble at so many places, far apart; the first is near the honest ones.
  void open_with(const BytesOut::Rules& rules, int places) {
    open([&](NetConfig& config) {
      config.proxies = *Proxies::parse({"127.0.0.1"});
      config.bytes_out = rules;
      config.service.sessions_max = 200;
      config.door.connects_per_second = config.door.connects_burst = 10000.0;
    });
    for (int i = 0; i < 24 * places; ++i)
      tick({source.carve({400.0F * static_cast<float>(i / 24) + 4.0F * static_cast<float>(i % 6), 0.0F,
                          4.0F * static_cast<float>(i % 24 / 6)},
                         2.0F, 12)});
  }
  void join_attackers(HelloMessage first) {
    for (size_t i = 0; i < attackers; ++i) {
      crowd.push_back(std::make_unique<ProxiedClient>(server->port(), "203.0.113.1"));
      ASSERT_TRUE(crowd.back()->join(first));
    }
  }
  size_t drop_all() {
    size_t dropped = 0;
    for (const auto& one : crowd) dropped += one->drop();
    return dropped;
  }
  /// `act(client, round)`: what each attacker sends in a round of the attack. An honest session joins in the
  /// middle of it, and has the world's hash soon.
  template <typename Act>
  Drawn attack(const Act& act) {
    Drawn drawn;
    const double begin_s = steady_now_s();
    ProxiedClient honest(server->port(), "203.0.113.2");
    for (int round = 0; drawn.seconds < seconds_of_attack || round < 400 || !drawn.honest_has_all; ++round) {
      for (const auto& one : crowd) act(*one, round);
      tick();
      server->flush();
      drawn.bytes += static_cast<double>(drop_all());
      drawn.seconds = steady_now_s() - begin_s;
      if (drawn.seconds > 20.0) break;
      if (drawn.seconds < seconds_of_attack / 2) continue;
      if (!honest.joined() && !honest.join(hello())) break;
      EXPECT_TRUE(honest.receive());
      if (drawn.honest_has_all) continue;
      ++drawn.honest_ticks;
      drawn.honest_has_all = has_all_near(honest);
    }
    EXPECT_TRUE(drawn.honest_has_all);
    return drawn;
  }
  /// All edited chunks within its interest are as the server's.
  bool has_all_near(const ProxiedClient& client) {
    size_t same = 0;
    for (const ChunkCoord chunk : source.field().edited_chunks()) {
      if (chunk.x > 10) continue;  // the place that is far
      if (client.mirror().field().chunk_hash(chunk) != source.field().chunk_hash(chunk)) return false;
      ++same;
    }
    return same > 0;
  }

  std::vector<std::unique_ptr<ProxiedClient>> crowd;
};

/// Each attacker moves its interest to and fro between two places with rubble.
void move_to_and_fro(ProxiedClient& client, int round) {
  if (round % 8 == 0) client.send(InterestMessage{{round % 16 == 0 ? 400.0F : 0.0F, 2.0F, 0.0F}, 64.0F});
}

TEST_F(BytesOutAttackTest, interests_that_move_to_and_fro_draw_no_more_than_their_address_may) {
  open_with(budget, 2);
  join_attackers(hello());
  const Drawn drawn = attack(move_to_and_fro);
  EXPECT_LE(drawn.bytes, drawn.allowed());
  EXPECT_LE(drawn.honest_ticks, 60);
  EXPECT_GT(server->stats().bytes_out_held, 0U);
}

TEST_F(BytesOutAttackTest, interests_that_move_to_and_fro_draw_much_without_a_budget) {
  open_with(no_budget, 2);
  join_attackers(hello());
  const Drawn drawn = attack(move_to_and_fro);
  EXPECT_GT(drawn.bytes, 3.0 * drawn.allowed());
  EXPECT_EQ(server->stats().bytes_out_held, 0U);
}

/// Each attacker asks for the same ground again and again, which is generated once.
void ask_for_ground(ProxiedClient& client, int round) {
  static const std::vector<uint8_t> asks = [] {
    std::vector<ChunkCoord> chunks;
    for (int x = -8; x < 8; ++x)
      for (int z = -8; z < 8; ++z) chunks.push_back({x, -1, z});
    return encode(ClientMessage(AskGroundMessage{chunks}));
  }();
  if (round % 40 == 0) client.send_bytes(asks);
}

HelloMessage hello_without_kernels() {
  HelloMessage first = hello();
  first.lacks_kernels = true;
  return first;
}

TEST_F(BytesOutAttackTest, ground_is_drawn_no_more_than_an_address_may) {
  open_with(budget, 1);
  join_attackers(hello_without_kernels());
  const Drawn drawn = attack(ask_for_ground);
  EXPECT_LE(drawn.bytes, drawn.allowed());
  EXPECT_LE(drawn.honest_ticks, 60);
}

TEST_F(BytesOutAttackTest, ground_is_drawn_as_it_is_asked_for_without_a_budget) {
  open_with(no_budget, 1);
  join_attackers(hello_without_kernels());
  const Drawn drawn = attack(ask_for_ground);
  EXPECT_GT(drawn.bytes, 2.0 * drawn.allowed());
}

TEST_F(BytesOutAttackTest, who_comes_again_draws_no_more_than_who_stays) {
  open_with(budget, 1);
  const double begin_s = steady_now_s();
  Drawn drawn;
  for (int round = 0; drawn.seconds < seconds_of_attack; ++round) {
    ProxiedClient again(server->port(), "203.0.113.1");
    if (!again.join(hello())) break;  // the door has a limit of its own
    for (int i = 0; i < 6; ++i) {
      tick();
      server->flush();
      drawn.bytes += static_cast<double>(again.drop());
    }
    drawn.seconds = steady_now_s() - begin_s;
  }
  EXPECT_LE(drawn.bytes, drawn.allowed());
  expect_honest_served();
}

}  // namespace
}  // namespace scree
