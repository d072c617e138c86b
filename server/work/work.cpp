#include "server/work/work.h"

#include <algorithm>

#include "server/work/limits.h"

namespace scree {

namespace {

BodyCounts counts_of(const Bodies& bodies) {
  return {bodies.size(),  bodies.awake(),    bodies.ground_points(), bodies.contact_points(),
          bodies.pairs(), bodies.overlaps(), bodies.steps_a_tick(),  bodies.awake_joints()};
}

float cost_of(const BodyCounts& bodies) {
  const float a_step = limits::body_cost_us * static_cast<float>(bodies.awake) +
                       limits::ground_point_cost_us * static_cast<float>(bodies.ground_points) +
                       limits::contact_cost_us * static_cast<float>(bodies.contact_points) +
                       limits::pair_cost_us * static_cast<float>(bodies.pairs) +
                       limits::overlap_cost_us * static_cast<float>(bodies.overlaps) +
                       limits::joint_cost_us * static_cast<float>(bodies.joints);
  return a_step * static_cast<float>(bodies.steps);
}

}  // namespace

WorkBudget::WorkBudget(uint32_t tick_rate_hz, uint32_t percent)
    : tick_us_(1e6F / static_cast<float>(tick_rate_hz)) {
  CHECK(tick_rate_hz > 0);
  allow(percent);
}

void WorkBudget::allow(uint32_t percent) {
  CHECK(percent >= limits::work_percent_min && percent <= limits::work_percent_max);
  budget_us_ = 0.01F * static_cast<float>(percent) * tick_us_;
}

void WorkBudget::begin(const Bodies& bodies) {
  counts_ = counts_of(bodies);
  bodies_us_ = cost_of(counts_);
  spent_us_ = bodies_us_ + limits::piece_cost_us * static_cast<float>(counts_.pieces);
  const float payback_us = std::max(left_us(), limits::payback_share * budget_us_);
  debt_us_ = std::max(debt_us_ - payback_us, 0.0F);
}

void WorkBudget::spend_on_request(float cost_us) {
  const float beyond_us = cost_us - std::max(left_us(), 0.0F);
  spend(cost_us);
  debt_us_ =
      std::clamp(debt_us_ + beyond_us, debt_us_, std::max(debt_us_, limits::debt_budgets_max * budget_us_));
}

void WorkBudget::stepped(const Bodies& bodies) {
  const float before_us = bodies_us_;
  counts_ = counts_of(bodies);
  bodies_us_ = cost_of(counts_);
  spent_us_ += bodies_us_ - before_us;
  CHECK(spent_us_ >= 0.0F);
}

bool WorkBudget::crowded() const {
  return bodies_us_ > limits::crowded_share * budget_us_;
}

void WorkBudget::report(TickWork& work) const {
  work.budget_us = static_cast<uint32_t>(budget_us_);
  work.estimate_us = static_cast<uint32_t>(spent_us_);
  work.bodies = counts_;
}

}  // namespace scree
