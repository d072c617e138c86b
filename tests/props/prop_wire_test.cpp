// Props on their way to clients, and in files: by motions and by whole poses, in recordings that are played,
// sought, verified, and cut.
#include <filesystem>
#include <glm/geometric.hpp>
#include <set>

#include "bench/support/scenes.h"
#include "server/replay/replay_source.h"
#include "server/replay/verify.h"
#include "server/store/recorder.h"
#include "tests/support/flat_world.h"
#include "tests/support/prop_follower.h"
#include "tests/support/prop_world.h"
#include "tests/support/test_folder.h"
#include "tests/support/verify_recording.h"

namespace scree {
namespace {

class PropWire : public ::testing::TestWithParam<bool> {};

TEST_P(PropWire, clients_have_the_props_near_them_where_they_are) {
  PropWorld world(rock_world());
  world.step();
  Follower client(world.world(), {0.0F, 2.0F, 0.0F}, GetParam());
  const auto step = [&](const std::vector<Command>& commands = {}) { client.follow(world.step(commands)); };
  const auto add = [&](const Prop& prop, glm::vec3 place_m) {
    step({{0, 1, AddPropRequest{prop, place_m}}});
    return *world.last().replies.front().prop;
  };
  const PieceId near = add(crate(), {1.0F, 4.0F, 0.0F}), gone = add(ball(0.4F, 30.0F), {-2.0F, 3.0F, 0.0F});
  const PieceId far = add(crate(), {200.0F, 1.0F, 0.0F});
  step({{0, 1, blow_at(world.world().config().terrain, 3.0F, 3.0F, 1.5F, 12, 3)}});
  for (int i = 0; i < 180; ++i) step();
  const auto& seen = client.mirror().props();
  EXPECT_TRUE(seen.contains(near));
  EXPECT_FALSE(seen.contains(far));
  ASSERT_TRUE(seen.contains(gone));
  EXPECT_EQ(seen.at(near).prop->mass_kg, 200.0F);
  EXPECT_LT(glm::distance(seen.at(near).to.position_m, world.place_m(near)), 0.01F);
  EXPECT_LT(glm::distance(seen.at(gone).to.position_m, world.place_m(gone)), 0.01F);
  step({{0, 1, RemovePropRequest{gone}}});
  for (int i = 0; i < 6; ++i) step();
  EXPECT_FALSE(seen.contains(gone));
  EXPECT_EQ(client.mirror().mismatches(), 0U);
}

INSTANTIATE_TEST_SUITE_P(kernels, PropWire, ::testing::Bool());

TEST(PropMirror, refuses_what_cannot_be) {
  PropWorld world(rock_world());
  Mirror mirror(welcome_of(world.world()));
  ASSERT_TRUE(mirror.apply(PropMessage{5, crate(), {}}));
  EXPECT_FALSE(mirror.apply(PropMessage{5, crate(), {}})) << "a second time";
}

/// Crates fall beside a blow, one is pushed, one is taken away.
void record(const std::string& path, Tick ticks) {
  WorldConfig config = rock_world();
  World world(config);
  auto recorder = Recorder::create(path, {"test", config});
  ASSERT_TRUE(recorder) << recorder.error().message;
  PieceId first = 0;
  for (Tick tick = 1; tick <= ticks; ++tick) {
    std::vector<Command> commands;
    if (tick % 60 == 10)
      commands.push_back(
          {0, 1, AddPropRequest{crate(), {0.2F, 3.0F + 0.01F * static_cast<float>(tick), 0.0F}}});
    if (tick == 70) commands.push_back({0, 2, PushRequest{first, {800.0F, 0.0F, 0.0F}, {0.2F, 1.0F, 0.0F}}});
    if (tick == 100) commands.push_back({0, 3, BlastRequest{{3.0F, 0.0F, 0.0F}, 2e7F, 3}});
    if (tick == 150) commands.push_back({0, 4, RemovePropRequest{first}});
    auto delta = world.step(commands);
    for (const Reply& reply : delta->replies) {
      EXPECT_EQ(reply.refusal, "");
      if (reply.prop && first == 0) first = *reply.prop;
    }
    (*recorder)->push(std::move(delta), std::move(commands));
  }
  const auto finished = (*recorder)->finish();
  ASSERT_TRUE(finished) << finished.error().message;
}

std::set<PieceId> ids_of(const std::vector<PieceState>& props) {
  std::set<PieceId> ids;
  for (const PieceState& prop : props) ids.insert(prop.id);
  return ids;
}

TEST(PropRecording, plays_seeks_and_verifies) {
  const TestFolder folder;
  const std::string path = folder / "props.scree";
  record(path, 900);
  auto source = ReplaySource::open(path);
  ASSERT_TRUE(source) << source.error().message;
  std::map<Tick, std::vector<PieceState>> played;
  PublishedState state;
  while (true) {
    const auto delta = (*source)->next();
    ASSERT_TRUE(delta) << delta.error().message;
    if (*delta == nullptr) break;
    state.apply(**delta);
    played[(*delta)->tick] = (*delta)->props;
  }
  ASSERT_EQ(played.rbegin()->first, 900U);
  EXPECT_EQ(ids_of(played.at(60)).size(), 1U);
  EXPECT_EQ(ids_of(played.at(149)).size(), 3U);
  EXPECT_EQ(ids_of(played.at(150)).size(), 2U);
  for (const Tick to : {700U, 149U, 65U, 899U}) {
    const auto jumped = (*source)->jump(to);
    ASSERT_TRUE(jumped) << jumped.error().message;
    EXPECT_EQ((*jumped)->props, played.at(to)) << to;
  }
  expect_verifies(path);
}

}  // namespace
}  // namespace scree
