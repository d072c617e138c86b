// Digging and placing as a world does it: what is dug is in a store, to the unit, and comes out of it again.
#include "shared/operation/store.h"

#include <gtest/gtest.h>

#include "server/formats/world_codec.h"
#include "server/world/stores.h"
#include "server/world/world_snapshot.h"
#include "shared/field/mass.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_world.h"

namespace scree {
namespace {

constexpr double voxels_per_m3 = 64.0;

StoreName person(uint64_t session) {
  return store_of_person(0, session);
}

MaterialMasses held(const TickDelta& state, const StoreName& store) {
  for (const StoreContent& one : state.stores)
    if (one.store == store) return one.masses;
  return {};
}

double m3(MassUnits mass) {
  return static_cast<double>(mass) / units_per_voxel / voxels_per_m3;
}

class StoreWorld : public PropWorld {
 public:
  explicit StoreWorld(const WorldConfig& config = rock_world(), size_t threads = 1)
      : PropWorld(config, threads) {}

  Reply ask(const Request& request, uint64_t session = 1) {
    step({{session, 1, request}});
    EXPECT_EQ(last().replies.size(), 1U);
    expect_balance();
    return last().replies.empty() ? Reply() : last().replies.front();
  }
  std::string refusal(const Request& request, uint64_t session = 1) {
    return refusal_name(ask(request, session));
  }
  Reply dig(glm::vec3 at_m, float radius_m) { return ask(DigRequest{sphere(at_m, radius_m)}); }
  MaterialMasses has(const StoreName& store) { return held(world().outline(), store); }

  /// The sum of all stores is the ledger's, by material too.
  void expect_balance() {
    EXPECT_EQ(last().ledger.error(), 0);
    MaterialMasses sum;
    for (const StoreContent& one : world().outline().stores) scree::add(sum, one.masses);
    EXPECT_EQ(sum_of(sum), last().ledger.stored);
    for (size_t row = 0; row < last().materials.rows().size(); ++row)
      EXPECT_EQ(last().materials.rows()[row].stored, mass_of(sum, static_cast<Material>(row)));
  }
};

TEST(Stores, ten_clicks_at_one_spot_dig_three_metres_down) {
  StoreWorld world;
  MassUnits all = 0;
  for (int click = 0; click < 10; ++click) {
    const Reply reply = world.dig({0.0F, -0.3F * static_cast<float>(click), 0.0F}, 0.5F);
    EXPECT_EQ(reply.refusal, "");
    all += reply.mass.value_or(0);
    EXPECT_TRUE(world.last().spawned.empty());
  }
  world.steps(60);
  EXPECT_TRUE(world.last().pieces.empty());
  EXPECT_EQ(world.last().ledger.dust, 0);
  EXPECT_EQ(world.last().ledger.stored, all);
  EXPECT_EQ(world.last().ledger.terrain, -all);
  EXPECT_EQ(sum_of(world.has(person(1))), all);
  // Down to 3.2 m all is air.
  for (float y_m = -0.25F; y_m > -3.1F; y_m -= 0.25F)
    EXPECT_FALSE(*is_solid(world.world().scene(), {0.0F, y_m, 0.0F}).map([](auto a) { return a.answer; }))
        << y_m;
}

TEST(Stores, what_is_dug_at_a_cliff_is_carried_away_and_placed_as_rubble_to_the_unit) {
  StoreWorld world;
  world.ask(FillRequest{box({0.0F, 4.0F, 0.0F}, {6.0F, 4.0F, 3.0F}), material::rock}, 0);
  const MassUnits poured = world.last().ledger.poured;
  MassUnits dug = 0;
  for (int i = 0; i < 40; ++i) {
    world.steps(15);
    const float x_m = -5.0F + 0.25F * static_cast<float>(i);
    dug += world.dig({x_m, 1.0F + static_cast<float>(i % 4), 3.0F}, 1.0F).mass.value_or(0);
  }
  EXPECT_GT(m3(dug), 30.0);
  EXPECT_EQ(world.last().ledger.stored, dug);
  MassUnits placed = 0;
  for (int i = 0; i < 8; ++i) {
    const Reply reply =
        world.ask(PlaceRequest{box({50.0F, 0.5F, 4.0F * static_cast<float>(i)}, {1.0F, 0.5F, 1.0F})});
    EXPECT_EQ(reply.refusal, "");
    placed += reply.mass.value_or(0);
    world.steps(10);
  }
  EXPECT_EQ(world.last().ledger.stored, dug - placed);
  EXPECT_EQ(world.last().ledger.poured, poured);
  EXPECT_GT(m3(placed), 8.0 * 2.0 * 0.4) << "rubble fills a part of its voxels";
  EXPECT_LT(m3(placed), 8.0 * 4.0);
  EXPECT_EQ(sum_of(world.has(person(1))), dug - placed);
  EXPECT_EQ(world.world().measure_terrain(), world.last().ledger.terrain);
}

TEST(Stores, a_dig_that_leaves_terrain_hanging_lets_it_fall) {
  StoreWorld world;
  world.ask(FillRequest{box({0.0F, 3.0F, 0.0F}, {0.5F, 3.0F, 0.5F}), material::rock}, 0);
  world.ask(DigRequest{box({0.0F, 1.0F, 0.0F}, {1.0F, 0.5F, 1.0F})});
  bool fell = false;
  for (int tick = 0; tick < 120 && !fell; ++tick) {
    world.step();
    fell = !world.last().pieces.empty();
  }
  EXPECT_TRUE(fell);
}

TEST(Stores, a_loose_piece_goes_whole_and_what_lay_on_it_falls) {
  StoreWorld world;
  const PieceId lower = *world.ask(CutOutRequest{box({8.0F, -0.5F, 0.0F}, {0.5F, 0.5F, 0.5F})}, 0).prop;
  const PieceId crate_on_it = world.add(crate(0.4F), {8.0F, 0.9F, 0.0F});
  world.steps(300);
  const float before_m = world.place_m(crate_on_it).y;
  const DigRequest dig{sphere({8.0F, -0.5F, 0.0F}, 0.5F), lower};
  EXPECT_EQ(world.refusal(dig), "dig_invalid") << "it is kept";
  EXPECT_EQ(world.ask(ReleaseRequest{lower}, 0).refusal, "");
  EXPECT_EQ(world.refusal(DigRequest{sphere({80.0F, 0.0F, 0.0F}, 0.5F), lower}), "shape_misses");
  const MassUnits pieces = world.last().ledger.pieces;
  const Reply reply = world.ask(dig);
  EXPECT_EQ(reply.refusal, "");
  EXPECT_EQ(reply.mass.value_or(0), pieces);
  EXPECT_TRUE(world.last().pieces.empty());
  world.steps(120);
  EXPECT_LT(world.place_m(crate_on_it).y, before_m - 0.3F);
  EXPECT_EQ(world.refusal(dig), "body_missing");
}

TEST(Stores, a_place_that_the_store_cannot_pay_changes_nothing) {
  StoreWorld world;
  world.dig({0.0F, 0.0F, 0.0F}, 1.0F);
  const uint64_t field = world.last().field_hash;
  const Ledger ledger = world.last().ledger;
  const PlaceRequest large{box({20.0F, 3.0F, 0.0F}, {3.0F, 3.0F, 3.0F}), material::rock, true};
  const Reply reply = world.ask(large);
  EXPECT_EQ(refusal_name(reply), "store_lacks");
  EXPECT_NE(reply.refusal.find("m³"), std::string::npos) << reply.refusal;
  EXPECT_EQ(world.last().field_hash, field);
  EXPECT_EQ(world.last().ledger, ledger);
  EXPECT_EQ(world.refusal(PlaceRequest{sphere({20.0F, 1.0F, 0.0F}, 0.5F), material::ice}), "store_lacks");
  EXPECT_EQ(world.refusal(PlaceRequest{sphere({20.0F, 1.0F, 0.0F}, 0.5F)}, 2), "store_lacks")
      << "another's store is empty";
  const Reply solid = world.ask(PlaceRequest{sphere({20.0F, 0.5F, 0.0F}, 0.4F), material::rock, true});
  EXPECT_EQ(solid.refusal, "");
  EXPECT_EQ(world.last().ledger.stored, ledger.stored - solid.mass.value_or(0));
}

TEST(Stores, nothing_is_placed_into_a_prop) {
  StoreWorld world;
  world.dig({0.0F, -1.0F, 0.0F}, 1.5F);
  world.add(crate(0.5F), {20.0F, 0.5F, 0.0F});
  for (const Shape& shape : {sphere({20.0F, 1.2F, 0.0F}, 0.5F), box({20.8F, 0.5F, 0.0F}, {0.5F, 0.5F, 0.5F}),
                             capsule({20.0F, 0.5F, -2.0F}, {20.0F, 0.5F, 2.0F}, 0.3F)})
    EXPECT_EQ(world.refusal(PlaceRequest{shape}), "in_the_way");
  EXPECT_EQ(world.refusal(PlaceRequest{box({21.5F, 0.5F, 0.0F}, {0.5F, 0.5F, 0.5F})}), "");
}

TEST(Stores, a_persons_store_and_its_digging_are_bounded) {
  WorldConfig config = rock_world();
  config.store_m3 = 20;
  config.dig_m3_per_s = 10;
  StoreWorld world(config);
  EXPECT_EQ(world.refusal(DigRequest{sphere({0.0F, -3.0F, 0.0F}, 3.0F)}), "store_full") << "113 m³";
  EXPECT_EQ(world.last().ledger, Ledger());
  const auto dig = [&](float x_m) {
    return world.refusal(DigRequest{box({x_m, -1.0F, 0.0F}, {1.0F, 1.0F, 1.0F})});
  };
  EXPECT_EQ(dig(10.0F), "");
  EXPECT_EQ(dig(20.0F), "");
  EXPECT_EQ(dig(30.0F), "dig_rate");
  world.steps(120);
  EXPECT_EQ(dig(30.0F), "store_full");
  EXPECT_EQ(world.refusal(TransferRequest{person(1), worlds_store()}), "");
  EXPECT_EQ(dig(30.0F), "");
  config.store_m3 = 0;
  EXPECT_EQ(StoreWorld(config).refusal(DigRequest{sphere({0.0F, 0.0F, 0.0F}, 1.0F)}), "store_full");
}

TEST(Stores, mass_moves_between_stores_and_a_session_that_is_over_leaves_its_own_to_the_world) {
  StoreWorld world;
  const MassUnits dug = world.dig({0.0F, 0.0F, 0.0F}, 1.5F).mass.value_or(0);
  const Material rock = material::rock;
  EXPECT_EQ(world.refusal(TransferRequest{named_store("red"), worlds_store()}), "store_missing");
  EXPECT_EQ(world.refusal(TransferRequest{person(1), person(1)}), "transfer_invalid");
  EXPECT_EQ(world.refusal(TransferRequest{person(1), named_store("red"), rock, dug + 1}), "store_lacks");
  EXPECT_EQ(world.refusal(TransferRequest{person(1), named_store("red"), rock, 100}), "");
  EXPECT_EQ(sum_of(world.has(named_store("red"))), 100);
  EXPECT_EQ(sum_of(world.has(person(1))), dug - 100);
  EXPECT_EQ(world.refusal(TransferRequest{person(1), named_store("")}), "transfer_invalid");
  world.step({{1, 0, LeaveRequest{}}});
  EXPECT_EQ(sum_of(world.has(worlds_store())), dug - 100);
  EXPECT_TRUE(world.has(person(1)).empty());
  EXPECT_EQ(world.refusal(TransferRequest{named_store("red"), {StoreKind::token, 7}}), "");
  EXPECT_EQ(sum_of(world.has({StoreKind::token, 7})), 100);
}

TEST(Stores, there_are_only_so_many) {
  StoreWorld world;
  world.dig({0.0F, -1.0F, 0.0F}, 2.0F);
  std::vector<Command> commands;
  for (uint32_t i = 1; i <= limits::stores_max + 2; ++i)
    commands.push_back({0, i, TransferRequest{person(1), {StoreKind::token, i}, material::rock, 1}});
  size_t refused = 0;
  for (size_t at = 0; at < commands.size(); at += 64) {
    const auto first = commands.begin() + static_cast<std::ptrdiff_t>(at);
    const auto last = commands.begin() + static_cast<std::ptrdiff_t>(std::min(at + 64, commands.size()));
    world.step({first, last});
    for (const Reply& reply : world.last().replies) refused += refusal_name(reply) == "stores_max" ? 1 : 0;
  }
  for (int i = 0; i < 60; ++i) {
    world.step();
    for (const Reply& reply : world.last().replies) refused += refusal_name(reply) == "stores_max" ? 1 : 0;
  }
  EXPECT_GE(refused, 3U);
  EXPECT_LE(world.world().outline().stores.size(), limits::stores_max);
  world.expect_balance();
}

TEST(Stores, they_are_part_of_a_world_that_is_saved) {
  StoreWorld world;
  world.dig({0.0F, -1.0F, 0.0F}, 2.0F);
  world.ask(TransferRequest{person(1), named_store("red"), material::rock, 5000}, 0);
  const WorldSnapshot value = world.world().snapshot();
  const auto decoded = decode_world(encode(value));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(decoded->moment.stores, value.moment.stores);
  EXPECT_EQ(first_free_session(decoded->moment), 2U);
  const auto again = World::restore(*decoded);
  ASSERT_TRUE(again) << again.error().message;
  EXPECT_EQ((*again)->snapshot().moment.stores, value.moment.stores);
  const auto refused = [&](const auto& change, const char* why) {
    WorldSnapshot other = value;
    change(other.moment);
    const auto made = World::restore(other);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find(why), std::string::npos) << made.error().message;
  };
  refused([](WorldMoment& m) { m.stores.front().content.masses.front().mass += 1; }, "mass of its stores");
  refused([](WorldMoment& m) { m.stores.front().dug += 1; }, "its hash");
  refused([](WorldMoment& m) { std::swap(m.stores.front(), m.stores.back()); }, "not in order");
  refused([](WorldMoment& m) { m.stores.front().content.masses.front().mass = -1; }, "less than nothing");
  WorldSnapshot damaged = value;
  damaged.moment.stores.pop_back();
  const auto salvaged = World::salvage(damaged);
  ASSERT_TRUE(salvaged) << salvaged.error().message;
  EXPECT_EQ((*salvaged)->step({})->ledger.error(), 0);
}

TEST(Stores, the_same_commands_give_the_same_hashes_on_any_number_of_threads) {
  StoreWorld one(rock_world(), 1), two(rock_world(), 3);
  for (int i = 0; i < 60; ++i) {
    std::vector<Command> commands;
    const auto x_m = static_cast<float>(i % 7);
    if (i % 5 == 0) commands.push_back({1, 1, DigRequest{sphere({x_m, 0.0F, 0.0F}, 1.0F)}});
    if (i % 9 == 8) commands.push_back({1, 2, PlaceRequest{sphere({x_m, 1.0F, 9.0F}, 0.6F)}});
    EXPECT_EQ(one.step(commands).state_hash, two.step(commands).state_hash);
  }
  EXPECT_GT(one.last().ledger.stored, 0);
}

TEST(Stores, what_counts_for_the_rate_ceases_evenly) {
  Stores stores;
  const Stores::Rate rate{600, 60};
  const StoreName store = person(1);
  stores.put(store, MaterialMasses{{material::rock, 1500}});
  stores.count(store, 1500, 100, rate);
  EXPECT_EQ(stores.counting(store, 100, rate), 1500);
  EXPECT_EQ(stores.counting(store, 101, rate), 1490);
  EXPECT_EQ(stores.counting(store, 160, rate), 900);
  EXPECT_EQ(stores.counting(store, 250, rate), 0);
  EXPECT_EQ(stores.counting(store, Tick{1} << 60U, rate), 0);
  stores.move_all(store, worlds_store());
  stores.tidy(160, rate);
  EXPECT_TRUE(stores.contains(store)) << "else it could dig again at once";
  stores.tidy(250, rate);
  EXPECT_FALSE(stores.contains(store));
  EXPECT_EQ(stores.take_changed(),
            (std::vector<StoreContent>{{worlds_store(), {{material::rock, 1500}}}, {store, {}}}));
}

}  // namespace
}  // namespace scree
