// The methods of recombination in a running world: each ends with the same mass, by commands, recordings and
// clients alike.
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

#include "bench/support/scenes.h"
#include "client/mirror/mirror.h"
#include "server/replay/verify.h"
#include "server/store/recorder.h"
#include "server/world/world.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

WorldConfig config_of(Recombination recombination) {
  WorldConfig config;
  config.methods.recombine = recombination;
  return config;
}

Command blow(const World& world, uint32_t seeds) {
  return {1, 1, blow_at(world.config().terrain, 12.0F, 12.0F, 1.5F, seeds, 3)};
}

Command choose(const std::string& value) {
  return {1, 2, SettingsRequest{{{"recombine", value}}}};
}

int64_t merges_by(StampMethod method, const TickDelta& delta) {
  int64_t count = 0;
  for (const AppliedOperation& applied : delta.operations) {
    const auto* stamp = std::get_if<StampOperation>(&applied.operation);
    count += stamp != nullptr && stamp->method == method ? 1 : 0;
  }
  return count;
}

StampMethod method_named(Recombination recombination) {
  return *kind_named<StampMethod>(name_of(recombination));
}

class RecombineMethods : public ::testing::TestWithParam<Recombination> {};

TEST_P(RecombineMethods, all_pieces_become_terrain_and_no_mass_is_made_or_lost) {
  World world(config_of(GetParam()));
  const std::vector<Command> carve{blow(world, 24)};
  auto delta = world.step(carve);
  ASSERT_EQ(delta->spawned.size(), 24U);
  int64_t merged = 0;
  for (int tick = 0; tick < settle_ticks_max && !delta->pieces.empty(); ++tick) {
    delta = world.step({});
    ASSERT_EQ(delta->ledger.error(), 0);
    ASSERT_GE(delta->ledger.dust, 0) << "mass was lent before there was any";
    merged += merges_by(method_named(GetParam()), *delta);
  }
  EXPECT_TRUE(delta->pieces.empty());
  EXPECT_GE(merged, 24);
  EXPECT_EQ(world.measure_terrain(), delta->ledger.terrain);
  EXPECT_EQ(delta->ledger.terrain + delta->ledger.dust, 0);
}

TEST_P(RecombineMethods, a_client_that_applies_the_same_operations_ends_with_the_same_field) {
  World world(config_of(GetParam()));
  WelcomeMessage welcome;
  welcome.terrain = world.config().terrain;
  Mirror mirror(welcome);
  std::vector<Command> commands{blow(world, 16)};
  for (int tick = 0; tick < 300; ++tick) {
    const auto delta = world.step(commands);
    commands.clear();
    FrameMessage frame;
    frame.tick = delta->tick;
    for (const AppliedOperation& applied : delta->operations) frame.operations.push_back(applied.operation);
    const auto applied = mirror.apply(frame);
    ASSERT_TRUE(applied) << applied.error().message;
    ASSERT_EQ(mirror.field().hash(), delta->field_hash) << "tick " << delta->tick;
  }
  EXPECT_GT(mirror.counters().pieces_merged, 0U);
}

std::string name_of_method(const ::testing::TestParamInfo<Recombination>& info) {
  return std::string(name_of(info.param));
}

INSTANTIATE_TEST_SUITE_P(recombine, RecombineMethods,
                         ::testing::Values(Recombination::stamp, Recombination::slices, Recombination::sphere,
                                           Recombination::facets),
                         name_of_method);

TEST(recombine, off_leaves_pieces_at_rest_as_bodies_until_it_is_switched_on) {
  World world(config_of(Recombination::off));
  const std::vector<Command> carve{blow(world, 12)};
  auto delta = world.step(carve);
  const size_t made = delta->pieces.size();
  for (int tick = 0; tick < 600; ++tick) delta = world.step({});
  EXPECT_GE(delta->pieces.size(), made);
  EXPECT_EQ(delta->ledger.error(), 0);
  const std::vector<Command> on{choose("slices")};
  delta = world.step(on);
  auto merged = merges_by(StampMethod::slices, *delta);
  for (int tick = 0; tick < 40; ++tick) merged += merges_by(StampMethod::slices, *(delta = world.step({})));
  EXPECT_GT(merged, 0) << "what was frozen thaws, rests and merges";
  for (int tick = 0; tick < settle_ticks_max && !delta->pieces.empty(); ++tick) delta = world.step({});
  EXPECT_TRUE(delta->pieces.empty());
  EXPECT_EQ(world.measure_terrain(), delta->ledger.terrain);
}

TEST(recombine, a_session_that_changes_the_method_verifies) {
  const auto folder =
      std::filesystem::temp_directory_path() / ("scree_recombine_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "session.scree").string();
  const WorldConfig config = config_of(Recombination::off);
  auto recorder = Recorder::create(path, {"test", config});
  ASSERT_TRUE(recorder) << recorder.error().message;
  World world(config);
  for (Tick tick = 1; tick <= 420; ++tick) {
    std::vector<Command> commands;
    if (tick == 1) commands = {blow(world, 16)};
    if (tick == 200) commands = {choose("sphere")};
    if (tick == 201) commands = {choose("slices")};
    if (tick == 202) commands = {choose("stamp")};
    (*recorder)->push(world.step(commands), commands);
  }
  ASSERT_TRUE((*recorder)->finish());
  {
    auto reader = RecordingReader::open(path);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ((*reader)->header().world, config);
    const auto report = verify(**reader);
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->agrees()) << report->difference;
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace scree
