// Values that are odd but sound, and moments between a request and its turn: worlds with them are saved, and
// go on.
#include <cmath>
#include <gtest/gtest.h>

#include "server/formats/world_codec.h"
#include "server/world/world_snapshot.h"
#include "shared/base/random.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

void expect_goes_on(World& world) {
  const std::vector<uint8_t> bytes = encode(world.snapshot());
  const auto value = decode_world(bytes);
  ASSERT_TRUE(value.has_value()) << value.error().message;
  auto restored = World::restore(*value);
  ASSERT_TRUE(restored.has_value()) << restored.error().message;
  EXPECT_EQ(encode((*restored)->snapshot()), bytes);
  world.renew();
  EXPECT_EQ((*restored)->step({})->state_hash, world.step({})->state_hash);
}

TEST(OddValues, negative_zeros_and_lengths_that_a_hull_has_not_are_saved_as_they_count) {
  PropWorld world(rock_world());
  Prop hull = prop_of({.kind = PropPartKind::hull,
                       .place_m = glm::vec3(-0.0F),
                       .turn = {1.0F, -0.0F, -0.0F, -0.0F},
                       .half_m = glm::vec3(0.3F),
                       .corners_m = {{-0.0F, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
                      100.0F);
  hull.gravity = -0.0F;
  const PieceId body = world.add(hull, {0.0F, 5.0F, 0.0F});
  Joint rope;
  rope.kind = JointKind::rope;
  rope.a = {body, glm::vec3(-0.0F), {1.0F, -0.0F, -0.0F, -0.0F}};
  rope.b = {0, {-0.0F, -2.0F, -0.0F}, {1.0F, -0.0F, 0.0F, -0.0F}};
  rope.length_m = 20.0F;
  EXPECT_EQ(world.ask(AddJointRequest{rope}).refusal, "");
  expect_goes_on(world.world());
}

TEST(OddValues, what_is_no_number_is_refused_wherever_it_stands) {
  PropWorld world(rock_world());
  const float nan = std::nanf("");
  for (int axis = 0; axis < 3; ++axis) {
    AddPropRequest add{crate(), {0.0F, 5.0F, 0.0F}};
    add.place_m[axis] = nan;
    EXPECT_NE(world.ask(add).refusal, "") << axis;
    BlastRequest blast{{0.0F, 5.0F, 0.0F}};
    blast.centre_m[axis] = nan;
    EXPECT_NE(world.ask(blast).refusal, "") << axis;
    for (const PropPartKind kind : all_kinds<PropPartKind>) {
      AddPropRequest odd{prop_of({.kind = kind}, 10.0F), {0.0F, 5.0F, 0.0F}};
      if (kind == PropPartKind::hull)
        odd.prop.parts[0].corners_m = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
      odd.prop.parts[0].half_m[axis] = nan;
      EXPECT_NE(world.ask(odd).refusal, "") << name_of(kind) << ' ' << axis;
    }
  }
  const PieceId body = world.add(crate(), {0.0F, 5.0F, 0.0F});
  EXPECT_NE(world.ask(MovePropRequest{body, glm::vec3(0.0F, 0.0F, nan)}).refusal, "");
  EXPECT_NE(world.ask(MovePropRequest{body, glm::vec3(nan, 0.0F, 0.0F)}).refusal, "");
  expect_goes_on(world.world());
}

TEST(OddValues, rubble_poured_within_rock_takes_mass_away_and_the_ledger_says_it) {
  WorldConfig config = flat_world();
  config.terrain.rows = config.palette->ground;
  bool takes = false;
  for (size_t row = 0; row < config.palette->rows.size(); ++row) {
    if (!config.palette->rows[row].rubble) continue;
    PropWorld world(config);
    const FillRequest fill{sphere({-36.63F, -3.0F, 0.21F}, 3.1F), static_cast<Material>(row)};
    EXPECT_EQ(world.ask(fill).refusal, "") << row;
    takes = takes || world.last().ledger.poured < 0;
    expect_goes_on(world.world());
  }
  EXPECT_TRUE(takes);
}

TEST(OddValues, hulls_of_every_size_are_refused_or_live) {
  PropWorld world(rock_world());
  Random random(5);
  int lives = 0, refused = 0;
  for (int round = 0; round < 300; ++round) {
    PropPart part{.kind = PropPartKind::hull};
    // From a grain to a house, thin along any axis, near the origin or far from it.
    const auto size = [&] { return std::pow(10.0F, -5.0F + 6.0F * random.unit()); };
    const float x = size(), y = size(), z = size();
    const glm::vec3 at = 8.0F * glm::vec3(random.below(2), random.below(2), random.below(2));
    for (uint32_t i = 0; i < 4 + random.below(60); ++i)
      part.corners_m.push_back(at +
                               glm::vec3(x, y, z) * glm::vec3(random.unit(), random.unit(), random.unit()));
    const Reply reply = world.ask(AddPropRequest{prop_of(part, 10.0F), {0.0F, 40.0F, 0.0F}});
    ++(reply.prop ? lives : refused);
    if (!reply.prop) continue;
    world.step();
    world.ask(RemovePropRequest{*reply.prop});
  }
  EXPECT_GT(lives, 30);
  EXPECT_GT(refused, 50);
}

TEST(OddValues, a_request_whose_body_is_gone_waits_in_a_saved_world) {
  PropWorld world(rock_world());
  const PieceId body = world.add(crate(), {0.0F, 30.0F, 0.0F});
  std::vector<Command> commands;
  for (uint32_t i = 0; i < 12; ++i)
    commands.push_back({1, i + 1, BlastRequest{{8.0F * static_cast<float>(i), -3.0F, 0.0F}, 2e9F, i}});
  commands.push_back({1, 20, PushRequest{body, {0.0F, 100.0F, 0.0F}, {0.0F, 30.0F, 0.0F}}});
  world.step(commands);
  world.step({{2, 1, RemovePropRequest{body}}});
  for (int i = 0; i < 20 && world.has(body); ++i) world.step();
  ASSERT_FALSE(world.has(body));
  ASSERT_FALSE(world.world().moment().requests.parties.empty()) << "the push still waits";
  expect_goes_on(world.world());
}

}  // namespace
}  // namespace scree
