#include "studies/paper/plan.h"

namespace scree::paper {

Plan plan_of(bool quick, bool software) {
  Plan plan{.grid_cells = {32, 64, 96, 128, 192, 256}, .percents = {10, 20, 30, 40, 50, 60, 70, 80, 90, 100}};
  if (software) {
    plan.session_percent = 30;
    plan.setting_ticks_a_frame = 30;
    plan.ticks_a_frame = 4;
    plan.rebuild_ticks_a_frame = 5;
  }
  if (!quick) return plan;
  plan.grid_cells = {32, 64};
  plan.percents = {25, 50};
  plan.rounds = 1;
  plan.setting_ticks = 120;
  plan.setting_ticks_a_frame = 30;
  plan.session_seconds_scale = 0.25;
  plan.carves = 12;
  plan.ticks_a_frame = 6;
  plan.rebuild_runs = 1;
  plan.rebuild_carves = 6;
  plan.blast_seeds = 8;
  return plan;
}

}  // namespace scree::paper
