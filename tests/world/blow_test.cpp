// Blows break terrain: a harder one never less; no energy is made; weak ones add up; older worlds stay.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "bench/support/blow_scenes.h"
#include "server/world/blow_stage.h"
#include "server/world/impact_stage.h"
#include "server/world/limits.h"
#include "server/world/rules.h"
#include "server/world/spawn.h"
#include "server/world/struck_places.h"
#include "tests/support/flat_world.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

BlowScene scene_of(const std::string& name) {
  const std::vector<BlowScene> all = blow_scenes();
  return *std::ranges::find(all, name, &BlowScene::name);
}

TEST(Blows, a_harder_one_never_breaks_less_and_by_older_rules_they_break_nothing) {
  for (const char* name : {"roof", "pillar", "plate"}) {
    const BlowScene scene = scene_of(name);
    int64_t least = 0;
    size_t gone = 0;
    for (const float speed_m_s : scene.speeds_m_s) {
      const BlowOutcome outcome = strike(scene, speed_m_s, rules::blows);
      // One that is slower sinks a little more on its way, and strikes lower.
      EXPECT_GE(static_cast<double>(outcome.first), 0.9 * static_cast<double>(least))
          << name << " at " << speed_m_s;
      least = std::max(least, outcome.first);
      gone = outcome.gone;
    }
    const BlowOutcome before = strike(scene, scene.speeds_m_s.back(), rules::by_place);
    EXPECT_GT(gone, scene.places_m.size() / 4) << name;
    EXPECT_LT(before.gone, gone / 2) << name;
  }
}

/// The kinetic energy of all bodies, spin included, and their height's.
double energy_j(const World::State& state) {
  double sum = 0.0;
  for (const auto& [id, volume] : state.pieces) {
    const BodyState body = state.bodies.state(id);
    const auto kg = static_cast<double>(state.bodies.mass_kg(id));
    const glm::mat3 turned = glm::mat3_cast(body.pose.rotation);
    const glm::mat3 inertia = turned * state.bodies.shape(id)->inertia_kg_m2 * glm::transpose(turned);
    sum += 0.5 * kg * static_cast<double>(glm::dot(body.velocity_m_s, body.velocity_m_s));
    sum += 0.5 * static_cast<double>(glm::dot(body.spin_rad_s, inertia * body.spin_rad_s));
    sum += kg * 9.81 * static_cast<double>(body.pose.position_m.y);
  }
  return sum;
}

/// A block that flies at a wall of half a metre.
void throw_at_wall(World::State& state, TickDelta& delta, float speed_m_s) {
  apply(FillOperation{box({0.125F, 2.0F, 0.0F}, {0.25F, 4.0F, 3.0F})}, state.field, state.pieces);
  apply(FillOperation{box({-20.0F, 12.0F, 0.0F}, glm::vec3(1.0F))}, state.field, state.pieces);
  const Applied cut = state.apply_and_record(
      CarveOperation{box({-20.0F, 12.0F, 0.0F}, glm::vec3(1.6F)), SeedPattern::uniform, 1, 1, {}, 1}, 0,
      delta);
  ASSERT_EQ(cut.created.size(), 1U);
  const auto born = [&](PieceId, const Volume&) {
    Newborn piece;
    piece.body.pose.position_m = {-1.5F, 3.0F, 0.0F};
    piece.body.velocity_m_s = {speed_m_s, 0.0F, 0.0F};
    piece.body.spin_rad_s = {0.0F, 0.4F, 0.2F};
    return piece;
  };
  spawn(state, cut, born, delta);
  state.enter_removed(cut);
}

TEST(Blows, a_wall_takes_energy_and_the_rest_stays_with_what_goes_through) {
  for (const float speed_m_s : {6.0F, 15.0F, 40.0F}) {
    World::State state(rock_world(), 1);
    state.config.methods.impacts = false;
    TickDelta delta;
    throw_at_wall(state, delta, speed_m_s);
    delta.spawned.clear();  // what is made in a tick breaks nothing in it
    const PieceId block = state.pieces.begin()->first;
    bool broke = false;
    for (int i = 0; i < 60 && !broke; ++i) {
      const double before = energy_j(state);
      state.bodies.step();
      const double stopped = energy_j(state);
      const std::map<PieceId, float> borne = break_terrain(state, delta);
      broke = !borne.empty();
      double made = 0.0;  // pieces of the wall had their height before they were pieces
      for (const auto& [id, volume] : state.pieces)
        if (id != block)
          made += static_cast<double>(state.bodies.mass_kg(id) * 9.81F *
                                      state.bodies.state(id).pose.position_m.y);
      EXPECT_LE(energy_j(state) - made, before * 1.001) << speed_m_s;
      if (!broke) continue;
      EXPECT_GT(energy_j(state) - made, stopped) << "it got nothing back";
      EXPECT_GT(borne.at(block), 0.0F);
      EXPECT_LT(borne.at(block), 1.0F);
      for (const BodyState& body : state.bodies.states())
        EXPECT_LE(glm::length(body.velocity_m_s), 1.05F * speed_m_s);
    }
    EXPECT_TRUE(broke) << speed_m_s;
  }
}

TEST(Blows, the_force_grows_with_energy_and_hardness_alone) {
  EXPECT_FLOAT_EQ(force_of_blow(8.0F * 1000.0F, 5e7F), 4.0F * force_of_blow(1000.0F, 5e7F));
  EXPECT_FLOAT_EQ(force_of_blow(1000.0F, 8.0F * 5e7F), 2.0F * force_of_blow(1000.0F, 5e7F));
  // Hardness times the area of the cap: E = H · 1.325 r³, F = H · 15/16 π r².
  const double radius_m = std::cbrt(1e6 / 5e7 / 1.325);
  EXPECT_NEAR(static_cast<double>(force_of_blow(1e6F, 5e7F)),
              5e7 * 15.0 / 16.0 * 3.14159 * radius_m * radius_m, 1e-2 * 5e7 * radius_m * radius_m);
}

TEST(Blows, the_hardest_on_the_hardest_have_a_force) {
  const float newtons = force_of_blow(1e14F, 1e11F);
  EXPECT_GT(newtons, force_of_blow(1e13F, 1e11F));
  EXPECT_TRUE(std::isfinite(newtons));
}

TEST(StruckPlaces, add_up_by_place_and_are_forgotten_where_terrain_changes) {
  StruckPlaces places;
  EXPECT_EQ(places.add({1, 2, 3}, 5.0F, 1), 5.0F);
  EXPECT_EQ(places.add({2, 3, 0}, 7.0F, 2), 12.0F) << "the same cell";
  EXPECT_EQ(places.add({4, 2, 3}, 1.0F, 3), 1.0F) << "the next one";
  EXPECT_EQ(places.add({9, 2, 3}, 1.0F, 3), 1.0F);
  places.forget(std::vector<BrickCoord>{{0, 0, 0}});
  EXPECT_EQ(places.value().size(), 1U);
  EXPECT_EQ(places.add({1, 2, 3}, 5.0F, 4), 5.0F);
}

TEST(StruckPlaces, the_one_that_was_struck_least_lately_is_forgotten) {
  StruckPlaces places;
  for (int i = 0; i < static_cast<int>(limits::struck_places_max); ++i)
    places.add({4 * i, 0, 0}, 1.0F, static_cast<Tick>(i));
  places.add({0, 0, 0}, 1.0F, 1000);
  places.add({0, 100, 0}, 1.0F, 1001);
  EXPECT_EQ(places.value().size(), limits::struck_places_max);
  EXPECT_EQ(places.add({0, 0, 0}, 0.0F, 1002), 2.0F);
  EXPECT_EQ(places.add({4, 0, 0}, 0.0F, 1003), 0.0F) << "this one was";
}

TEST(StruckPlaces, are_part_of_a_worlds_value) {
  World world(rock_world());
  WorldSnapshot value = world.snapshot();
  value.moment.struck = {{{-3, 0, 2}, 12.5F, 0}, {{4, 0, 0}, 3.0F, 0}};
  const auto restored = World::restore(value);
  ASSERT_TRUE(restored.has_value()) << restored.error().message;
  EXPECT_EQ((*restored)->snapshot().moment.struck, value.moment.struck);
  std::ranges::reverse(value.moment.struck);
  EXPECT_FALSE(World::restore(value).has_value());
}

/// A small block of soil that drops on soil again and again, at the same place.
TEST(Blows, weak_blows_at_one_place_become_a_dent_at_last) {
  World::State state(flat_world(), 1);
  TickDelta delta;
  state.config.methods.impacts = false;
  apply(FillOperation{box({0.0F, 12.0F, 0.0F}, glm::vec3(0.375F))}, state.field, state.pieces);
  const Applied cut = state.apply_and_record(
      CarveOperation{box({0.0F, 12.0F, 0.0F}, glm::vec3(1.0F)), SeedPattern::uniform, 1, 1, {}, 1}, 0, delta);
  ASSERT_EQ(cut.created.size(), 1U);
  const PieceId block = cut.created.front().id;
  const auto drop = [&](PieceId, const Volume&) {
    Newborn piece;
    piece.body.pose.position_m = {0.0F, 0.6F, 0.0F};
    piece.body.velocity_m_s = {0.0F, -7.0F, 0.0F};
    return piece;
  };
  spawn(state, cut, drop, delta);
  state.enter_removed(cut);
  int drops = 1;
  for (; drops < 40 && state.pieces.size() == 1; ++drops) {
    for (int i = 0; i < 20 && state.pieces.size() == 1; ++i) {
      ++state.tick;
      state.bodies.step();
      apply_impacts(state, delta);
    }
    if (state.pieces.size() > 1) break;
    state.bodies.remove(block);
    state.traits.erase(block);
    state.shares.remove(0);
    Applied again;
    again.created = {{block, {}}};
    state.next_piece = block;
    spawn(state, again, drop, delta);
  }
  EXPECT_GT(drops, 1) << "one blow is to be too weak";
  EXPECT_GT(state.pieces.size(), 1U) << "there never was a dent";
}

TEST(Blows, two_worlds_agree_at_every_tick) {
  const BlowScene scene = scene_of("pillar");
  const BlowOutcome one = strike(scene, 20.0F, rules::newest), other = strike(scene, 20.0F, rules::newest);
  EXPECT_EQ(one.voxels, other.voxels);
  EXPECT_EQ(one.energy_left_j, other.energy_left_j);
}

}  // namespace
}  // namespace scree
