// Spans with several supports: beams, plates and arches beside theory, and whole worlds in which decks fall.
#include <cmath>
#include <gtest/gtest.h>

#include "bench/support/span_cases.h"
#include "server/world/rules.h"
#include "server/world/world.h"
#include "shared/base/random.h"
#include "shared/falling/spring_frame.h"
#include "shared/falling/support_search.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/flat_world.h"
#include "tests/support/rounds.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

bool breaks(const BuildSpan& build, float span_m) {
  return !search_span(build, span_m).overloads.empty();
}

TEST(spans, break_within_fifteen_percent_of_theory) {
  for (const SpanCase& one : span_cases(true))
    EXPECT_NEAR(found_span_m(one) / one.theory_m, 1.0, 0.15) << one.name;
}

TEST(spans, a_longer_beam_never_stands_longer_and_a_thicker_one_never_breaks_sooner) {
  float before_m = 0.0F;
  for (const float height_m : {0.5F, 1.0F, 2.0F}) {
    const BuildSpan build = clamped_beam(height_m, 0.0F);
    float breaks_m = 0.0F;
    for (float span_m = 6.0F; span_m <= 34.0F; span_m += rounds(1.0F, 4.0F)) {
      const bool broken = breaks(build, span_m);
      EXPECT_TRUE(broken || breaks_m == 0.0F) << height_m << " m stands at " << span_m << " m";
      if (broken && breaks_m == 0.0F) breaks_m = span_m;
    }
    EXPECT_GT(breaks_m, before_m) << height_m;
    before_m = breaks_m;
  }
}

TEST(spans, an_arch_stands_where_a_flat_beam_falls) {
  for (const float span_m : {20.0F, 26.0F}) {
    EXPECT_FALSE(breaks(parabolic_arch(6.0F, 1.0F), span_m)) << span_m;
    EXPECT_TRUE(breaks(clamped_beam(1.0F, 0.0F), span_m)) << span_m;
  }
}

TEST(spans, a_clamped_beam_breaks_at_its_ends_first) {
  const SpansFound found = search_span(clamped_beam(1.0F, 0.0F), 16.0F);
  ASSERT_EQ(found.overloads.size(), 1U);
  EXPECT_TRUE(found.overloads[0].by_leverage);
  bool left = false, right = false;
  for (const Neck& neck : found.overloads[0].necks) {
    left = left || (neck.box.lo.x <= 3 && neck.box.hi.x >= -1);
    right = right || (neck.box.lo.x <= 65 && neck.box.hi.x >= 61);
    EXPECT_GT(neck.section_voxels, 20);
  }
  EXPECT_TRUE(left || right);
}

/// Decks and their blocks, as commands of a world.
std::vector<Command> deck(float span_m) {
  const auto pour = [](glm::vec3 lo, glm::vec3 hi) {
    return Command{1, 1, FillRequest{box(0.5F * (lo + hi), 0.5F * (hi - lo))}};
  };
  std::vector<Command> commands{pour({-6.0F, -0.5F, -6.0F}, {0.0F, 9.0F, 6.0F}),
                                pour({span_m, -0.5F, -6.0F}, {span_m + 6.0F, 9.0F, 6.0F})};
  for (float x = -0.5F; x < span_m + 0.5F; x += 10.0F)
    commands.push_back(pour({x, 6.3F, -1.0F}, {std::min(x + 10.4F, span_m + 0.5F), 6.8F, 1.0F}));
  return commands;
}

size_t islands_of_deck(float span_m, uint32_t rules) {
  WorldConfig config = rock_world();
  config.terrain = rock_terrain;
  config.terrain.rows = config.palette->ground;
  config.rules = rules;
  World world(config);
  size_t islands = 0;
  CarveRequest scratch;
  scratch.shape = box({0.5F * span_m, 6.85F, 0.0F}, {0.3F, 0.2F, 0.3F});
  scratch.seeds = 1;
  for (int tick = 0; tick < 120; ++tick) {
    // The deck is whole before anybody looks at it.
    std::vector<Command> commands;
    if (tick == 0) commands = deck(span_m);
    if (tick == 60) commands = {{1, 2, SettingsRequest{{{"support", "true"}}}}};
    if (tick == 61) commands = {{1, 3, scratch}};
    const auto delta = step(world, commands);
    EXPECT_EQ(delta->ledger.error(), 0);
    for (const AppliedOperation& applied : delta->operations)
      islands += std::holds_alternative<IslandOperation>(applied.operation) ? 1 : 0;
  }
  return islands;
}

TEST(spans, a_long_deck_falls_and_a_short_one_stays) {
  EXPECT_EQ(islands_of_deck(6.0F, rules::newest), 0U);
  EXPECT_GE(islands_of_deck(100.0F, rules::newest), 1U);
}

TEST(spans, worlds_of_the_rules_before_hold_what_has_two_ends) {
  EXPECT_EQ(islands_of_deck(100.0F, rules::spare_time), 0U);
}

TEST(spans, generated_terrain_holds_itself) {
  const float half_m = rounds(48.0F, 16.0F);
  const auto overloads_of = [&](TerrainSource source) {
    MapField field(source);
    size_t overloads = 0;
    for (float x = -half_m; x < half_m; x += 8.0F)
      for (float z = -half_m; z < half_m; z += 8.0F) {
        const glm::vec3 at = glm::vec3(x, ground_height_m(source, x, z), z) / source.voxel_size_m;
        const BrickCoord brick =
            brick_of(VoxelCoord{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)});
        overloads += find_spans(field, builtin_palette(), std::vector<BrickCoord>{brick}).overloads.size();
      }
    return overloads;
  };
  EXPECT_EQ(overloads_of({TerrainKind::flat, 3, 0.25F}), 0U);
  EXPECT_EQ(overloads_of({TerrainKind::canyon, 1, 0.25F}), 0U);
  EXPECT_LE(overloads_of({TerrainKind::noise, 1, 0.25F}), 2U);
}

TEST(spans, a_frame_of_springs_is_in_equilibrium_and_bends_as_a_beam_does) {
  // 8 bodies in a row, held at one end: EI = 1 in all springs of length 1, a load across at the far end.
  constexpr uint32_t count = 8;
  std::vector<SpringFrame::Spring> springs;
  SpringFrame frame(count);
  for (uint32_t i = 0; i < count; ++i) {
    SpringFrame::Spring spring{i == 0 ? SpringFrame::fixed : i - 1,
                               i,
                               {0.5, 0.0, 0.0},
                               {-0.5, 0.0, 0.0},
                               {1.0, 12.0, 12.0, 1.0, 1.0, 1.0}};
    springs.push_back(spring);
    frame.add(spring);
  }
  ASSERT_TRUE(frame.factorise(1000));
  std::vector<Six> moves(count);
  moves[count - 1][1] = -3.0;
  frame.solve(moves);
  EXPECT_NEAR(moves[count - 1][1], -3.0 * 8.0 * 8.0 * 8.0 / 3.0, 1e-6);  // F L³ / 3 EI
  std::vector<Six> loads(count);
  for (const SpringFrame::Spring& spring : springs) {
    Six forces = SpringFrame::opening(spring, moves);
    for (size_t k = 0; k < 6; ++k) forces[k] *= spring.stiffness[k];
    SpringFrame::push(spring, forces, loads);
  }
  for (uint32_t i = 0; i < count; ++i)
    for (size_t k = 0; k < 6; ++k)
      EXPECT_NEAR(loads[i][k], i == count - 1 && k == 1 ? 3.0 : 0.0, 1e-6) << i << " " << k;
}

TEST(spans, a_frame_that_nothing_holds_is_refused) {
  SpringFrame frame(2);
  frame.add({0, 1, {0.5, 0.0, 0.0}, {-0.5, 0.0, 0.0}, {1.0, 1.0, 1.0, 1.0, 1.0, 1.0}});
  EXPECT_FALSE(frame.factorise(1000));
}

}  // namespace
}  // namespace scree
