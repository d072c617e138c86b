#include "studies/scale/machine_model.h"

#include <gtest/gtest.h>

namespace scree {
namespace {

std::vector<MeasuredLoad> made(const LoadCosts& costs) {
  std::vector<MeasuredLoad> measured;
  for (const double bots : {0.0, 2.0, 6.0})
    for (const double viewers : {0.0, 100.0, 400.0}) {
      const MachineLoad load{bots, viewers};
      measured.push_back({load, costs.of(load)});
    }
  return measured;
}

TEST(LoadCosts, costs_are_found_again_exactly) {
  const LoadCosts costs{5.0, 30.0, 0.2, 0.01};
  const auto found = fit_load_costs(made(costs));
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->idle, costs.idle, 1e-9);
  EXPECT_NEAR(found->bot, costs.bot, 1e-9);
  EXPECT_NEAR(found->onlooker, costs.onlooker, 1e-9);
  EXPECT_NEAR(found->shown, costs.shown, 1e-9);
  EXPECT_NEAR(relative_error(made(costs), [&](const MachineLoad& load) { return found->of(load); }), 0.0,
              1e-9);
}

TEST(LoadCosts, no_cost_is_negative) {
  std::vector<MeasuredLoad> measured = made({5.0, 30.0, 0.2, 0.0});
  for (MeasuredLoad& one : measured)
    if (one.load.bots > 0.0 && one.load.viewers > 0.0) one.ms_per_s *= 0.9;
  const auto found = fit_load_costs(measured);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->shown, 0.0);
  EXPECT_GT(found->onlooker, 0.1);
  EXPECT_GT(relative_error(measured, [&](const MachineLoad& load) { return found->of(load); }), 0.01);
}

TEST(LoadCosts, loads_that_are_all_alike_tell_nothing) {
  const std::vector<MeasuredLoad> alike(5, {{2.0, 10.0}, 70.0});
  EXPECT_FALSE(fit_load_costs(alike));
}

/// A simulation whose bots cost less the more there are, as carves get fewer pieces.
MachineModel model() {
  MachineModel model;
  model.simulation.loads = {{.bots = 10.0, .serial_ms_s = 40.0, .shared_ms_s = 160.0},
                            {.bots = 50.0, .serial_ms_s = 200.0, .shared_ms_s = 400.0}};
  model.simulation.idle_ms_s = 4.0;
  model.simulation.in_server = 1.5;
  model.simulation.bots_most = 80.0;
  model.others = {.idle = 6.0, .bot = 5.0, .onlooker = 0.5, .shown = 0.01};
  model.sizes = {.mib = 100.0, .mib_onlooker = 0.05, .kbit_s_shown = 30.0};
  return model;
}

TEST(MachineModel, the_simulations_cost_lies_between_what_was_measured) {
  const SimulationCosts& costs = model().simulation;
  EXPECT_NEAR(costs.at(0.0).ms_s(), 0.0, 1e-9);
  EXPECT_NEAR(costs.at(5.0).ms_s(), 100.0, 1e-9);
  EXPECT_NEAR(costs.at(30.0).serial_ms_s, 120.0, 1e-9);
  EXPECT_NEAR(costs.at(30.0).shared_ms_s, 280.0, 1e-9);
  EXPECT_NEAR(costs.at(70.0).ms_s(), 600.0, 1e-9) << "the budget is full";
}

TEST(MachineModel, by_noise_more_bots_do_not_take_less) {
  SimulationCosts costs = model().simulation;
  costs.loads.push_back({.bots = 60.0, .serial_ms_s = 150.0, .shared_ms_s = 390.0});
  EXPECT_NEAR(costs.at(55.0).ms_s(), 600.0, 1e-9);
  EXPECT_NEAR(costs.at(60.0).ms_s(), 600.0, 1e-9);
}

TEST(MachineModel, the_processors_are_the_first_limit_of_one_core) {
  const Held held = model().bots_held(0.0, {.cores = 1.0, .usable = 0.9});
  EXPECT_EQ(held.limit, MachineLimit::processors);
  EXPECT_NEAR(model().ms_s({held.most, 0.0}), 900.0, 1e-2);
  EXPECT_NEAR(model().ms_s({30.0, 0.0}), 4.0 + 1.5 * 400.0 + 6.0 + 30.0 * 5.5 + 0.01 * 900.0, 1e-9);
}

TEST(MachineModel, of_more_cores_the_simulation_itself_is) {
  const Held held = model().bots_held(0.0, {.cores = 4.0, .usable = 0.9});
  EXPECT_EQ(held.limit, MachineLimit::work);
  EXPECT_NEAR(held.most, 80.0, 1e-3);
}

TEST(MachineModel, a_thread_that_shares_only_its_bodies_can_be_the_limit) {
  MachineModel serial = model();
  serial.simulation.in_server = 4.0;
  EXPECT_NEAR(serial.simulation_thread_ms_s(50.0, 8.0), 4.0 + 4.0 * (200.0 + 50.0), 1e-9);
  const Held held = serial.bots_held(0.0, {.cores = 8.0, .usable = 0.9});
  EXPECT_EQ(held.limit, MachineLimit::simulation_thread);
  EXPECT_NEAR(serial.simulation_thread_ms_s(held.most, 8.0), 900.0, 1e-2);
}

TEST(MachineModel, bots_and_viewers_cost_what_they_cost_together) {
  const Held held = model().viewers_held(10.0, {.cores = 2.0});
  EXPECT_EQ(held.limit, MachineLimit::processors);
  EXPECT_NEAR(held.most, (2000.0 - 10.0 - 300.0 - 50.0) / (0.5 + 0.1) - 10.0, 1e-2);
  EXPECT_EQ(model().viewers_held(10.0, {.cores = 64.0, .mbit_s = 100.0}).limit, MachineLimit::bandwidth);
  EXPECT_EQ(model().viewers_held(10.0, {.cores = 64.0, .memory_mib = 200.0}).limit, MachineLimit::memory);
}

TEST(MachineModel, what_is_over_a_limit_already_holds_nobody_more) {
  EXPECT_EQ(model().viewers_held(100.0, {.cores = 1.0}).most, 0.0);
}

}  // namespace
}  // namespace scree
