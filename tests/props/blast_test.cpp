// Blasts: what their energy breaks, how they throw, and what shields.
#include "shared/operation/blast.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

/// Cubic metres that the terrain lost in the tick of a blast.
double crater_m3(PropWorld& world, const BlastRequest& blast) {
  const MassUnits before = world.last().ledger.terrain;
  const Reply reply = world.ask(blast);
  EXPECT_EQ(reply.refusal, "");
  const double voxel_m3 = std::pow(static_cast<double>(voxel_m), 3.0);
  return static_cast<double>(before - world.last().ledger.terrain) / units_per_voxel * voxel_m3;
}

TEST(Blast, the_crater_grows_with_the_energy_over_two_decades) {
  for (const double energy_j : {3e7, 1e8, 3e8, 1e9, 3e9}) {
    PropWorld world(rock_world());
    world.step();
    const double expected_m3 = energy_j / static_cast<double>(breaking_j_m3(builtin_palette().rows.front()));
    const double found_m3 = crater_m3(world, {{0.0F, 0.0F, 0.0F}, static_cast<float>(energy_j), 3});
    std::printf("%.0e J: %.2f m3, %.2f by energy\n", energy_j, found_m3, expected_m3);
    EXPECT_NEAR(found_m3 / expected_m3, 1.0, 0.2);
  }
}

TEST(Blast, loose_ground_gives_more_than_rock) {
  PropWorld rock(rock_world()), soil(flat_world());
  rock.step();
  soil.step();
  const BlastRequest blast{{0.0F, 0.0F, 0.0F}, 4e6F, 1};
  EXPECT_GT(crater_m3(soil, blast), 1.5 * crater_m3(rock, blast));
}

TEST(Blast, in_the_air_it_breaks_nothing_and_still_throws) {
  PropWorld world(rock_world());
  Prop floats = crate();
  floats.gravity = 0.0F;
  const PieceId id = world.add(floats, {3.0F, 4.0F, 0.0F});
  world.steps(10);
  const glm::vec3 before_m = world.place_m(id);
  EXPECT_EQ(crater_m3(world, {{0.0F, 4.0F, 0.0F}, 4e7F, 1}), 0.0);
  world.steps(30);
  EXPECT_GT(glm::distance(world.place_m(id), before_m), 0.1F);
}

/// The speed of a crate without gravity after a blast.
float thrown_m_s(PropWorld& world, glm::vec3 place_m, const BlastRequest& blast) {
  Prop target = crate();
  target.gravity = 0.0F;
  const PieceId id = world.add(target, place_m);
  world.ask(blast);
  const glm::vec3 before_m = world.place_m(id);
  world.step();
  return glm::distance(world.place_m(id), before_m) * 60.0F;
}

TEST(Blast, throws_less_far_away_and_behind_a_wall_less_than_a_tenth) {
  const BlastRequest blast{{0.0F, 4.0F, 0.0F}, 5e8F, 1};
  PropWorld near(rock_world()), far(rock_world()), behind(rock_world());
  const float near_m_s = thrown_m_s(near, {6.0F, 4.0F, 0.0F}, blast),
              far_m_s = thrown_m_s(far, {12.0F, 4.0F, 0.0F}, blast);
  EXPECT_GT(near_m_s, 1.6F * far_m_s);
  EXPECT_GT(far_m_s, 0.5F);
  behind.ask(FillRequest{box({8.0F, 4.0F, 0.0F}, {1.0F, 4.0F, 6.0F})});
  const float behind_m_s = thrown_m_s(behind, {12.0F, 4.0F, 0.0F}, blast);
  std::printf("%.2f m/s at 6 m, %.2f at 12 m, %.2f behind a wall of 2 m\n", static_cast<double>(near_m_s),
              static_cast<double>(far_m_s), static_cast<double>(behind_m_s));
  EXPECT_LT(behind_m_s, 0.1F * far_m_s);
}

TEST(Blast, refuses_energies_that_are_none) {
  PropWorld world(flat_world());
  for (const float energy_j : {0.0F, -1.0F, 1e30F, std::numeric_limits<float>::quiet_NaN()})
    EXPECT_EQ(refusal_name(world.ask(BlastRequest{{0.0F, 0.0F, 0.0F}, energy_j, 1})), "blast_invalid");
  EXPECT_EQ(refusal_name(world.ask(BlastRequest{{0.0F, 1e7F, 0.0F}, 1e6F, 1})), "blast_invalid");
}

TEST(Blast, goes_the_same_way_each_time) {
  std::vector<uint64_t> hashes;
  for (int i = 0; i < 2; ++i) {
    PropWorld world(rock_world());
    world.add(crate(), {3.0F, 0.5F, 0.0F});
    world.ask(BlastRequest{{0.0F, 0.0F, 0.0F}, 1e8F, 5});
    world.steps(120);
    hashes.push_back(world.last().state_hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

}  // namespace
}  // namespace scree
