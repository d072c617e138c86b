// What falls far breaks as often at every tick rate, and none of it leaves the world through the ground.
#include <algorithm>
#include <gtest/gtest.h>

#include "server/world/world.h"
#include "tests/support/flat_world.h"

namespace scree {
namespace {

constexpr float fall_m = 78.0F;
constexpr int falls = 12;

/// How often a block of rock, cut loose so high, and its pieces break, until all are terrain.
uint32_t breaks_of(uint32_t rate_hz, int fall) {
  WorldConfig config = flat_world();
  config.tick_rate_hz = rate_hz;
  config.methods.dents = false;
  World world(config);
  const float off_m = 0.11F * static_cast<float>(fall);
  const glm::vec3 centre_m(off_m, fall_m + 0.75F, 0.7F * off_m);
  CarveRequest carve;
  carve.shape = box(centre_m, glm::vec3(1.35F));
  carve.seeds = 1;
  carve.impact_m = centre_m - glm::vec3(0.0F, 20.0F, 0.0F);
  carve.blast_speed_m_s = 0.0F;
  const std::vector<Command> commands{{1, 1, FillRequest{box(centre_m, glm::vec3(0.75F))}}, {1, 2, carve}};
  auto delta = world.step(commands);
  uint32_t breaks = 0;
  bool is_born = false;  // a tick may have no room for the carve
  while ((!is_born || !delta->pieces.empty()) && delta->tick < 40 * rate_hz) {
    is_born = is_born || !delta->pieces.empty();
    delta = world.step({});
    EXPECT_EQ(delta->ledger.error(), 0);
    for (const AppliedOperation& applied : delta->operations) {
      breaks += std::holds_alternative<ShatterOperation>(applied.operation) ? 1 : 0;
      EXPECT_FALSE(std::holds_alternative<DiscardOperation>(applied.operation));
    }
  }
  EXPECT_TRUE(delta->pieces.empty());
  return breaks;
}

TEST(FastPieces, a_block_that_falls_78_m_breaks_as_often_at_every_rate) {
  std::vector<double> means;
  for (const uint32_t rate_hz : {30U, 60U, 120U, 240U}) {
    uint32_t breaks = 0;
    for (int fall = 0; fall < falls; ++fall) breaks += breaks_of(rate_hz, fall);
    means.push_back(static_cast<double>(breaks) / falls);
    std::printf("%u Hz: %.2f breaks a fall\n", rate_hz, means.back());
  }
  const auto [least, most] = std::ranges::minmax(means);
  EXPECT_GE(least, 1.0);
  EXPECT_LT(most, 1.1 * least);
}

}  // namespace
}  // namespace scree
