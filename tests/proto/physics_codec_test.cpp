// Cursors and physics on the wire: kept, bounded, and refused by name when they are out of range.
#include <gtest/gtest.h>
#include <limits>

#include "proto/codec.h"
#include "proto/limits.h"
#include "tests/support/holds.h"
#include "tests/support/wire_refusals.h"
#include "tests/support/wire_samples.h"

namespace scree {
namespace {

template <typename Message>
Message round_trip(const Message& sent) {
  const std::vector<uint8_t> bytes = encode(ServerMessage{sent});
  const Result<ServerMessage> got = decode_server(samples::body_of(bytes));
  EXPECT_TRUE(got) << got.error().message;
  return got ? std::get<Message>(*got) : Message{};
}

/// A ServerMessage's body that holds Physics with one packed field.
std::string refusal_of_physics(uint8_t field, const std::vector<uint8_t>& packed) {
  const auto wrapped = [](uint8_t number, const std::vector<uint8_t>& content) {
    std::vector<uint8_t> bytes{static_cast<uint8_t>(number << 3U | 2U)};
    for (size_t length = content.size(); true; length >>= 7U) {
      bytes.push_back(static_cast<uint8_t>((length & 0x7FU) | (length > 0x7FU ? 0x80U : 0U)));
      if (length <= 0x7FU) break;
    }
    bytes.insert(bytes.end(), content.begin(), content.end());
    return bytes;
  };
  const Result<ServerMessage> got = decode_server(wrapped(10, wrapped(field, packed)));
  return got ? "" : got.error().message;
}

TEST(WatchCodec, physics_arrives_as_sent_to_the_step) {
  const PhysicsMessage sent = samples::physics();
  const PhysicsMessage got = round_trip(sent);
  EXPECT_EQ(got.tick, sent.tick);
  ASSERT_EQ(got.bodies.size(), sent.bodies.size());
  for (size_t i = 0; i < got.bodies.size(); ++i) {
    EXPECT_EQ(got.bodies[i].id, sent.bodies[i].id);
    EXPECT_EQ(got.bodies[i].awake, sent.bodies[i].awake);
    EXPECT_EQ(got.bodies[i].island, sent.bodies[i].island);
    EXPECT_EQ(got.bodies[i].hull_m, sent.bodies[i].hull_m) << "multiples of 1/256 m";
  }
  ASSERT_EQ(got.contacts.size(), 1U);
  EXPECT_EQ(got.contacts[0].point_m, sent.contacts[0].point_m);
  EXPECT_EQ(got.contacts[0].normal, sent.contacts[0].normal);
  EXPECT_EQ(got.contacts[0].impulse_n_s, sent.contacts[0].impulse_n_s);
  EXPECT_EQ(got.searched, sent.searched);
}

TEST(WatchCodec, cursors_arrive_as_sent) {
  const CursorsMessage sent{{{7, "Ann", {1.0F, 2.0F, 3.0F}, {4.0F, 5.0F, 6.0F}}}};
  EXPECT_EQ(round_trip(sent).cursors, sent.cursors);
}

TEST(WatchCodec, what_is_over_the_limits_is_left_out_by_the_sender) {
  PhysicsMessage physics;
  for (PieceId id = 1; id <= limits::physics_bodies_max + 5; ++id)
    physics.bodies.push_back({id, true, false, {}});
  physics.bodies[0].hull_m.resize(limits::hull_corners_max + 3);
  physics.contacts.resize(limits::physics_contacts_max + 7);
  physics.searched.resize(limits::physics_bricks_max + 9);
  const PhysicsMessage got = round_trip(physics);
  EXPECT_EQ(got.bodies.size(), limits::physics_bodies_max);
  EXPECT_EQ(got.bodies[0].hull_m.size(), limits::hull_corners_max);
  EXPECT_EQ(got.contacts.size(), limits::physics_contacts_max);
  EXPECT_EQ(got.searched.size(), limits::physics_bricks_max);
  CursorsMessage cursors;
  cursors.cursors.resize(limits::cursors_max + 1);
  cursors.cursors[0].name = std::string(100, 'x');
  const CursorsMessage seen = round_trip(cursors);
  EXPECT_EQ(seen.cursors.size(), limits::cursors_max);
  EXPECT_EQ(seen.cursors[0].name.size(), limits::person_name_bytes_max);
}

TEST(WatchCodec, what_is_over_the_limits_is_refused_by_the_receiver) {
  std::vector<uint8_t> bodies;
  for (size_t i = 0; i <= limits::physics_bodies_max; ++i) bodies.insert(bodies.end(), {1, 0, 0});
  EXPECT_TRUE(holds(refusal_of_physics(2, bodies), "watched bodies: too many"));
  EXPECT_TRUE(holds(refusal_of_physics(2, {5, 0, 0, 0, 0, 0}), "do not ascend"));
  EXPECT_TRUE(holds(refusal_of_physics(2, {5, 4, 0}), "state"));
  EXPECT_TRUE(holds(refusal_of_physics(2, {5, 1, 65}), "corners"));
  EXPECT_FALSE(refusal_of_physics(2, {5, 1, 2, 0, 0, 0}).empty()) << "ends within a corner";
  std::vector<uint8_t> bricks((limits::physics_bricks_max + 1) * 3, 2);
  EXPECT_TRUE(holds(refusal_of_physics(4, bricks), "searched bricks: too many"));
  EXPECT_TRUE(holds(refusal_of_physics(3, {0, 0, 0, 0xFF, 0x7F, 0, 0, 0, 0, 0, 0}), "normal"));
}

TEST(WatchCodec, numbers_that_are_none_are_refused_by_name) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  PhysicsMessage physics;
  physics.contacts = {{{}, {}, -1.0F}};
  EXPECT_TRUE(holds(server_refusal(physics), "impulse is negative"));
  physics.contacts = {{{}, {}, nan}};
  EXPECT_TRUE(holds(server_refusal(physics), "impulse"));
  EXPECT_TRUE(holds(server_refusal(CursorsMessage{{{1, "", {nan, 0, 0}, {}}}}), "eye"));
  const std::vector<uint8_t> bytes = encode(ClientMessage{CursorMessage{{}, {0, nan, 0}}});
  const Result<ClientMessage> got = decode_client(samples::body_of(bytes));
  ASSERT_FALSE(got);
  EXPECT_TRUE(holds(got.error().message, "aim")) << got.error().message;
}

}  // namespace
}  // namespace scree
