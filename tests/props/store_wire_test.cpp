// Clients are told what their own store has, and get digs and places as operations or as bricks.
#include "server/doors/access.h"
#include "tests/support/flat_world.h"
#include "tests/support/joined_props.h"
#include "tests/support/prop_follower.h"

namespace scree {
namespace {

class DugWorld : public JointWorld {
 public:
  DugWorld() : JointWorld(rock_world()) {}
};

TEST(StoreWire, a_client_learns_what_its_own_store_has_and_nobody_elses) {
  DugWorld world;
  const StoreName own = store_of_person(0, Follower::session);
  world.ask(DigRequest{sphere({0.0F, -1.0F, 0.0F}, 1.0F), 0, own});
  const MassUnits dug = world.last().ledger.stored;
  Follower follower(world.world(), {0.0F, 2.0F, 0.0F});
  follower.publisher().set_store(Follower::session, own);
  follower.follow(world.step());
  EXPECT_EQ(sum_of(follower.mirror().carried()), dug) << "it was there when the client came";
  world.ask(DigRequest{sphere({5.0F, 0.0F, 0.0F}, 1.0F), 0, named_store("red")});
  follower.follow(world.last());
  EXPECT_EQ(sum_of(follower.mirror().carried()), dug);
  world.ask(PlaceRequest{sphere({9.0F, 0.5F, 0.0F}, 0.5F), material::rock, false, own});
  follower.follow(world.last());
  EXPECT_LT(sum_of(follower.mirror().carried()), dug);
  world.ask(TransferRequest{own, worlds_store()});
  follower.follow(world.last());
  EXPECT_TRUE(follower.mirror().carried().empty());
  const AdminListMessage list = follower.publisher().list(ListStoresRequest{});
  ASSERT_EQ(list.stores.size(), 2U);
  EXPECT_EQ(list.stores.front().store, worlds_store());
  EXPECT_EQ(list.stores.back().store, named_store("red"));
}

TEST(StoreWire, every_client_has_the_terrain_whatever_operations_it_knows) {
  const auto before_digs = static_cast<uint32_t>(Operation(DigOperation{}).index());
  for (const uint32_t operations : {operation_kinds, before_digs, 0U}) {
    DugWorld world;
    Follower follower(world.world(), {0.0F, 2.0F, 0.0F});
    follower.publisher().leave(Follower::session);
    follower.publisher().join(Follower::session, {0.0F, 2.0F, 0.0F}, 32.0F, operations);
    const auto act = [&](const Request& request) {
      EXPECT_EQ(world.ask(request).refusal, "");
      follower.follow(world.last());
    };
    act(DigRequest{sphere({0.0F, -1.0F, 0.0F}, 1.5F)});
    act(PlaceRequest{sphere({4.0F, 0.5F, 0.0F}, 0.5F)});
    const PieceId piece = *world.ask(CutOutRequest{sphere({8.0F, 0.0F, 0.0F}, 1.0F)}).prop;
    follower.follow(world.last());
    act(ReleaseRequest{piece});
    for (int i = 0; i < 6; ++i) follower.follow(world.step());
    EXPECT_TRUE(follower.mirror().pieces().contains(piece));
    act(DigRequest{sphere({8.0F, 0.0F, 0.0F}, 1.0F), piece});
    EXPECT_FALSE(follower.mirror().pieces().contains(piece));
    for (int i = 0; i < 60; ++i) follower.follow(world.step());
    EXPECT_EQ(follower.mirror().field().hash(), world.last().field_hash) << operations;
    EXPECT_EQ(follower.mirror().mismatches(), 0U);
    const OperationCounts& counts = follower.mirror().counters().operations;
    EXPECT_EQ(counts.of<DigOperation>(), operations == operation_kinds ? 2U : 0U);
    EXPECT_EQ(counts.of<PlaceOperation>(), operations == operation_kinds ? 1U : 0U);
  }
}

TEST(StoreWire, roles_say_whose_store_one_may_use) {
  const Shape shape = sphere({}, 1.0F);
  const StoreName own, red = named_store("red"), somebodys{StoreKind::token, 7};
  EXPECT_EQ(role_for(DigRequest{shape}), Role::carver);
  EXPECT_EQ(role_for(DigRequest{shape, 0, somebodys}), Role::director);
  EXPECT_EQ(role_for(PlaceRequest{shape}), Role::carver);
  EXPECT_EQ(role_for(PlaceRequest{shape, material::rock, true}), Role::builder);
  EXPECT_EQ(role_for(PlaceRequest{shape, material::rock, false, worlds_store()}), Role::director);
  EXPECT_EQ(role_for(TransferRequest{own, worlds_store()}), Role::carver);
  EXPECT_EQ(role_for(TransferRequest{worlds_store(), own}), Role::director);
  EXPECT_EQ(role_for(TransferRequest{own, red}), Role::director);
  const Request asked = with_own_store(TransferRequest{own, worlds_store()}, store_of_person(9, 4));
  EXPECT_EQ(std::get<TransferRequest>(asked).from, (StoreName{StoreKind::token, 9}));
  EXPECT_EQ(store_of_person(0, 4), (StoreName{StoreKind::session, 4}));
}

}  // namespace
}  // namespace scree
