// Persons on foot in saves, recordings and hashes.
#include <gtest/gtest.h>

#include "server/formats/recording_codec.h"
#include "server/formats/world_codec.h"
#include "server/world/world_snapshot.h"
#include "tests/support/person_world.h"

namespace scree {
namespace {

constexpr WalkInput sideways{.go = {0.6F, 0.0F, -0.8F}, .fast = true};

WorldSnapshot read_back(const WorldSnapshot& value) {
  auto back = decode_world(encode(value));
  EXPECT_TRUE(back.has_value()) << (back ? "" : back.error().message);
  return back ? *back : WorldSnapshot();
}

TEST(PersonValues, go_on_from_a_save_as_they_were) {
  PersonWorld world;
  world.stand(1, {0.0F, 0.1F, 0.0F});
  world.stand(2, {2.0F, 0.1F, 0.0F});
  world.walk(1, sideways, 40);
  std::vector<Command> commands;
  for (uint32_t i = 1; i <= 9; ++i) commands.push_back({2, i, WalkRequest{sideways}});
  world.step(commands);
  const WorldSnapshot saved = world.world().snapshot();
  ASSERT_EQ(saved.moment.persons.size(), 2U);
  const WorldSnapshot read = read_back(saved);
  EXPECT_EQ(read.moment.persons, saved.moment.persons);
  auto first = World::restore(read);
  ASSERT_TRUE(first.has_value()) << first.error().message;
  auto second = World::restore(saved, 2);
  ASSERT_TRUE(second.has_value());
  uint32_t number = world.number();
  for (int tick = 0; tick < 60; ++tick) {
    const std::vector<Command> asked{{1, ++number, WalkRequest{sideways}}};
    const auto a = (*first)->step(asked), b = (*second)->step(asked);
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << tick;
    ASSERT_EQ(a->persons, b->persons);
  }
}

TEST(PersonValues, are_in_the_hash) {
  PersonWorld one, other;
  for (PersonWorld* world : {&one, &other}) world->stand(1, {0.0F, 0.1F, 0.0F});
  EXPECT_EQ(one.last().state_hash, other.last().state_hash);
  one.step({{1, 1, WalkRequest{sideways}}});
  other.step({{1, 2, WalkRequest{sideways}}});
  EXPECT_NE(one.last().state_hash, other.last().state_hash) << "another input was taken";
}

TEST(PersonValues, of_no_person_are_refused) {
  PersonWorld world;
  world.stand(1, {0.0F, 0.1F, 0.0F});
  const WorldSnapshot good = world.world().snapshot();
  const auto refused = [&](auto change) {
    WorldSnapshot bad = good;
    change(bad.moment.persons[0]);
    return !World::restore(bad).has_value();
  };
  EXPECT_FALSE(refused([](PersonRecord&) {}));
  EXPECT_TRUE(refused([](PersonRecord& person) { person.body = 99; }));
  EXPECT_TRUE(refused([](PersonRecord& person) { person.walker.feet_m.y = 1e9F; }));
  EXPECT_TRUE(refused([](PersonRecord& person) { person.inputs.resize(1000); }));
  EXPECT_TRUE(refused([](PersonRecord& person) { person.credit = 1U << 31U; }));
}

TEST(PersonValues, of_commands_come_back_from_a_recording) {
  std::vector<Command> commands{{1, 1, StandRequest{glm::vec3(1.0F, 2.0F, 3.0F)}},
                                {1, 2U + (1U << 31U), WalkRequest{sideways, {0.0F, 1.0F, 0.0F}}},
                                {2, 3, PaintRequest{sphere({1.0F, 0.0F, 0.0F}, 1.0F)}, 5},
                                {2, 4, FillRequest{sphere({1.0F, 0.0F, 0.0F}, 1.0F)}}};
  commands[2].eye_m = glm::vec3(0.0F, -0.5F, 7.0F);
  const auto back = decode_recorded_commands(encode(commands));
  ASSERT_TRUE(back.has_value()) << back.error().message;
  EXPECT_EQ(*back, commands);
}

}  // namespace
}  // namespace scree
