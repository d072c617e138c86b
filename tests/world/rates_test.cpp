// A world goes the same way at every tick rate: constants are in seconds, and no step of the bodies is too
// long.
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>
#include <map>

#include "bench/support/scenes.h"
#include "server/world/world.h"
#include "tests/support/flat_world.h"

namespace scree {
namespace {

struct Settling {
  double settled_s = 0.0;  ///< until every piece was terrain again
  float highest_m = 0.0F;  ///< of any piece, above the ground
};

Settling settling_at(uint32_t rate_hz) {
  WorldConfig config = flat_world();
  config.tick_rate_hz = rate_hz;
  World world(config);
  const std::vector<Command> carve{{1, 1, blow_at(config.terrain, 0.0F, 0.0F, 2.0F, 48, 5)}};
  auto delta = world.step(carve);
  Settling settling;
  const uint32_t ticks_max = 60 * rate_hz;
  while (!delta->pieces.empty() && delta->tick < ticks_max) {
    for (const PieceState& piece : delta->pieces)
      settling.highest_m = std::max(settling.highest_m, dequantise(piece.pose).position_m.y);
    delta = world.step({});
  }
  settling.settled_s = static_cast<double>(delta->tick) / rate_hz;
  return settling;
}

class Rates : public ::testing::TestWithParam<uint32_t> {};

TEST_P(Rates, pieces_settle_as_soon_and_rise_no_higher_than_at_60_hz) {
  const Settling usual = settling_at(60), here = settling_at(GetParam());
  std::printf("%u Hz: settled after %.2f s (60 Hz: %.2f), highest %.2f m (%.2f)\n", GetParam(),
              here.settled_s, usual.settled_s, static_cast<double>(here.highest_m),
              static_cast<double>(usual.highest_m));
  EXPECT_LT(here.settled_s, 1.6 * usual.settled_s);
  EXPECT_GT(here.settled_s, 0.6 * usual.settled_s);
  EXPECT_LT(here.highest_m, usual.highest_m + 0.5F);
}

/// Two tunnels that cross within rock, cut without a blast: the second's pieces lie in and over the first's,
/// and only gravity and the overlaps move them.
TEST_P(Rates, nothing_moves_faster_in_crossing_tunnels_than_it_could_fall) {
  WorldConfig config = flat_world();
  config.tick_rate_hz = GetParam();
  World world(config);
  CarveRequest request;
  request.seeds = 64;
  request.blast_speed_m_s = 0.0F;
  request.shape = capsule({-5.0F, -6.0F, 0.0F}, {5.0F, -6.0F, 0.0F}, 1.5F);
  request.impact_m = {0.0F, -6.0F, 0.0F};
  world.step(std::vector<Command>{{1, 1, request}});
  request.shape = capsule({0.0F, -5.5F, -5.0F}, {0.0F, -5.5F, 5.0F}, 1.5F);
  auto delta = world.step(std::vector<Command>{{1, 2, request}});
  std::map<PieceId, glm::vec3> last_m;
  float fastest_m_s = 0.0F;
  for (uint32_t tick = 0; tick < 8 * GetParam() && !delta->pieces.empty(); ++tick) {
    for (const PieceState& piece : delta->pieces) {
      const glm::vec3 at_m = dequantise(piece.pose).position_m;
      const auto [found, is_new] = last_m.try_emplace(piece.id, at_m);
      const glm::vec3 way_m = at_m - found->second;
      found->second = at_m;
      fastest_m_s = std::max(fastest_m_s, std::sqrt(glm::dot(way_m, way_m)) * static_cast<float>(GetParam()));
    }
    delta = world.step({});
  }
  EXPECT_GT(fastest_m_s, 1.0F);
  EXPECT_LT(fastest_m_s, std::sqrt(2.0F * 9.81F * 3.5F)) << "the tunnels are 3.5 m high together";
}

INSTANTIATE_TEST_SUITE_P(hz, Rates, ::testing::Values(10U, 20U, 30U, 60U, 120U, 240U));

}  // namespace
}  // namespace scree
