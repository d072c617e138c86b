// What a tick may cost, and what it does cost, by a model: microseconds from counts of what there is to do.
//
// When a tick's work nears its budget, requests wait, pieces merge sooner and fewer break. What decides is
// the simulation's state alone and never a clock, or the same commands would give other hashes on another
// machine. The price is that the model knows an ordinary machine (server/world/limits.h has its figures, the
// bench storm holds them against the clock). Everything put off or left out is counted in TickDelta::work.
#pragma once

#include "server/bodies/bodies.h"
#include "server/world/command.h"
#include "server/world/tick_delta.h"

namespace scree {

class WorkBudget {
 public:
  explicit WorkBudget(uint32_t tick_rate_hz);

  /// A new tick, with what the bodies will take as they now are.
  void begin(const Bodies& bodies);
  /// What the step took is known better afterwards: newborn bodies took part.
  void stepped(const Bodies& bodies);

  bool affords(float cost_us) const { return spent_us_ + cost_us <= budget_us_; }
  void spend(float cost_us) { spent_us_ += cost_us; }
  float left_us() const { return budget_us_ - spent_us_; }
  /// Whether the bodies alone take so much that they should become fewer soon.
  bool crowded() const;

  /// Enters budget and estimate.
  void report(TickWork& work) const;

 private:
  float budget_us_;
  float spent_us_ = 0.0F;
  float bodies_us_ = 0.0F;
};

/// What carrying it out will take.
float cost_us(const Command& command, float voxel_size_m);

}  // namespace scree
