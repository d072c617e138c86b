// What regions forbid in a world.
#include <cmath>
#include <gtest/gtest.h>

#include "server/formats/world_codec.h"
#include "server/replay/replay_source.h"
#include "server/store/recorder.h"
#include "server/world/world_snapshot.h"
#include "shared/region/limits.h"
#include "tests/regions/some_regions.h"
#include "tests/support/flat_world.h"
#include "tests/support/given_voxels.h"
#include "tests/support/prop_world.h"
#include "tests/support/test_folder.h"
#include "tests/support/verify_recording.h"

namespace scree {
namespace {

Reply ask_as(PropWorld& world, const Asker& asker, const Request& request, uint64_t session = 7) {
  world.step({{session, 1, request, 0, asker}});
  EXPECT_EQ(world.last().replies.size(), 1U);
  return world.last().replies.empty() ? Reply() : world.last().replies.front();
}

TEST(RegionEdits, others_are_refused_by_name_and_told_where) {
  PropWorld world(rock_world());
  SetRegionRequest set = set_box({0.0F, 0.0F, 0.0F}, glm::vec3(4.0F), forbids::edits, "old mill");
  set.region.editors = RegionEditors::persons;
  set.region.persons = {"Ann"};
  ASSERT_EQ(world.ask(set).refusal, "");
  const Asker bo{Role::admin, "Bo"}, ann{Role::carver, "Ann"};
  const glm::vec3 at(0.0F, 0.0F, 0.0F);
  const auto is_refused = [&](const Request& request) {
    const Reply reply = ask_as(world, bo, request);
    EXPECT_EQ(refusal_name(reply), "in_region") << request.index();
    EXPECT_NE(reply.refusal.find("'old mill'"), std::string::npos) << reply.refusal;
    EXPECT_NE(reply.refusal.find("Ann"), std::string::npos) << reply.refusal;
  };
  is_refused(carve_ball(at, 1.0F));
  is_refused(FillRequest{sphere({0.0F, 1.0F, 0.0F}, 1.0F)});
  is_refused(PaintRequest{sphere(at, 1.0F), material::soil});
  is_refused(CutOutRequest{sphere(at, 1.0F)});
  is_refused(BlastRequest{at, 4e6F, 1});
  is_refused(piece_of(given_block({4, 4, 4}), {0.0F, 1.0F, 0.0F}));
  is_refused(carve_ball({4.5F, 0.0F, 0.0F}, 1.0F));
  EXPECT_EQ(ask_as(world, bo, carve_ball({5.5F, 0.0F, 0.0F}, 1.0F)).refusal, "") << "it lies beside";
  EXPECT_EQ(ask_as(world, ann, carve_ball(at, 1.0F)).refusal, "");
  EXPECT_EQ(world.ask(carve_ball({0.0F, -1.0F, 0.0F}, 1.0F)).refusal, "") << "the server itself may";
  ASSERT_EQ(world.ask(RemoveRegionRequest{"old mill"}).refusal, "");
  EXPECT_EQ(ask_as(world, bo, carve_ball({0.0F, -2.0F, 0.0F}, 1.0F)).refusal, "");
}

TEST(RegionEdits, a_piece_that_lies_there_is_neither_carved_nor_broken) {
  PropWorld world(rock_world());
  const Reply added = world.ask(piece_of(given_block({12, 12, 12}), {-1.5F, 0.2F, -1.5F}));
  ASSERT_TRUE(added.prop.has_value()) << added.refusal;
  world.steps(60);
  ASSERT_EQ(world.ask(set_box({0.0F, 0.0F, 0.0F}, glm::vec3(4.0F), forbids::edits)).refusal, "");
  CarveRequest carve = carve_ball({0.0F, 1.5F, 0.0F}, 0.5F);
  carve.piece = *added.prop;
  EXPECT_EQ(refusal_name(ask_as(world, {Role::builder, "Bo"}, carve)), "in_region");
  EXPECT_EQ(refusal_name(ask_as(world, {Role::builder, "Bo"}, BreakRequest{*added.prop, {0.0F, 1.5F, 0.0F}})),
            "in_region");
  EXPECT_EQ(world.ask(BreakRequest{*added.prop, {0.0F, 1.5F, 0.0F}}).refusal, "");
}

TEST(RegionLimits, wrong_ones_too_many_and_missing_ones_are_refused_by_name) {
  PropWorld world(rock_world());
  SetRegionRequest wrong = set_box(glm::vec3(0.0F), glm::vec3(4096.0F), forbids::all);
  EXPECT_EQ(refusal_name(world.ask(wrong)), "region_invalid") << "over all the world";
  wrong = set_box(glm::vec3(0.0F), glm::vec3(1.0F), 0);
  wrong.lasts_s = -1.0F;
  EXPECT_EQ(refusal_name(world.ask(wrong)), "region_invalid");
  EXPECT_EQ(refusal_name(world.ask(RemoveRegionRequest{"tower"})), "region_missing");
  for (size_t i = 0; i < limits::regions_max; ++i)
    ASSERT_EQ(world
                  .ask(set_box(glm::vec3(0.0F), glm::vec3(1.0F + static_cast<float>(i)), forbids::all,
                               std::to_string(i)))
                  .refusal,
              "");
  EXPECT_EQ(refusal_name(world.ask(set_box(glm::vec3(0.0F), glm::vec3(1.0F), 0, "more"))), "regions_max");
  EXPECT_EQ(world.ask(set_box(glm::vec3(9.0F), glm::vec3(1.0F), 0, "7")).refusal, "") << "it is replaced";
  EXPECT_EQ(world.last().regions->size(), limits::regions_max);
  EXPECT_EQ(world.last().regions->at(7).centre_m, glm::vec3(9.0F));
}

TEST(RegionLimits, one_that_lasts_ends_by_itself) {
  PropWorld world(rock_world());
  SetRegionRequest set = set_box({0.0F, 0.0F, 0.0F}, glm::vec3(4.0F), forbids::edits);
  set.lasts_s = 0.5F;
  ASSERT_EQ(world.ask(set).refusal, "");
  const Tick rate = world.world().config().tick_rate_hz;
  EXPECT_EQ(world.last().regions->front().until, world.last().tick + rate / 2);
  world.steps(static_cast<int>(rate / 2) - 1);
  EXPECT_EQ(refusal_name(ask_as(world, {}, carve_ball(glm::vec3(0.0F), 1.0F))), "in_region");
  world.step();
  ASSERT_NE(world.last().regions, nullptr);
  EXPECT_TRUE(world.last().regions->empty());
  EXPECT_EQ(ask_as(world, {}, carve_ball(glm::vec3(0.0F), 1.0F)).refusal, "");
}

/// What breaks off stays apart, so that no heap of it bears the tower.
WorldConfig without_merges() {
  WorldConfig config = rock_world();
  config.methods.recombine = Recombination::off;
  return config;
}

/// A tower of rock, 3 m wide and 14 m high.
void build_tower(PropWorld& world) {
  for (const float y : {3.0F, 10.0F})
    ASSERT_EQ(world.ask(FillRequest{box({0.0F, y, 0.0F}, {1.5F, 4.0F, 1.5F})}).refusal, "");
  world.steps(30);
}

uint32_t falls_in(const TickDelta& delta) {
  uint32_t falls = 0;
  for (const AppliedOperation& applied : delta.operations)
    falls += std::holds_alternative<IslandOperation>(applied.operation) ? 1 : 0;
  return falls;
}

/// Whether rock stands at a place.
bool is_rock(PropWorld& world, glm::vec3 at_m) {
  const glm::vec3 at = at_m / voxel_m + 0.5F;
  const VoxelCoord voxel{floor_to_int(at.x), floor_to_int(at.y), floor_to_int(at.z)};
  const VoxelCoord inside = voxel - first_voxel(brick_of(voxel));
  const Brick& brick = const_cast<Field&>(world.world().field()).brick(brick_of(voxel));
  return brick.codes[static_cast<size_t>(Brick::index(inside.x, inside.y, inside.z))] < 0;
}

/// 200 blows around the tower's foot and under it; those in the region are refused.
std::vector<Command> blow(int number) {
  const float x = static_cast<float>(number % 7 - 3) * 0.8F,
              z = static_cast<float>(number / 7 % 7 - 3) * 0.8F;
  const float y = number < 100 ? 0.9F : -0.6F;
  return {{7, static_cast<uint32_t>(number), carve_ball({x, y, z}, 0.9F, 3, static_cast<uint32_t>(number))}};
}

TEST(RegionFalls, a_tower_stands_after_200_blows_and_falls_when_the_region_ends) {
  for (const bool is_protected : {true, false}) {
    PropWorld world(without_merges());
    build_tower(world);
    // From 3 m up: all below is carved away.
    if (is_protected) {
      ASSERT_EQ(
          world.ask(set_box({0.0F, 9.0F, 0.0F}, {2.5F, 6.0F, 2.5F}, forbids::edits | forbids::falls)).refusal,
          "");
    }
    uint32_t fell = 0;
    for (int number = 0; number < 200; ++number) {
      fell += falls_in(world.step(blow(number)));
      fell += falls_in(world.step());
      fell += falls_in(world.step());
    }
    for (int i = 0; i < 300; ++i) fell += falls_in(world.step());
    EXPECT_EQ(is_rock(world, {0.0F, 9.0F, 0.0F}), is_protected);
    EXPECT_EQ(is_rock(world, {0.0F, 1.0F, 0.0F}), false) << "the blows took its foot";
    if (!is_protected) continue;
    ASSERT_EQ(world.ask(RemoveRegionRequest{"tower"}).refusal, "");
    uint32_t falls = 0;
    for (int i = 0; i < 300; ++i) falls += falls_in(world.step());
    EXPECT_GT(falls, 0U);
    EXPECT_FALSE(is_rock(world, {0.0F, 12.5F, 0.0F})) << "it fell when the region was over";
  }
}

TEST(RegionFalls, what_hangs_is_kept_and_falls_after_a_restart) {
  PropWorld world(without_merges());
  build_tower(world);
  ASSERT_EQ(world.ask(set_box({0.0F, 12.0F, 0.0F}, {2.5F, 2.0F, 2.5F}, forbids::falls)).refusal, "");
  for (int number = 0; number < 49; ++number) world.step(blow(number));
  world.steps(120);
  ASSERT_TRUE(is_rock(world, {0.0F, 9.0F, 0.0F})) << "it hangs together with what the region holds";
  ASSERT_FALSE(is_rock(world, {0.0F, 1.0F, 0.0F}));
  const std::vector<uint8_t> bytes = encode(world.world().snapshot());
  std::vector<uint64_t> ends;
  for (int time = 0; time < 2; ++time) {
    const auto value = decode_world(bytes);
    ASSERT_TRUE(value) << value.error().message;
    EXPECT_FALSE(value->moment.hung.empty());
    auto restored = World::restore(*value);
    ASSERT_TRUE(restored) << restored.error().message;
    EXPECT_EQ(encode((*restored)->snapshot()), bytes);
    uint32_t falls = 0;
    for (int i = 0; i < 240; ++i) {
      std::vector<Command> commands;
      if (i == 5) commands.push_back({0, 1, RemoveRegionRequest{"tower"}});
      const auto delta = (*restored)->step(commands);
      falls += falls_in(*delta);
      ends.push_back(delta->state_hash);
    }
    EXPECT_GT(falls, 0U);
  }
  EXPECT_TRUE(std::equal(ends.begin(), ends.begin() + 240, ends.begin() + 240));
}

TEST(RegionDents, blows_leave_no_dent) {
  for (const bool is_protected : {true, false}) {
    PropWorld world(flat_world());
    if (is_protected) {
      ASSERT_EQ(world.ask(set_box(glm::vec3(0.0F), glm::vec3(8.0F), forbids::dents)).refusal, "");
    }
    world.add(ball(0.5F, 4000.0F), {0.0F, 12.0F, 0.0F}, {0.0F, -60.0F, 0.0F});
    size_t carves = 0;
    for (int i = 0; i < 120; ++i)
      for (const AppliedOperation& applied : world.step().operations)
        carves += std::holds_alternative<CarveOperation>(applied.operation) ? 1 : 0;
    EXPECT_EQ(carves == 0, is_protected);
  }
}

TEST(RegionPieces, none_comes_in_however_fast_and_one_that_is_in_may_leave) {
  for (const RegionForm form : all_kinds<RegionForm>) {
    WorldConfig config = rock_world();
    config.methods.impacts = false;  // what breaks at the surface may leave parts inside
    PropWorld world(config);
    const Region region = region_of(form, {0.0F, 30.0F, 0.0F}, {3.0F, 3.0F, 3.0F}, forbids::pieces);
    AddPieceRequest inside = piece_of(given_block({4, 4, 4}), {-0.5F, 30.0F, -0.5F});
    inside.velocity_m_s = {0.0F, 0.0F, 20.0F};
    ASSERT_EQ(world.ask(inside).refusal, "");
    const PieceId first = *world.last().replies.front().prop;
    ASSERT_EQ(world.ask(SetRegionRequest{region}).refusal, "");
    std::vector<PieceId> thrown;
    for (const glm::vec3 from :
         {glm::vec3(-20.0F, 30.0F, 0.3F), glm::vec3(0.2F, 50.0F, 0.1F), glm::vec3(12.0F, 34.0F, 1.0F)}) {
      AddPieceRequest fast = piece_of(given_block({4, 4, 4}), from - glm::vec3(0.375F));
      const glm::vec3 way = glm::vec3(0.0F, 30.0F, 0.0F) - from;
      fast.velocity_m_s = way * (199.0F / std::sqrt(glm::dot(way, way)));
      ASSERT_EQ(world.ask(fast).refusal, "");
      thrown.push_back(*world.last().replies.front().prop);
    }
    bool left = false;
    for (int i = 0; i < 120; ++i) {
      world.step();
      for (const PieceState& piece : world.last().pieces) {
        const float away_m = distance(region, dequantise(piece.pose).position_m);
        if (piece.id == first)
          left = left || away_m > 0.5F;
        else
          EXPECT_GT(away_m, -0.001F) << name_of(form) << " " << piece.id;
      }
    }
    EXPECT_TRUE(left) << name_of(form);
  }
}

using Told = std::vector<std::pair<bool, PieceId>>;

void append_told(Told& told, const TickDelta& delta) {
  for (const Event& event : delta.told) {
    if (event.kind == EventKind::region_enter) told.emplace_back(true, event.body);
    if (event.kind == EventKind::region_leave) told.emplace_back(false, event.body);
  }
}

/// A prop that nothing moves but what it was told.
Prop carriage() {
  Prop prop = ball(0.3F, 10.0F);
  prop.motion = PropMotion::kinematic;
  prop.tag = 99;
  return prop;
}

TEST(RegionEvents, of_1000_crossings_none_is_missed_and_none_told_twice) {
  PropWorld world(rock_world());
  SetRegionRequest set = {region_of(RegionForm::sphere, {0.0F, 50.0F, 0.0F}, glm::vec3(1.0F), 0, "gate")};
  set.region.tells = true;
  ASSERT_EQ(world.ask(set).refusal, "");
  const PieceId id = world.add(carriage(), {-15.0F, 50.0F, 0.0F}, {200.0F, 0.0F, 0.0F});
  Told told;
  // 200 m/s are 3.3 m a tick: it is seldom inside at the end of one.
  float speed = 200.0F;
  for (int crossing = 0; crossing < 1000; ++crossing) {
    for (int i = 0; i < 9; ++i) append_told(told, world.step());
    speed = -speed;
    MovePropRequest turn{id};
    turn.velocity_m_s = glm::vec3(speed, 0.0F, 0.0F);
    world.step({{0, 1, turn}});
    append_told(told, world.last());
  }
  ASSERT_EQ(told.size(), 2000U);
  for (size_t i = 0; i < told.size(); ++i) EXPECT_EQ(told[i], std::pair(i % 2 == 0, id)) << i;
}

TEST(RegionEvents, what_is_put_there_made_there_and_ends_there_is_told_once) {
  PropWorld world(rock_world());
  const PieceId before = world.add(carriage(), {1.0F, 20.0F, 0.0F});
  SetRegionRequest set = {region_of(RegionForm::box, {0.0F, 20.0F, 0.0F}, glm::vec3(3.0F), 0, "gate")};
  set.region.tells = true;
  Told told;
  ASSERT_EQ(world.ask(set).refusal, "");
  append_told(told, world.last());
  EXPECT_TRUE(told.empty()) << "what was in it did not enter";
  const PieceId made = world.add(carriage(), {-1.0F, 20.0F, 0.0F});
  append_told(told, world.last());
  MovePropRequest out{before};
  out.place_m = glm::vec3(40.0F, 20.0F, 0.0F);
  ASSERT_EQ(world.ask(out).refusal, "");
  append_told(told, world.last());
  ASSERT_EQ(world.ask(RemovePropRequest{made}).refusal, "");
  append_told(told, world.last());
  EXPECT_EQ(world.last().told.back().tag, 99U);
  EXPECT_EQ(world.last().told.back().text, "gate");
  world.steps(3);
  append_told(told, world.last());
  EXPECT_EQ(told, (Told{{true, made}, {false, before}, {false, made}}));
}

/// A replay has the regions of the tick that it stands at.
void expect_replays(const std::string& path) {
  auto source = ReplaySource::open(path, 2);
  ASSERT_TRUE(source) << source.error().message;
  const auto count_at = [&](Tick tick) {
    const auto delta = (*source)->jump(tick);
    EXPECT_TRUE(delta) << delta.error().message;
    return (*delta)->regions == nullptr ? size_t{99} : (*delta)->regions->size();
  };
  EXPECT_EQ(count_at(100), 1U);
  EXPECT_EQ(count_at(4), 0U);
  EXPECT_EQ(count_at(290), 1U);
  EXPECT_EQ(count_at(700), 0U);
  EXPECT_EQ(count_at(701), 99U) << "nothing changed";
}

TEST(RegionRecording, a_recording_of_all_that_regions_do_is_verified) {
  const TestFolder folder;
  const std::string path = folder / "regions.scree";
  const WorldConfig config = without_merges();
  World world(config);
  RecordingHeader header{"test", config};
  header.contacts_j = 1e9F;
  auto recorder = Recorder::create(path, header);
  ASSERT_TRUE(recorder) << recorder.error().message;
  SetRegionRequest tower = set_box({0.0F, 9.0F, 0.0F}, {2.5F, 6.0F, 2.5F}, forbids::edits | forbids::falls);
  tower.region.tells = true;
  tower.region.editors = RegionEditors::role;
  tower.region.role = Role::builder;
  size_t told = 0, refused = 0, carved = 0;
  for (Tick tick = 1; tick <= 900; ++tick) {
    std::vector<Command> commands;
    if (tick < 3)
      commands.push_back({0, 1, FillRequest{box({0.0F, tick < 2 ? 3.0F : 10.0F, 0.0F}, {1.5F, 4.0F, 1.5F})}});
    if (tick == 5) commands.push_back({0, 2, tower});
    if (tick >= 10 && tick < 210) commands = blow(static_cast<int>(tick) - 10);
    if (tick == 220)
      commands.push_back({7, 900, carve_ball({1.5F, 9.0F, 0.0F}, 0.5F), 0, {Role::carver, "Bo"}});
    if (tick == 221)
      commands.push_back({7, 901, carve_ball({1.5F, 9.0F, 0.0F}, 0.5F), 0, {Role::builder, "Bo"}});
    if (tick == 300) commands.push_back({0, 3, RemoveRegionRequest{"tower"}});
    auto delta = world.step(commands);
    for (const Reply& reply : delta->replies) {
      if (reply.request == 900) refused += refusal_name(reply) == "in_region" ? 1 : 0;
      if (reply.request == 901) carved += reply.refusal.empty() ? 1 : 0;
    }
    told += delta->told.size();
    (*recorder)->push(std::move(delta), std::move(commands));
  }
  EXPECT_EQ(refused, 1U);
  EXPECT_EQ(carved, 1U);
  EXPECT_GT(told, 0U);
  const auto finished = (*recorder)->finish();
  ASSERT_TRUE(finished) << finished.error().message;
  expect_replays(path);
  expect_verifies(path);
}

}  // namespace
}  // namespace scree
