// Who is shown whose cursor, and who is told what the bodies do: over loopback, tick by tick.
#include <algorithm>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "proto/limits.h"
#include "server/publish/interest_filter.h"
#include "server/world/world.h"
#include "tests/support/raw_client.h"
#include "tests/support/session_support.h"

namespace scree {
namespace {

constexpr float radius_m = 32.0F;

TEST(Watching, cursors_are_those_of_others_within_interest) {
  const std::map<uint64_t, PartyCursor> cursors{{1, {{1, "me", {}, {}}, 1}},
                                                {2, {{2, "near", {5, 0, 0}, {500, 0, 0}}, 2}},
                                                {3, {{3, "aims here", {500, 0, 0}, {0, 5, 0}}, 3}},
                                                {4, {{4, "far", {500, 0, 0}, {400, 0, 0}}, 4}}};
  const std::vector<PlayerCursor> seen = cursors_for(1, cursors, {}, radius_m);
  ASSERT_EQ(seen.size(), 2U);
  EXPECT_EQ(seen[0].name, "near");
  EXPECT_EQ(seen[1].name, "aims here");
}

TEST(Watching, crowds_are_cut_to_what_a_message_holds_and_hide_nobody_who_is_alone_or_near) {
  std::map<uint64_t, PartyCursor> cursors;
  for (uint64_t id = 1; id < 200; ++id) cursors[id] = {{id, "", {2, 0, 0}, {2, 0, 0}}, 1};
  cursors[300] = {{300, "alone", {30, 0, 0}, {30, 0, 0}}, 2};
  for (uint64_t id = 400; id < 600; ++id) cursors[id] = {{id, "", {20, 0, 0}, {20, 0, 0}}, id};
  cursors[700] = {{700, "near", {1, 0, 0}, {1, 0, 0}}, 700};
  const auto seen = cursors_for(7, cursors, {}, radius_m);
  EXPECT_EQ(seen.size(), limits::cursors_max);
  EXPECT_EQ(seen.back().name, "near");
  EXPECT_EQ(std::ranges::count(seen, "alone", &PlayerCursor::name), 0) << "others of their own are nearer";
  std::erase_if(cursors, [](const auto& one) { return one.first >= 400 && one.first < 700; });
  EXPECT_EQ(std::ranges::count(cursors_for(7, cursors, {}, radius_m), "alone", &PlayerCursor::name), 1);
}

TEST(Watching, physics_is_what_lies_within_interest) {
  PhysicsMessage physics;
  physics.contacts = {{{1, 0, 0}, {}, 1.0F}, {{100, 0, 0}, {}, 1.0F}};
  physics.bodies = {{5, true, false, {}}};  // a piece that was never published
  physics.searched = {{0, 0, 0}, {1000, 0, 0}};
  const PhysicsMessage part = physics_for(physics, PublishedState(), 0.25F, {}, radius_m);
  EXPECT_EQ(part.contacts.size(), 1U);
  EXPECT_TRUE(part.bodies.empty());
  EXPECT_EQ(part.searched.size(), 1U);
}

/// The messages of one kind that a client gets until a tick.
template <typename Message>
std::vector<Message> collect(RawClient& client, Tick tick) {
  std::vector<Message> found;
  while (const auto message = client.receive()) {
    if (const auto* one = std::get_if<Message>(&*message)) found.push_back(*one);
    const auto* frame = std::get_if<FrameMessage>(&*message);
    if (frame != nullptr && frame->tick >= tick) break;
  }
  return found;
}

CarveMessage blow() {
  CarveMessage carve;
  carve.request = 1;
  carve.shape = sphere({0.0F, -0.8F, 0.0F}, 2.0F);
  carve.seeds = 16;
  return carve;
}

LiveConfig config() {
  LiveConfig config;
  config.world.terrain.kind = TerrainKind::flat;
  return config;
}

TEST(Watching, a_cursor_is_passed_on_with_its_name_and_goes_with_its_person) {
  LoopbackSession session(config());
  RawClient ann(session.server().port());
  ASSERT_TRUE(ann.send(HelloMessage{protocol_version, "test", {}, radius_m, "Ann"}));
  ASSERT_TRUE(ann.receive_as<WelcomeMessage>());
  auto bob = std::make_unique<RawClient>(session.server().port());
  ASSERT_TRUE(bob->send(HelloMessage{protocol_version, "test", {}, radius_m, "Bob"}));
  ASSERT_TRUE(bob->receive_as<WelcomeMessage>());
  ASSERT_TRUE(bob->send(CursorMessage{{1, 2, 3}, {4, 5, 6}}));

  std::vector<CursorsMessage> seen;
  for (int i = 0; i < 2000 && seen.empty(); ++i) {
    ASSERT_TRUE(session.step());
    seen = collect<CursorsMessage>(ann, session.tick());
  }
  ASSERT_FALSE(seen.empty());
  ASSERT_EQ(seen[0].cursors.size(), 1U);
  EXPECT_EQ(seen[0].cursors[0].name, "Bob");
  EXPECT_EQ(seen[0].cursors[0].aim_m, glm::vec3(4, 5, 6));
  // Nothing is sent again while nothing changes.
  ASSERT_TRUE(session.steps(30));
  EXPECT_TRUE(collect<CursorsMessage>(ann, session.tick()).empty());
  bob.reset();
  seen.clear();
  for (int i = 0; i < 2000 && seen.empty(); ++i) {
    ASSERT_TRUE(session.step());
    seen = collect<CursorsMessage>(ann, session.tick());
  }
  ASSERT_FALSE(seen.empty());
  EXPECT_TRUE(seen[0].cursors.empty());
}

TEST(Watching, physics_comes_to_who_asks_and_to_nobody_else) {
  LoopbackSession session(config());
  RawClient subscriber(session.server().port());
  RawClient other(session.server().port());
  for (RawClient* client : {&subscriber, &other}) {
    ASSERT_TRUE(client->send(HelloMessage{protocol_version, "test", {}, radius_m}));
    ASSERT_TRUE(client->receive_as<WelcomeMessage>());
  }
  ASSERT_TRUE(subscriber.send(PhysicsSubscriptionMessage{true}));
  ASSERT_TRUE(subscriber.send(blow()));
  bool bodies = false;
  bool contacts = false;
  for (int i = 0; i < 2000 && !(bodies && contacts); ++i) {
    ASSERT_TRUE(session.step());
    EXPECT_TRUE(collect<PhysicsMessage>(other, session.tick()).empty());
    for (const PhysicsMessage& physics : collect<PhysicsMessage>(subscriber, session.tick())) {
      bodies = bodies || !physics.bodies.empty();
      contacts = contacts || !physics.contacts.empty();
      EXPECT_EQ(physics.tick % ticks_per_physics, 0U);
      for (const BodyView& body : physics.bodies) EXPECT_GE(body.hull_m.size(), 4U);
      for (const ContactView& contact : physics.contacts)
        EXPECT_NEAR(glm::length(contact.normal), 1.0F, 0.02F);
    }
  }
  EXPECT_TRUE(bodies);
  EXPECT_TRUE(contacts);
}

TEST(Watching, to_be_watched_changes_nothing) {
  WorldConfig world_config;
  world_config.terrain.kind = TerrainKind::flat;
  World subscribed(world_config);
  World unsubscribed(world_config);
  subscribed.want_physics(true);
  const Command command{1, 1, static_cast<const CarveRequest&>(blow())};
  bool described = false;
  for (int tick = 0; tick < 120; ++tick) {
    const auto commands = tick == 3 ? std::span(&command, 1) : std::span<const Command>();
    const auto a = subscribed.step(commands);
    const auto b = unsubscribed.step(commands);
    ASSERT_EQ(a->state_hash, b->state_hash) << "tick " << a->tick;
    described = described || (a->physics && !a->physics->bodies.empty());
    EXPECT_EQ(b->physics, nullptr);
  }
  EXPECT_TRUE(described);
}

}  // namespace
}  // namespace scree
