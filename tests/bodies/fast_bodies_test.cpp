// What is fast: bodies fall as long as gravity says, and pass neither terrain nor each other.
#include <gtest/gtest.h>

#include "server/bodies/bodies.h"
#include "server/bodies/limits.h"
#include "tests/support/tilted_ground.h"

namespace scree {
namespace {

/// Seconds after which a block that falls so far strikes the ground.
double fall_s(float height_m, uint32_t rate_hz, float voxel_size_m) {
  MapField field(TerrainSource{TerrainKind::flat, 7, voxel_size_m});
  BodiesConfig config;
  config.tick_rate_hz = rate_hz;
  Bodies bodies(field, config);
  const float half_m = 2.0F * voxel_size_m;
  bodies.add(box_shape(glm::vec3(half_m)), body_at(1, {0.1F, height_m + half_m, 0.1F}));
  for (uint32_t tick = 1; tick < 30 * rate_hz; ++tick) {
    bodies.step();
    if (!bodies.impacts(limits::struck_speed_min_m_s).empty()) {
      EXPECT_GT(bodies.state(1).pose.position_m.y, 0.9F * half_m);
      EXPECT_LT(bodies.state(1).pose.position_m.y, half_m + 0.2F);
      return static_cast<double>(tick) / rate_hz;
    }
  }
  return 1e9;
}

TEST(FastBodies, a_fall_of_300_m_takes_as_long_at_every_rate_and_size_of_voxels) {
  const double exact_s = std::sqrt(2.0 * 300.0 / static_cast<double>(BodiesConfig().gravity_m_s2));
  for (const float voxel : {0.1F, 0.15F, 0.25F, 1.0F})
    for (const uint32_t rate_hz : {30U, 60U, 120U, 240U}) {
      const double here_s = fall_s(300.0F, rate_hz, voxel);
      std::printf("%.2f m, %u Hz: %.3f s, exact %.3f s\n", static_cast<double>(voxel), rate_hz, here_s,
                  exact_s);
      EXPECT_NEAR(here_s, exact_s, 0.01 * exact_s) << voxel << " m, " << rate_hz << " Hz";
    }
}

/// How many of 40 blocks, shot at a plate from places a little apart, are beyond it after a second.
int passed(float speed_m_s, float half_m, float thickness_m, bool is_terrain) {
  MapField field(ground(TerrainKind::flat));
  PieceTable pieces;
  constexpr float height_m = 200.0F;
  const glm::vec3 plate_half_m(0.5F * thickness_m, 3.0F, 3.0F);
  if (is_terrain) apply(FillOperation{box({0.0F, height_m, 0.0F}, plate_half_m)}, field, pieces);
  int count = 0;
  for (int shot = 0; shot < 40; ++shot) {
    BodiesConfig config;
    config.gravity_m_s2 = 0.0F;
    Bodies bodies(field, config);
    if (!is_terrain) bodies.add(box_shape(plate_half_m), body_at(1, {0.0F, height_m, 0.0F}));
    const float from_m = -5.0F - 0.37F * static_cast<float>(shot);
    const float aside_m = 0.05F * static_cast<float>(shot) - 1.0F;
    BodyState state = body_at(2, {from_m, height_m + aside_m, aside_m}, {speed_m_s, 0.0F, 0.0F});
    state.pose.rotation =
        glm::angleAxis(0.3F * static_cast<float>(shot), glm::normalize(glm::vec3(1.0F, 2.0F, 3.0F)));
    bodies.add(box_shape(glm::vec3(half_m)), state);
    step(bodies, 60);
    const float plate_m = is_terrain ? 0.0F : bodies.state(1).pose.position_m.x;
    count += bodies.state(2).pose.position_m.x > plate_m ? 1 : 0;
  }
  return count;
}

TEST(FastBodies, none_passes_through_a_plate) {
  for (const float speed : {10.0F, 29.0F, 60.0F, 190.0F})
    for (const float half : {0.1F, 0.3F}) {
      const int pieces = passed(speed, half, 0.1F, false);
      const int terrain = passed(speed, half, voxel_m, true);
      std::printf("%.0f m/s, %.1f m: %d of 40 pass a piece, %d terrain\n", static_cast<double>(speed),
                  static_cast<double>(2.0F * half), pieces, terrain);
      // A heavy block that strikes a plate with a corner has its spin cut: few come through beyond 30 m/s.
      EXPECT_LE(pieces, speed < 30.0F ? 0 : 4) << speed << " m/s, half " << half << " m";
      EXPECT_EQ(terrain, 0) << speed << " m/s, half " << half << " m";
    }
}

/// The greatest impulse of the blows of a block that falls flat, as a share of its momentum.
float share_in_one_blow(float height_m, uint32_t rate_hz) {
  MapField field(ground(TerrainKind::flat));
  BodiesConfig config;
  config.tick_rate_hz = rate_hz;
  Bodies bodies(field, config);
  bodies.add(box_shape(glm::vec3(0.5F)), body_at(1, {0.1F, height_m + 0.5F, 0.1F}));
  const float speed_m_s = std::sqrt(2.0F * config.gravity_m_s2 * height_m);
  float most = 0.0F;
  for (uint32_t tick = 0; tick < 10 * rate_hz; ++tick) {
    bodies.step();
    for (const BodyImpact& impact : bodies.impacts(limits::struck_speed_min_m_s))
      most = std::max(most, impact.impulse_n_s / (bodies.mass_kg(1) * speed_m_s));
  }
  return most;
}

TEST(FastBodies, a_blow_is_one_whatever_the_rate) {
  for (const float height_m : {5.0F, 20.0F, 78.0F})
    for (const uint32_t rate_hz : {30U, 60U, 120U, 240U}) {
      const float share = share_in_one_blow(height_m, rate_hz);
      std::printf("%.0f m, %u Hz: %.3f of the momentum in the hardest blow\n", static_cast<double>(height_m),
                  rate_hz, static_cast<double>(share));
      EXPECT_GT(share, 0.95F) << height_m << " m, " << rate_hz << " Hz";
      EXPECT_LT(share, 1.15F) << height_m << " m, " << rate_hz << " Hz";
    }
}

}  // namespace
}  // namespace scree
