// What props cost, and what becomes of those that are put into rock or into a crowd.
#include <cmath>
#include <glm/geometric.hpp>

#include "server/work/limits.h"
#include "shared/base/random.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

/// Hulls with corners all over a ball.
Prop of_many_corners() {
  Random random(3);
  Prop prop;
  for (int i = 0; i < 16; ++i) {
    PropPart part{.kind = PropPartKind::hull};
    for (int k = 0; k < 64; ++k) {
      const auto unit = [&] { return 2.0F * random.unit() - 1.0F; };
      const glm::vec3 p(unit(), unit(), unit());
      part.corners_m.push_back(p / std::sqrt(glm::dot(p, p)));
    }
    prop.parts.push_back(std::move(part));
  }
  prop.mass_kg = 100.0F;
  return prop;
}

TEST(PropLimits, props_of_many_corners_are_added_one_a_tick) {
  PropWorld world(flat_world());
  world.step();
  std::vector<Command> four;
  for (uint32_t i = 0; i < 4; ++i)
    four.push_back({0, i + 1, AddPropRequest{of_many_corners(), {6.0F * static_cast<float>(i), 4.0F, 0.0F}}});
  world.step(four);
  EXPECT_EQ(world.last().replies.size(), 1U);
  EXPECT_EQ(world.last().work.requests_waiting, 3U);
  size_t replies = 1;
  for (int i = 0; i < 30; ++i) {
    const size_t now = world.step().replies.size();
    EXPECT_LE(now, 1U);
    replies += now;
  }
  EXPECT_EQ(replies, 4U);
}

TEST(PropLimits, a_hull_without_volume_is_refused_by_name) {
  PropWorld world(flat_world());
  PropPart flat{.kind = PropPartKind::hull};
  flat.corners_m = {{0.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 0.0F}, {1.0F, 0.0F, 1.0F}, {0.0F, 0.0F, 1.0F}};
  const Reply reply = world.ask(AddPropRequest{prop_of(flat, 10.0F), {0.0F, 2.0F, 0.0F}});
  EXPECT_EQ(reply.reason, Refusal::prop_invalid);
  EXPECT_NE(reply.refusal, "");
  EXPECT_TRUE(world.last().props.empty());
}

TEST(PropLimits, hundreds_in_one_place_take_several_ticks) {
  PropWorld world(flat_world());
  world.step();
  std::vector<Command> many;
  for (uint32_t i = 0; i < 200; ++i)
    many.push_back({0, i + 1, AddPropRequest{crate(), {0.0F, 1.0F, 0.01F * static_cast<float>(i)}}});
  world.step(many);
  EXPECT_GT(world.last().props.size(), 10U);
  EXPECT_LT(world.last().props.size(), 80U);
}

TEST(PropLimits, a_crate_in_rock_comes_out_the_nearest_way) {
  PropWorld world(rock_world());
  const PieceId id = world.add(crate(), {0.3F, -0.7F, 0.2F});
  for (const Event& event : world.last().told) EXPECT_EQ(event.text, "");
  float before_m = world.place_m(id).y;
  for (int i = 0; i < 240; ++i) {
    world.step();
    const float now_m = world.place_m(id).y;
    EXPECT_LT(now_m - before_m, 0.06F) << "at a bounded speed";
    before_m = now_m;
  }
  EXPECT_NEAR(world.place_m(id).y, 0.5F, 0.05F);
  EXPECT_LT(glm::distance(world.place_m(id), {0.3F, 0.5F, 0.2F}), 0.5F);
}

TEST(PropLimits, a_crate_that_is_moved_into_rock_comes_out_too) {
  PropWorld world(rock_world());
  const PieceId id = world.add(crate(), {0.0F, 0.5F, 0.0F});
  world.steps(200);
  world.ask(MovePropRequest{id, glm::vec3(1.0F, -0.6F, 0.0F)});
  world.steps(240);
  EXPECT_NEAR(world.place_m(id).y, 0.5F, 0.05F);
}

TEST(PropLimits, a_crate_deep_in_rock_stays_in_it_and_that_is_told) {
  PropWorld world(rock_world());
  const PieceId id = world.add(crate(), {0.0F, -9.0F, 0.0F});
  ASSERT_EQ(world.last().told.size(), 1U);
  EXPECT_NE(world.last().told.front().text, "");
  world.steps(240);
  EXPECT_LT(world.place_m(id).y, -3.0F);
}

TEST(PropLimits, what_is_kinematic_and_fast_pushes_a_crate) {
  for (const float speed : {30.0F, 100.0F, 300.0F, 590.0F}) {
    for (const float from_m : {-6.0F, -6.9F, -8.3F}) {
      PropWorld world(rock_world());
      const PieceId light = world.add(crate(0.5F, 50.0F), {0.0F, 0.52F, 0.0F});
      world.steps(30);
      Prop block = crate(0.5F);
      block.motion = PropMotion::kinematic;
      const PieceId told = world.add(block, {from_m, 0.75F, 0.0F}, {speed, 0.0F, 0.0F});
      bool is_told = false;
      for (int i = 0; i < 40; ++i)
        for (const ContactEvent& contact : world.step().contacts)
          is_told = is_told || contact.other == told || contact.body == told;
      EXPECT_TRUE(is_told) << speed << " m/s from " << from_m;
      EXPECT_GT(world.place_m(light).x, 2.0F) << speed << " m/s from " << from_m;
      EXPECT_NEAR(world.place_m(told).x, from_m + speed * 41.0F / 60.0F, 0.02F * speed) << "it goes as told";
    }
  }
}

TEST(PropLimits, a_blow_that_goes_on_is_told_once_with_all_its_energy) {
  PropWorld world(rock_world());
  const PieceId light = world.add(crate(0.5F, 200.0F), {0.0F, 0.5F, 0.0F});
  world.steps(60);
  const PieceId heavy = world.add(crate(1.0F, 20000.0F), {0.0F, 6.0F, 0.0F});
  size_t events = 0;
  for (int i = 0; i < 90; ++i)
    for (const ContactEvent& contact : world.step().contacts)
      events += contact.body == light && contact.other == heavy ? 1 : 0;
  EXPECT_EQ(events, 1U);
}

}  // namespace
}  // namespace scree
