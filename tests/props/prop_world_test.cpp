// Props as part of a world: requests and their refusals, snapshots, threads, the published state.
#include "tests/support/prop_world.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "bench/support/scenes.h"
#include "server/formats/world_codec.h"
#include "server/world/limits.h"
#include "server/world/published_state.h"
#include "server/world/world_snapshot.h"
#include "shared/prop/limits.h"
#include "tests/support/flat_world.h"

namespace scree {
namespace {

std::string refusal_of(PropWorld& world, const Request& request) {
  return refusal_name(world.ask(request));
}

TEST(PropWorld, requests_are_refused_by_name) {
  PropWorld world(flat_world());
  const auto add = [&](Prop prop) {
    return refusal_of(world, AddPropRequest{std::move(prop), {0.0F, 3.0F, 0.0F}});
  };
  Prop none;
  EXPECT_EQ(add(none), "prop_invalid");
  Prop heavy = crate();
  heavy.mass_kg = 1e30F;
  EXPECT_EQ(add(heavy), "prop_invalid");
  Prop flat =
      prop_of({.kind = PropPartKind::hull, .corners_m = {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}, {1, 0, 1}}}, 1.0F);
  EXPECT_EQ(add(flat), "prop_invalid");
  Prop many = crate();
  many.parts.resize(limits::prop_parts_max + 1, many.parts.front());
  EXPECT_EQ(add(many), "prop_invalid");
  Prop wordy = crate();
  wordy.data.resize(limits::prop_data_bytes_max + 1);
  EXPECT_EQ(add(wordy), "prop_invalid");
  Prop rock = crate();
  rock.groups = group::pieces;
  EXPECT_EQ(add(rock), "prop_invalid");
  Prop strange = crate();
  strange.material = static_cast<Material>(250);
  EXPECT_EQ(add(strange), "prop_invalid");
  Prop turned = crate();
  turned.parts.front().turn = {0.5F, 0.0F, 0.0F, 0.0F};
  EXPECT_EQ(add(turned), "prop_invalid");
  EXPECT_EQ(refusal_of(world, AddPropRequest{crate(), {1e6F, 0.0F, 0.0F}}), "prop_invalid");
  EXPECT_EQ(refusal_of(world, AddPropRequest{crate(), {0.0F, 3.0F, 0.0F}, {1, 0, 0, 0}, {1e4F, 0, 0}}),
            "prop_invalid");
  EXPECT_EQ(refusal_of(world, RemovePropRequest{77}), "body_missing");
  EXPECT_EQ(refusal_of(world, MovePropRequest{77}), "body_missing");
  EXPECT_EQ(refusal_of(world, PushRequest{77, {1, 0, 0}, {}}), "body_missing");
  EXPECT_EQ(refusal_of(world, BreakRequest{77, {}, 4, 1}), "body_missing");
  const PieceId id = world.add(crate(), {0.0F, 0.5F, 0.0F});
  EXPECT_EQ(refusal_of(world, PushRequest{id, {1, 0, 0}, {50, 0, 0}}), "push_invalid");
  EXPECT_EQ(refusal_of(world, PushRequest{id, {1e20F, 0, 0}, {0, 0.5F, 0}}), "push_invalid");
  EXPECT_EQ(refusal_of(world, BreakRequest{id, {}, 4, 1}), "body_missing") << "a prop is no piece";
  EXPECT_EQ(refusal_of(world, RemovePropRequest{id}), "");
  EXPECT_FALSE(world.has(id));
  EXPECT_EQ(refusal_of(world, RemovePropRequest{id}), "body_missing");
}

TEST(PropWorld, there_are_no_more_props_than_the_setting_says) {
  WorldConfig config = flat_world();
  config.props_max = 3;
  PropWorld world(config);
  for (int i = 0; i < 3; ++i) world.add(crate(), {2.0F * static_cast<float>(i), 0.5F, 0.0F});
  EXPECT_EQ(refusal_of(world, AddPropRequest{crate(), {0.0F, 9.0F, 0.0F}}), "props_max");
}

TEST(PropWorld, a_prop_without_a_mass_weighs_by_its_material) {
  PropWorld world(flat_world());
  world.add(crate(0.5F, 0.0F), {0.0F, 2.0F, 0.0F});
  ASSERT_EQ(world.last().props_spawned.size(), 1U);
  EXPECT_NEAR(world.last().props_spawned.front().prop->mass_kg, builtin_palette().rows.front().density_kg_m3,
              1.0F);
}

TEST(PropWorld, a_piece_breaks_on_request_and_flies_on) {
  PropWorld world(rock_world());
  CarveRequest carve = blow_at(world.world().config().terrain, 0.0F, 0.0F, 2.0F, 4, 5);
  carve.blast_speed_m_s = 25.0F;
  world.ask(carve);
  world.steps(10);
  ASSERT_FALSE(world.last().pieces.empty());
  const PieceState piece = world.last().pieces.front();
  const Reply reply = world.ask(BreakRequest{piece.id, dequantise(piece.pose).position_m, 6, 9});
  EXPECT_EQ(reply.refusal, "");
  EXPECT_GE(reply.pieces, 2U);
  EXPECT_TRUE(
      std::ranges::none_of(world.last().pieces, [&](const PieceState& one) { return one.id == piece.id; }));
}

/// Crates, balls and broken rock in one heap.
void fill_scene(PropWorld& world) {
  CarveRequest carve = blow_at(world.world().config().terrain, 0.0F, 0.0F, 2.0F, 24, 5);
  world.ask(carve);
  for (int i = 0; i < 12; ++i) {
    const glm::vec3 at_m{0.7F * static_cast<float>(i % 3) - 0.7F, 3.0F + 0.8F * static_cast<float>(i / 3),
                         0.1F};
    world.add(i % 2 == 0 ? crate(0.3F, 60.0F) : ball(0.3F, 40.0F), at_m);
  }
  Prop table = crate();
  table.parts = {{.kind = PropPartKind::box, .place_m = {0, 0.5F, 0}, .half_m = {0.8F, 0.1F, 0.8F}}};
  for (const float x : {-0.6F, 0.6F})
    for (const float z : {-0.6F, 0.6F})
      table.parts.push_back(
          {.kind = PropPartKind::cylinder, .place_m = {x, 0, z}, .half_m = {0.1F, 0.5F, 0}});
  world.add(table, {3.0F, 1.0F, 0.0F});
}

TEST(PropWorld, goes_the_same_way_by_any_number_of_threads) {
  std::vector<std::vector<uint64_t>> hashes;
  for (const size_t threads : {1, 2, 4}) {
    PropWorld world(rock_world(), threads);
    fill_scene(world);
    std::vector<uint64_t>& of_ticks = hashes.emplace_back();
    for (int i = 0; i < 180; ++i) of_ticks.push_back(world.step().state_hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_EQ(hashes[0], hashes[2]);
}

TEST(PropWorld, a_snapshot_is_the_world_and_goes_on_the_same_way_each_time) {
  PropWorld world(rock_world());
  fill_scene(world);
  world.steps(60);
  const std::vector<uint8_t> bytes = encode(world.world().snapshot());
  std::vector<uint64_t> ends;
  for (int i = 0; i < 2; ++i) {
    const auto value = decode_world(bytes);
    ASSERT_TRUE(value) << value.error().message;
    auto restored = World::restore(*value);
    ASSERT_TRUE(restored) << restored.error().message;
    EXPECT_EQ(encode((*restored)->snapshot()), bytes);
    std::shared_ptr<const TickDelta> delta;
    for (int tick = 0; tick < 120; ++tick) delta = (*restored)->step({});
    ends.push_back(delta->state_hash);
    EXPECT_EQ(delta->props.size(), world.last().props.size());
  }
  EXPECT_EQ(ends[0], ends[1]);
}

TEST(PropWorld, the_state_hash_tells_props_apart) {
  std::vector<uint64_t> hashes;
  for (const uint64_t tag : {1, 1, 2}) {
    PropWorld world(flat_world());
    Prop prop = crate();
    prop.tag = tag;
    world.add(prop, {0.0F, 2.0F, 0.0F});
    hashes.push_back(world.last().state_hash);
  }
  EXPECT_EQ(hashes[0], hashes[1]);
  EXPECT_NE(hashes[0], hashes[2]);
}

TEST(PropWorld, the_published_state_follows) {
  PropWorld world(flat_world());
  PublishedState state;
  const auto follow = [&] { state.apply(world.last()); };
  const PieceId a = world.add(crate(), {0.0F, 2.0F, 0.0F});
  follow();
  const PieceId b = world.add(ball(0.3F, 10.0F), {3.0F, 2.0F, 0.0F});
  follow();
  EXPECT_EQ(state.props().size(), 2U);
  EXPECT_EQ(state.props().at(b).prop->parts.front().kind, PropPartKind::sphere);
  world.step({{0, 1, RemovePropRequest{a}}});
  follow();
  EXPECT_FALSE(state.props().contains(a));
  PublishedState again;
  again.apply(state.as_delta());
  EXPECT_EQ(again.props().size(), 1U);
}

TEST(PropWorld, what_leaves_the_world_is_gone) {
  PropWorld world(flat_world());
  Prop bullet = ball(0.1F, 1.0F);
  bullet.gravity = 0.0F;
  const PieceId id =
      world.add(bullet, {limits::world_half_width_m - 5.0F, 50.0F, 0.0F}, {500.0F, 0.0F, 0.0F});
  world.steps(10);
  EXPECT_FALSE(world.has(id));
}

}  // namespace
}  // namespace scree
