// The stages of a tick: each has its time, and says whether it changed anything.
#include "server/world/stages.h"

#include <gtest/gtest.h>
#include <set>

#include "server/world/world.h"
#include "tests/support/flat_world.h"

namespace scree {
namespace {

Command blow() {
  CarveRequest carve;
  carve.shape = sphere({0.0F, -0.8F, 0.0F}, 2.0F);
  carve.seeds = 16;
  return {1, 1, carve};
}

TEST(stages, every_stage_has_a_name_of_its_own) {
  std::set<std::string_view> names;
  for (const TickStageRow& row : tick_stages) EXPECT_TRUE(names.insert(row.name).second) << row.name;
  EXPECT_FALSE(names.contains("")) << "a stage without a name";
}

TEST(stages, a_tick_that_carves_charges_every_stage_and_says_which_acted) {
  World world(flat_world());
  const std::vector<Command> commands{blow()};
  const auto delta = world.step(commands);
  for (const TickStageRow& row : tick_stages) EXPECT_GT(delta->times[row.stage], 0.0) << row.name;
  const auto acted = [&](TickStage stage) { return delta->times.acted[index_of(stage)]; };
  EXPECT_TRUE(acted(TickStage::requests));
  EXPECT_TRUE(acted(TickStage::spawn));
  EXPECT_FALSE(acted(TickStage::recombine));
  double sum = 0.0;
  for (const double ms : delta->times.ms) sum += ms;
  EXPECT_EQ(delta->times.total_ms(), sum);
}

TEST(stages, a_tick_without_new_pieces_charges_nothing_to_their_making) {
  World world(flat_world());
  const auto delta = world.step({});
  EXPECT_EQ(delta->times[TickStage::spawn], 0.0);
  EXPECT_TRUE(delta->times.acted.none());
}

TEST(stages, recombining_acts_in_the_ticks_in_which_pieces_merge) {
  World world(flat_world());
  const std::vector<Command> commands{blow()};
  auto delta = world.step(commands);
  uint64_t merging = 0, acting = 0;
  for (int tick = 0; tick < 1500 && !delta->pieces.empty(); ++tick) {
    delta = world.step({});
    bool merged = false;
    for (const AppliedOperation& applied : delta->operations)
      merged = merged || pieces_merged_by(applied.operation) > 0;
    merging += merged ? 1 : 0;
    acting += delta->times.acted[index_of(TickStage::recombine)] ? 1 : 0;
  }
  EXPECT_GT(merging, 0U);
  EXPECT_EQ(acting, merging);
}

TEST(stages, time_within_a_stage_is_taken_out_of_the_outer_one) {
  StageTimes times;
  StageStopwatch stopwatch;
  stopwatch.restart(TickStage::requests);
  EXPECT_EQ(stopwatch.switch_to(TickStage::spawn, times), TickStage::requests);
  const double carved = times[TickStage::requests];
  EXPECT_EQ(stopwatch.switch_to(TickStage::requests, times), TickStage::spawn);
  EXPECT_EQ(times[TickStage::requests], carved) << "the time in between is the inner stage's";
  EXPECT_GT(times[TickStage::spawn], 0.0);
}

}  // namespace
}  // namespace scree
