#include "client/session/walk_prediction.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "client/session/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// So that their refusals are not taken for those of other requests, which are numbered from one.
constexpr uint32_t first_number = 1U << 31U;
constexpr float corrected_m = 1e-3F;
/// Ground that was looked for about a place holds for steps so near.
constexpr float same_ground_m = 2.0F;

}  // namespace

SolidGround ground_of(const Mirror& mirror, glm::vec3 about_m) {
  SolidGround ground(mirror.field(), about_m);
  for (const auto& [id, motion] : mirror.pieces()) ground.add(*motion.volume, motion.to);
  for (const auto& [id, motion] : mirror.props())
    if (!mirror.persons().contains(id)) ground.add(*motion.prop, motion.to);
  return ground;
}

bool persons_walk(const std::optional<StatusMessage>& status) {
  return status &&
         std::ranges::find(status->settings, SettingValue{"persons", "walk"}) != status->settings.end();
}

WalkPrediction::WalkPrediction(uint32_t tick_rate_hz)
    : tick_s_(1.0F / static_cast<float>(tick_rate_hz)),
      untaken_max_(static_cast<size_t>(limits::walk_untaken_max_s * static_cast<double>(tick_rate_hz))) {
  CHECK(tick_rate_hz > 0);
}

/// Drops the inputs that were taken.
bool WalkPrediction::was_foreseen(const OwnPerson& told) {
  std::optional<WalkerState> foreseen;
  while (!untaken_.empty() && untaken_.front().number <= told.taken) {
    if (untaken_.front().number == told.taken) foreseen = untaken_.front().after;
    untaken_.pop_front();
  }
  return foreseen == told.walker;
}

void WalkPrediction::carry_out_again(const Mirror& mirror) {
  walker_ = Walker(told_->walker);
  glm::vec3 about_m = walker_.feet_m();
  std::optional<SolidGround> ground;
  for (Untaken& one : untaken_) {
    if (!ground || glm::distance(about_m, walker_.feet_m()) > same_ground_m) {
      about_m = walker_.feet_m();
      ground.emplace(ground_of(mirror, about_m));
    }
    walker_.step(one.input, tick_s_, *ground);
    one.after = walker_.state();
  }
}

void WalkPrediction::follow(const Mirror& mirror) {
  const std::optional<OwnPerson>& told = mirror.own_person();
  if (!told) {
    told_.reset();
    untaken_.clear();
    return;
  }
  if (told_ == told) return;
  const bool begins = !told_.has_value();
  told_ = told;
  if (begins) last_ = std::max(told->taken, first_number);
  if (was_foreseen(*told) && !begins) return;
  const glm::vec3 before_m = walker_.feet_m();
  carry_out_again(mirror);
  const float off_m = glm::distance(before_m, walker_.feet_m());
  if (begins || !(off_m > corrected_m)) return;
  ++corrections_.count;
  corrections_.sum_m += static_cast<double>(off_m);
  corrections_.worst_m = std::max(corrections_.worst_m, off_m);
}

std::optional<WalkMessage> WalkPrediction::step(const WalkInput& input, glm::vec3 look,
                                                const Mirror& mirror) {
  CHECK(on_foot());
  if (untaken_.size() >= untaken_max_) return std::nullopt;
  WalkMessage message;
  message.request = ++last_;
  message.input = input;
  // Zeroes have no sign on the wire.
  message.input.go = glm::vec3(input.go.x, 0.0F, input.go.z) + 0.0F;
  message.look = look;
  SolidGround ground = ground_of(mirror, walker_.feet_m());
  walker_.step(message.input, tick_s_, ground);
  untaken_.push_back({message.request, message.input, walker_.state()});
  ++corrections_.inputs;
  return message;
}

}  // namespace scree
