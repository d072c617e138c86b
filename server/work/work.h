// The budget of a tick, and its estimated cost by a model: microseconds from counts of bodies, contacts,
// voxels and so on.
//
// When a tick's work nears its budget, requests wait, pieces merge sooner and fewer break. The simulation's
// state alone decides this, never a clock: the same commands must give the same hashes on every machine. The
// figures are those of an ordinary machine (server/work/limits.h); the bench storm compares them with the
// clock. TickDelta::work counts all work that was put off or left out.
#pragma once

#include "server/bodies/bodies.h"
#include "server/command/command.h"
#include "server/work/tick_work.h"
#include "shared/base/check.h"

namespace scree {

class WorkBudget {
 public:
  /// The tick rate must be positive. `percent` of a tick's length is the budget.
  WorkBudget(uint32_t tick_rate_hz, uint32_t percent);
  /// From the next tick on.
  void allow(uint32_t percent);

  /// Starts a tick with the estimated cost of the bodies' step, and pays back debt by the rest of the budget.
  void begin(const Bodies& bodies);
  /// Corrects that estimate after the step, in which the bodies made in this tick took part, too.
  void stepped(const Bodies& bodies);

  bool affords(float cost_us) const { return spent_us_ + cost_us <= budget_us_; }
  /// A cost is finite and not negative.
  void spend(float cost_us) {
    CHECK(cost_us >= 0.0F);
    spent_us_ += cost_us;
  }
  /// Spends a request's cost. The part beyond the budget becomes debt, up to limits::debt_budgets_max.
  void spend_on_request(float cost_us);
  float debt_us() const { return debt_us_; }
  /// Goes on with that debt, which is finite and not negative.
  void owe(float debt_us) {
    CHECK(debt_us >= 0.0F);
    debt_us_ = debt_us;
  }
  /// Whether earlier requests cost more than their ticks had: until that is paid back, requests wait.
  bool in_debt() const { return debt_us_ > 0.0F; }
  float left_us() const { return budget_us_ - spent_us_; }
  /// Whether the tick's work takes a whole tick already, by the model: what may wait then waits.
  bool is_late() const { return spent_us_ > tick_us_; }
  float spent_us() const { return spent_us_; }
  float budget_us() const { return budget_us_; }
  /// Estimated cost of the bodies' step as a share of the budget.
  float bodies_load() const { return bodies_us_ / budget_us_; }
  /// Whether the bodies alone take more than limits::crowded_share of the budget.
  bool crowded() const;

  /// Enters budget and estimate.
  void report(TickWork& work) const;

 private:
  float tick_us_;
  float budget_us_ = 0.0F;
  float spent_us_ = 0.0F;
  float bodies_us_ = 0.0F;
  BodyCounts counts_;
  float debt_us_ = 0.0F;
};

}  // namespace scree
