// Rest detection: what lies still on the ground merges, from the ground up; what moves does not.
#include "server/recombine/rest.h"

#include <cmath>
#include <gtest/gtest.h>

namespace scree {
namespace {

constexpr uint32_t rate_hz = 60;

RestPiece piece(PieceId id, glm::vec3 position_m) {
  return {id, {position_m, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)}, 0.5F};
}

using Ids = std::vector<PieceId>;

constexpr uint32_t rest_ticks = 20;  // a third of a second
constexpr int patience_ticks = 120;  // two seconds

TEST(RestDetector, what_sets_out_slowly_is_not_at_rest_and_what_creeps_evenly_is) {
  for (const bool gathers_speed : {true, false}) {
    RestDetector rest({}, rate_hz);
    bool rested = false;
    for (int tick = 1; tick <= 60; ++tick) {
      const float time_s = static_cast<float>(tick) / rate_hz;
      constexpr float pull_m_s2 = 0.26F, creep_m_s = 0.1F;
      const float speed_m_s = gathers_speed ? pull_m_s2 * time_s : creep_m_s;
      RestPiece sliding = piece(1, {(gathers_speed ? 0.5F : 1.0F) * speed_m_s * time_s, 1.0F, 0.0F});
      sliding.speed_m_s = speed_m_s;
      sliding.velocity_m_s = {speed_m_s, 0.0F, 0.0F};
      rested = rested || !rest.update({{sliding}}, {{1}}, {}, 1).empty();
    }
    EXPECT_EQ(rested, !gathers_speed);
  }
}

TEST(RestDetector, what_is_fast_is_not_at_rest_until_it_counts_as_stuck) {
  RestDetector rest({}, rate_hz);
  RestPiece shaking = piece(1, {0.0F, 1.0F, 0.0F});
  shaking.speed_m_s = 0.21F;
  constexpr int stuck_ticks = 240;
  for (int tick = 0; tick < stuck_ticks; ++tick) EXPECT_TRUE(rest.update({{shaking}}, {{1}}, {}, 1).empty());
  bool rested = false;
  for (int tick = 0; tick < 60; ++tick) rested = rested || !rest.update({{shaking}}, {{1}}, {}, 1).empty();
  EXPECT_TRUE(rested) << "it shakes without an end";
}

TEST(Rest, a_still_piece_on_terrain_merges_after_the_rest_time) {
  RestDetector rest({}, rate_hz);
  const std::vector<RestPiece> pieces = {piece(3, {0.0F, 1.0F, 0.0F})};
  const Ids ground = {3};
  for (uint32_t tick = 0; tick < rest_ticks; ++tick)
    EXPECT_TRUE(rest.update(pieces, ground, {}, 8).empty()) << "tick " << tick;
  EXPECT_EQ(rest.update(pieces, ground, {}, 8), ground);
}

TEST(Rest, what_hangs_in_the_air_does_not_merge) {
  RestDetector rest({}, rate_hz);
  const std::vector<RestPiece> pieces = {piece(1, {0.0F, 9.0F, 0.0F})};
  for (int tick = 0; tick < 200; ++tick) EXPECT_TRUE(rest.update(pieces, {}, {}, 8).empty());
  EXPECT_EQ(rest.at_rest(), 1U);
}

TEST(Rest, a_pile_merges_from_the_ground_up) {
  RestDetector rest({}, rate_hz);
  const std::vector<RestPiece> pieces = {piece(1, {0.0F, 3.0F, 0.0F}), piece(2, {0.0F, 2.0F, 0.0F}),
                                         piece(4, {0.0F, 1.0F, 0.0F}), piece(7, {5.0F, 0.5F, 0.0F}),
                                         piece(9, {9.0F, 0.1F, 0.0F})};
  const Ids ground = {4, 7};
  const std::vector<RestSupport> supports = {{1, 2}, {2, 4}};
  Ids ready;
  for (int tick = 0; tick < 40; ++tick) ready = rest.update(pieces, ground, supports, 8);
  EXPECT_EQ(ready, (Ids{7, 4, 2, 1})) << "lowest on terrain first; 9 lies on nothing";
  EXPECT_EQ(rest.update(pieces, ground, supports, 3), (Ids{7, 4, 2}));
}

TEST(Rest, what_lies_on_a_moving_piece_waits) {
  RestDetector rest({}, rate_hz);
  const Ids ground = {1};
  const std::vector<RestSupport> supports = {{2, 1}};
  for (int tick = 0; tick < 100; ++tick) {
    const std::vector<RestPiece> pieces = {piece(1, {0.05F * static_cast<float>(tick), 1.0F, 0.0F}),
                                           piece(2, {0.0F, 2.0F, 0.0F})};
    EXPECT_TRUE(rest.update(pieces, ground, supports, 8).empty());
  }
}

TEST(Rest, jitter_about_a_place_is_rest) {
  RestDetector rest({}, rate_hz);
  const Ids ground = {1};
  Ids ready;
  for (int tick = 0; tick < 30; ++tick) {
    const float shake_m = tick % 2 == 0 ? 0.01F : -0.01F;
    const std::vector<RestPiece> pieces = {piece(1, {shake_m, 1.0F, 0.0F})};
    ready = rest.update(pieces, tick % 3 == 0 ? ground : Ids{}, {}, 8);  // the contact flickers
  }
  EXPECT_EQ(ready, ground);
}

TEST(Rest, what_touched_the_ground_long_ago_lies_on_nothing) {
  RestDetector rest({}, rate_hz);
  const std::vector<RestPiece> pieces = {piece(1, {0.0F, 1.0F, 0.0F})};
  const Ids ground = {1};
  static_assert(RestConfig{}.rest_s > RestConfig{}.contact_s);
  rest.update(pieces, ground, {}, 8);
  for (int tick = 0; tick < 100; ++tick)
    EXPECT_TRUE(rest.update(pieces, {}, {}, 8).empty()) << tick << " ticks after it touched the ground";
  EXPECT_EQ(rest.at_rest(), 1U);
}

TEST(Rest, spinning_on_the_spot_is_not_rest) {
  RestDetector rest({}, rate_hz);
  const Ids ground = {1};
  for (int tick = 0; tick < 100; ++tick) {
    RestPiece spinning = piece(1, {0.0F, 1.0F, 0.0F});
    const float half = 0.02F * static_cast<float>(tick);
    spinning.pose.rotation = glm::quat(std::cos(half), 0.0F, std::sin(half), 0.0F);
    EXPECT_TRUE(rest.update({&spinning, 1}, ground, {}, 8).empty());
  }
}

TEST(Rest, a_creeping_piece_merges_in_the_end) {
  RestDetector rest({}, rate_hz);
  const Ids ground = {1};
  int merged_at = -1;
  for (int tick = 0; tick < 720 && merged_at < 0; ++tick) {
    const std::vector<RestPiece> pieces = {piece(1, {0.005F * static_cast<float>(tick), 1.0F, 0.0F})};
    if (!rest.update(pieces, ground, {}, 8).empty()) merged_at = tick;  // 0.3 m/s
  }
  EXPECT_GT(merged_at, patience_ticks);
}

TEST(Rest, takes_as_long_at_every_tick_rate) {
  for (const uint32_t hz : {10U, 30U, 120U, 240U}) {
    RestDetector rest({}, hz);
    const std::vector<RestPiece> pieces = {piece(1, {0.0F, 1.0F, 0.0F})};
    uint32_t tick = 0;
    while (rest.update(pieces, Ids{1}, {}, 8).empty()) ++tick;
    EXPECT_NEAR(static_cast<double>(tick) / hz, 1.0 / 3.0, 1.0 / hz) << hz << " Hz";
  }
}

TEST(Rest, an_id_that_vanishes_is_forgotten) {
  RestDetector rest({}, rate_hz);
  const std::vector<RestPiece> pieces = {piece(1, {0.0F, 1.0F, 0.0F}), piece(2, {3.0F, 1.0F, 0.0F})};
  const Ids ground = {1, 2};
  for (int tick = 0; tick < 40; ++tick) rest.update(pieces, ground, {}, 8);
  EXPECT_EQ(rest.update({&pieces[1], 1}, ground, {}, 8), (Ids{2}));
  EXPECT_EQ(rest.update(pieces, ground, {}, 8), (Ids{2})) << "1 starts anew";
}

TEST(Rest, in_a_hurry_half_of_it_will_do_and_what_waits_is_counted) {
  RestDetector rest({}, rate_hz);
  const std::vector<RestPiece> pieces = {piece(1, {0.0F, 1.0F, 0.0F}), piece(2, {5.0F, 1.0F, 0.0F})};
  const Ids ground = {1, 2};
  for (uint32_t tick = 0; tick < rest_ticks / 2; ++tick)
    EXPECT_TRUE(rest.update(pieces, ground, {}, 1, true).empty()) << "tick " << tick;
  EXPECT_EQ(rest.update(pieces, ground, {}, 1, true).size(), 1U);
  EXPECT_EQ(rest.put_off(), 1U);
}

}  // namespace
}  // namespace scree
