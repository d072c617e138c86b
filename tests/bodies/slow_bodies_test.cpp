// What starts slowly: blocks slide just beyond their angle of friction, balls roll, slabs topple as rigid
// bodies do, and a tower stands.
#include <array>
#include <gtest/gtest.h>

#include "server/bodies/bodies.h"
#include "tests/support/tilted_ground.h"

namespace scree {
namespace {

constexpr float degree = 0.01745329F;
const float gravity_m_s2 = BodiesConfig().gravity_m_s2;

struct MaterialPair {
  Material body;
  Material ground;
};
Material named(const char* name) {
  const Palette& palette = builtin_palette();
  for (size_t i = 0; i < palette.rows.size(); ++i)
    if (palette.rows[i].name == name) return static_cast<Material>(i);
  ADD_FAILURE() << name;
  return {};
}
std::array<MaterialPair, 8> pairs() {
  return {{{named("rock"), named("rock")},
           {named("rock"), named("soil")},
           {named("ice"), named("rock")},
           {named("timber"), named("ice")},
           {named("steel"), named("glass")},
           {named("sand"), named("clay")},
           {named("snow"), named("ice")},
           {named("brick"), named("gravel")}}};
}
float angle_of_friction(const MaterialPair& pair) {
  return std::atan(std::sqrt(builtin_row(pair.body).friction * builtin_row(pair.ground).friction));
}

/// How far a block that is laid on a slope has slid after so many seconds.
float slid_m(const MaterialPair& pair, float angle, int seconds) {
  MapField field(ground(TerrainKind::flat));
  const Slope slope{.angle = angle};
  lay(field, slope, pair.ground);
  Bodies bodies(field, {});
  BodyShape block = box_shape({0.5F, 0.25F, 0.5F});
  block.friction = builtin_row(pair.body).friction;
  const BodyState laid = on_slope(1, slope, 0.25F);
  bodies.add(block, laid);
  step(bodies, 60 * seconds);
  return glm::dot(bodies.state(1).pose.position_m - laid.pose.position_m, slope.down());
}

TEST(SlowBodies, blocks_slide_beyond_their_angle_of_friction_and_stay_below_it) {
  constexpr float margin = 1.5F * degree;
  constexpr int seconds = 3;
  for (const MaterialPair& pair : pairs()) {
    const float limit = angle_of_friction(pair);
    const float steeper_m = slid_m(pair, limit + margin, seconds);
    const float flatter_m = slid_m(pair, limit - margin, seconds);
    const float pull_m_s2 = gravity_m_s2 * std::sin(margin) / std::cos(limit);
    const float exact_m = 0.5F * pull_m_s2 * static_cast<float>(seconds * seconds);
    std::printf("%5.2f degrees: steeper %.3f m (exact %.3f), flatter %.4f m\n",
                static_cast<double>(limit / degree), static_cast<double>(steeper_m),
                static_cast<double>(exact_m), static_cast<double>(flatter_m));
    EXPECT_GT(steeper_m, 0.5F * exact_m) << limit / degree;
    EXPECT_LT(flatter_m, 0.02F) << limit / degree;
  }
}

TEST(SlowBodies, a_ball_rolls_as_a_rigid_body_does) {
  MapField field(ground(TerrainKind::flat));
  const Slope slope{.angle = 15.0F * degree};
  lay(field, slope, material::rock);
  for (const int corners : {14, 20, 96}) {
    Bodies bodies(field, {});
    const BodyState laid = on_slope(1, slope, 0.6F);
    bodies.add(ball_shape(0.6F, corners), laid);
    constexpr int ticks = 120;
    step(bodies, ticks);
    const float rolled_m = glm::dot(bodies.state(1).pose.position_m - laid.pose.position_m, slope.down());
    const float exact_m = 0.5F * (5.0F / 7.0F) * gravity_m_s2 * std::sin(slope.angle) * 4.0F;
    std::printf("%d corners: rolled %.3f m, exact %.3f m\n", corners, static_cast<double>(rolled_m),
                static_cast<double>(exact_m));
    EXPECT_NEAR(rolled_m, exact_m, 0.05F * exact_m) << corners << " corners";
  }
}

TEST(SlowBodies, a_ball_rolls_to_a_stop_on_level_ground) {
  MapField field(ground(TerrainKind::flat));
  Bodies bodies(field, {});
  bodies.add(ball_shape(0.5F, 20), body_at(1, {0.0F, 0.5F, 0.0F}, {1.0F, 0.0F, 0.0F}));
  step(bodies, 120);
  EXPECT_GT(bodies.state(1).pose.position_m.x, 0.7F) << "it does not roll";
  step(bodies, 1080);
  EXPECT_LT(glm::length(bodies.state(1).velocity_m_s), 0.02F) << "it never stops";
}

/// Seconds until a rigid body that turns about its foot goes from one angle past its balance to another:
/// θ'' = (3/4) (g/r) sin θ, by small steps.
double pivot_s(double from, double to, double r_m) {
  constexpr double step_s = 1e-4;
  double angle = from, speed = 0.0, time_s = 0.0;
  while (angle < to && time_s < 60.0) {
    speed += 0.75 * static_cast<double>(gravity_m_s2) / r_m * std::sin(angle) * step_s;
    angle += speed * step_s;
    time_s += step_s;
  }
  return time_s;
}

/// Seconds until a slab of such half extents, set on its lower edge so far past its balance, lies 60 degrees
/// beyond it.
double toppled_s(glm::vec3 half_m, float past, int rate_hz) {
  MapField field(ground(TerrainKind::flat));
  BodiesConfig config;
  config.tick_rate_hz = static_cast<uint32_t>(rate_hz);
  Bodies bodies(field, config);
  const float balance = std::atan(half_m.x / half_m.y);
  const float r_m = std::sqrt(half_m.x * half_m.x + half_m.y * half_m.y);
  const float lean = balance + past;
  BodyState state = body_at(1, {r_m * std::sin(past), r_m * std::cos(past), 0.0F});
  state.pose.rotation = glm::angleAxis(-lean, glm::vec3(0.0F, 0.0F, 1.0F));
  bodies.add(box_shape(half_m), state);
  for (int tick = 0; tick < 30 * rate_hz; ++tick) {
    bodies.step();
    const glm::vec3 up = bodies.state(1).pose.rotation * glm::vec3(0.0F, 1.0F, 0.0F);
    if (std::atan2(up.x, up.y) - balance > 60.0F * degree) return static_cast<double>(tick + 1) / rate_hz;
  }
  return 1e9;
}

TEST(SlowBodies, slabs_topple_as_a_rigid_body_about_its_foot) {
  for (const glm::vec3 half_m : {glm::vec3(0.75F, 5.0F, 1.5F), glm::vec3(0.5F, 2.0F, 0.5F)})
    for (const float past : {3.0F, 12.0F})
      for (const int rate_hz : {30, 60, 240}) {
        const double r_m = std::sqrt(half_m.x * half_m.x + half_m.y * half_m.y);
        const double exact_s = pivot_s(past * degree, 60.0 * degree, r_m);
        const double here_s = toppled_s(half_m, past * degree, rate_hz);
        std::printf("%.1f m high, %.0f degrees past its balance, %d Hz: %.2f s, exact %.2f s\n",
                    static_cast<double>(2.0F * half_m.y), static_cast<double>(past), rate_hz, here_s,
                    exact_s);
        EXPECT_NEAR(here_s, exact_s, (past > 5.0F ? 0.05 : 0.25) * exact_s);
      }
}

}  // namespace
}  // namespace scree
