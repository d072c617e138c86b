// The budget of a tick, and its estimated cost by a model: microseconds from counts of bodies, contacts,
// voxels and so on.
//
// When a tick's work nears its budget, requests wait, pieces merge sooner and fewer break. The simulation's
// state alone decides this, never a clock: the same commands must give the same hashes on every machine. The
// figures are those of an ordinary machine (server/world/limits.h); the bench storm compares them with the
// clock. TickDelta::work counts all work that was put off or left out.
#pragma once

#include "server/bodies/bodies.h"
#include "server/world/command.h"
#include "server/world/tick_delta.h"
#include "shared/base/check.h"

namespace scree {

class WorkBudget {
 public:
  /// The tick rate must be positive.
  explicit WorkBudget(uint32_t tick_rate_hz);

  /// Starts a tick with the estimated cost of the bodies' step.
  void begin(const Bodies& bodies);
  /// Corrects that estimate after the step, in which the bodies made in this tick took part, too.
  void stepped(const Bodies& bodies);

  bool affords(float cost_us) const { return spent_us_ + cost_us <= budget_us_; }
  /// A cost is finite and not negative.
  void spend(float cost_us) {
    CHECK(cost_us >= 0.0F);
    spent_us_ += cost_us;
  }
  float left_us() const { return budget_us_ - spent_us_; }
  /// Whether the bodies alone take more than limits::crowded_share of the budget.
  bool crowded() const;

  /// Enters budget and estimate.
  void report(TickWork& work) const;

 private:
  float budget_us_;
  float spent_us_ = 0.0F;
  float bodies_us_ = 0.0F;
};

/// Estimated cost of carrying out the command; 0 for a shape that will be refused.
float cost_us(const Command& command, float voxel_size_m);

}  // namespace scree
