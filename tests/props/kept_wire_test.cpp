// Clients are told which pieces are kept, and lists of bodies say it.
#include "tests/support/flat_world.h"
#include "tests/support/joined_props.h"
#include "tests/support/prop_follower.h"

namespace scree {
namespace {

class KeptWorld : public JointWorld {
 public:
  KeptWorld() : JointWorld(rock_world()) {}

  PieceId cut_out(glm::vec3 at_m) {
    const Reply reply = ask(CutOutRequest{sphere(at_m, 1.0F)});
    EXPECT_TRUE(reply.prop.has_value()) << reply.refusal;
    return reply.prop.value_or(0);
  }
  void steps_for(Follower& follower, int count) {
    for (int i = 0; i < count; ++i) follower.follow(step());
  }
};

using Ids = std::set<PieceId>;

TEST(KeptWire, a_client_learns_what_is_kept_and_what_is_released) {
  for (const bool has_kernels : {true, false}) {
    KeptWorld world;
    const PieceId before = world.cut_out({0.0F, 0.0F, 0.0F});
    Follower follower(world.world(), {0.0F, 2.0F, 0.0F}, has_kernels);
    world.steps_for(follower, 6);
    EXPECT_EQ(follower.mirror().kept(), Ids{before}) << "it was kept when the client came";
    const PieceId later = world.cut_out({6.0F, 0.0F, 0.0F});
    follower.follow(world.last());
    world.steps_for(follower, 6);
    EXPECT_EQ(follower.mirror().kept(), (Ids{before, later}));
    world.ask(ReleaseRequest{before});
    follower.follow(world.last());
    world.steps_for(follower, 6);
    EXPECT_EQ(follower.mirror().kept(), Ids{later});
    world.ask(BreakRequest{later, {6.0F, 0.0F, 0.0F}, 4, 1});
    follower.follow(world.last());
    world.steps_for(follower, 6);
    EXPECT_TRUE(follower.mirror().kept().empty()) << "its parts are kept no more";
  }
}

TEST(KeptWire, a_client_that_comes_near_learns_it_then) {
  KeptWorld world;
  const PieceId far = world.cut_out({90.0F, 0.0F, 0.0F});
  Follower follower(world.world(), {0.0F, 2.0F, 0.0F});
  world.steps_for(follower, 6);
  EXPECT_TRUE(follower.mirror().kept().empty());
  follower.publisher().set_interest(Follower::session, {90.0F, 2.0F, 0.0F}, 32.0F);
  world.steps_for(follower, 60);
  EXPECT_EQ(follower.mirror().kept(), Ids{far});
  follower.publisher().set_interest(Follower::session, {0.0F, 2.0F, 0.0F}, 32.0F);
  world.steps_for(follower, 60);
  EXPECT_TRUE(follower.mirror().kept().empty());
}

TEST(BodyList, rows_say_what_is_there) {
  KeptWorld world;
  const PieceId piece = world.cut_out({0.0F, 0.0F, 0.0F});
  Prop tagged = crate(0.5F, 300.0F);
  tagged.tag = 7;
  const PieceId prop = world.add(tagged, {20.0F, 40.0F, 0.0F}, {5.0F, 0.0F, 0.0F});
  const PieceId post = world.add_post({20.0F, 20.0F, 0.0F});
  Workers workers(1);
  Publisher publisher({.terrain = world.world().config().terrain, .palette = world.world().config().palette},
                      workers);
  publisher.begin(world.world().keyframe());
  for (int i = 0; i < 12; ++i) publisher.publish(world.step(), [](uint64_t) { return Backlog(); });
  const AdminListMessage all = publisher.list(ListBodiesRequest{});
  ASSERT_EQ(all.bodies.size(), 3U);
  EXPECT_EQ(all.bodies[0].id, piece);
  EXPECT_TRUE(all.bodies[0].kept);
  const float ball_kg = 0.5F * 4.19F * world.world().config().palette->row(material::rock).density_kg_m3;
  EXPECT_NEAR(all.bodies[0].mass_kg, ball_kg, 0.2F * ball_kg);
  EXPECT_EQ(all.bodies[1].id, prop);
  EXPECT_TRUE(all.bodies[1].is_prop);
  EXPECT_EQ(all.bodies[1].tag, 7U);
  EXPECT_EQ(all.bodies[1].mass_kg, 300.0F);
  EXPECT_NEAR(all.bodies[1].velocity_m_s.x, 5.0F, 0.2F);
  EXPECT_LT(all.bodies[1].velocity_m_s.y, -1.0F);
  EXPECT_EQ(all.bodies[2].motion, PropMotion::fixed);
  const PlacesWithin low{{-50.0F, -50.0F, -50.0F}, {50.0F, 30.0F, 50.0F}};
  EXPECT_EQ(publisher.list(ListBodiesRequest{low}).bodies.size(), 2U);
  EXPECT_EQ(publisher.list(ListBodiesRequest{{}, {post}}).bodies.size(), 1U);
}

TEST(BodyList, a_joint_is_where_its_sides_are) {
  KeptWorld world;
  const PieceId post = world.add_post({20.0F, 20.0F, 0.0F}), load = world.add(crate(), {26.0F, 20.0F, 0.0F});
  const JointId rope = world.join(line_between(JointKind::rope, world.frame(post), world.place_m(post),
                                               world.frame(load), world.place_m(load)));
  Workers workers(1);
  Publisher publisher({.terrain = world.world().config().terrain}, workers);
  publisher.begin(world.world().keyframe());
  const auto near = [&](glm::vec3 at_m) {
    return publisher.list(ListJointsRequest{PlacesWithin{at_m - 1.0F, at_m + 1.0F}}).joints;
  };
  ASSERT_EQ(near({20.0F, 20.0F, 0.0F}).size(), 1U);
  EXPECT_EQ(near({20.0F, 20.0F, 0.0F}).front().id, rope);
  EXPECT_EQ(near({26.0F, 20.0F, 0.0F}).size(), 1U);
  EXPECT_TRUE(near({23.0F, 20.0F, 0.0F}).empty());
  EXPECT_EQ(publisher.list(ListJointsRequest{}).joints.size(), 1U);
}

}  // namespace
}  // namespace scree
