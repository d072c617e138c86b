// The bot on foot.
#include <algorithm>
#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "client/bot/bot.h"
#include "client/bot/limits.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr auto ask_again = std::chrono::seconds(1);
/// Its numbers are not those of carves.
constexpr uint32_t stand_request = 1U << 30U;

}  // namespace

/// One input for each tick that has passed.
void Bot::walk(Clock::time_point now) {
  if (first_frame_ == 0 || !client_.rejoin().has_near_ground() || !client_.loaded(steady_now_s())) return;
  const uint32_t rate_hz = report_.welcome.tick_rate_hz;
  if (!walk_) walk_.emplace(config_.walks, rate_hz, config_.random_seed, config_.walk_square);
  if (!foot_) {
    foot_.emplace(rate_hz);
    asked_to_stand_ = {};
  }
  const Mirror& mirror = *client_.mirror();
  const uint64_t before = foot_->corrections().count;
  foot_->follow(mirror);
  WalkReport& walks = report_.walks;
  walks.corrections += foot_->corrections().count - before;
  walks.correction_worst_m = std::max(walks.correction_worst_m, foot_->corrections().worst_m);
  if (!foot_->on_foot()) {
    if (now - asked_to_stand_ >= ask_again) client_.send(StandMessage{{}, stand_request});
    if (now - asked_to_stand_ >= ask_again) asked_to_stand_ = now;
    walked_to_ = now;
    return;
  }
  SolidGround ground = ground_of(mirror, mirror.own_person()->walker.feet_m);
  walks.depth_worst_m =
      std::max(walks.depth_worst_m, Walker::depth_m(mirror.own_person()->walker.feet_m, ground));
  const auto tick = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(1.0 / rate_hz));
  const auto behind_max =
      std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(limits::bot_walk_behind_s));
  walked_to_ = std::max(walked_to_, now - behind_max);
  for (; walked_to_ + tick <= now && !walk_->is_over(); walked_to_ += tick) {
    const WalkInput input = walk_->next(foot_->walker().feet_m());
    const float length = glm::length(input.go);
    const glm::vec3 look = length > 0.0F ? input.go / length : glm::vec3(0.0F, 0.0F, -1.0F);
    const auto message = foot_->step(input, look, mirror);
    if (!message) continue;
    client_.send(*message);
    ++walks.inputs;
    walks.seconds += 1.0 / rate_hz;
  }
  walks.done = walk_->done();
  const glm::vec3 eye_m = foot_->walker().eye_m();
  if (glm::distance(eye_m, eye_m_) > limits::bot_follow_m) set_interest(eye_m, config_.interest_radius_m);
}

}  // namespace scree
