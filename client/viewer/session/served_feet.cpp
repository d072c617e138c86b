#include "client/viewer/session/served_feet.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "client/viewer/session/on_foot.h"
#include "shared/base/check.h"

namespace scree {
namespace {

constexpr double ask_again_s = 1.0;
/// A longer frame is shortened: after a stall, nobody has walked on. Slow machines draw three frames a
/// second.
constexpr float frame_max_s = 0.5F;

}  // namespace

void ServedFeet::change(ViewerSession& session, double now_s) {
  walks_ = !walks_;
  asked_s_ = now_s;
  time_left_s_ = 0.0F;
  session.stand(!walks_);
}

void ServedFeet::step(Camera& camera, const FlyInput& input, float elapsed_s, ViewerSession& session,
                      double now_s) {
  CHECK(walks());
  turn_by(camera, input, elapsed_s);
  WalkPrediction* const foreseen = session.foreseen_walk();
  if (foreseen == nullptr || !foreseen->on_foot()) {
    if (now_s - asked_s_ < ask_again_s || !session.connected()) return;
    asked_s_ = now_s;
    return session.stand(false);
  }
  const auto tick_s = static_cast<float>(1.0 / session.tick_rate_hz());
  const bool stood = foreseen->walker().stands();
  const WalkInput walk = walk_input_of(camera, input);
  for (time_left_s_ += std::min(elapsed_s, frame_max_s); time_left_s_ >= tick_s; time_left_s_ -= tick_s) {
    before_m_ = foreseen->walker().eye_m();
    session.walk(walk, camera.forward());
  }
  const glm::vec3 now_m = foreseen->walker().eye_m();
  constexpr float jump_m = 2.0F;  // farther, the server has put the person elsewhere
  const bool is_far = glm::length(now_m - before_m_) > jump_m;
  const glm::vec3 eye_m =
      is_far ? now_m : glm::mix(before_m_, now_m, std::clamp(time_left_s_ / tick_s, 0.0F, 1.0F));
  const bool steps =
      stood && foreseen->walker().stands() && std::abs(eye_m.y - camera.eye_m.y) < 2.0F * Walker::step_m;
  carry(camera, eye_m, steps, elapsed_s);
}

}  // namespace scree
