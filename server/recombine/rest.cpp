#include "server/recombine/rest.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <tuple>

#include "shared/base/check.h"

namespace scree {

namespace {

/// Upper bound of the distance that any point of a piece moved between two poses.
float strayed_m(const Pose& from, const Pose& to, float reach_m) {
  const glm::vec3 moved = to.position_m - from.position_m;
  const float half_cosine = std::min(std::abs(glm::dot(from.rotation, to.rotation)), 1.0F);
  const float half_sine = std::sqrt(1.0F - half_cosine * half_cosine);
  return std::sqrt(glm::dot(moved, moved)) + 2.0F * reach_m * half_sine;
}

/// A piece at rest, on a support or not.
struct Resting {
  PieceId id = 0;
  float height_m = 0.0F;
  uint32_t layer = 0;  ///< 1: on terrain; n + 1: on a piece of layer n; 0: no support found yet
};

/// A support between two pieces at rest, as indices.
struct Pair {
  size_t upper;
  size_t lower;
};

std::vector<Pair> pairs_at_rest(const std::vector<Resting>& resting, std::span<const RestSupport> supports) {
  std::vector<Pair> pairs;
  const auto find = [&](PieceId id) {
    const auto found = std::ranges::lower_bound(resting, id, {}, &Resting::id);
    return found != resting.end() && found->id == id ? static_cast<size_t>(found - resting.begin())
                                                     : resting.size();
  };
  for (const RestSupport& support : supports) {
    const Pair pair{find(support.upper), find(support.lower)};
    if (pair.upper < resting.size() && pair.lower < resting.size() && resting[pair.upper].layer == 0)
      pairs.push_back(pair);
  }
  return pairs;
}

/// Raises the layers from the ground up, until nothing changes. `resting` is ordered by id.
void stack(std::vector<Resting>& resting, std::span<const RestSupport> supports) {
  const std::vector<Pair> pairs = pairs_at_rest(resting, supports);
  bool raised = true;
  for (uint32_t layer = 1; raised; ++layer) {
    raised = false;
    for (const Pair& pair : pairs) {
      Resting& upper = resting[pair.upper];
      if (upper.layer != 0 || resting[pair.lower].layer != layer) continue;
      upper.layer = layer + 1;
      raised = true;
    }
  }
}

/// To the nearest tick, and one at least.
uint32_t ticks_of(float seconds, uint32_t tick_rate_hz) {
  return std::max(1U, static_cast<uint32_t>(seconds * static_cast<float>(tick_rate_hz) + 0.5F));
}

}  // namespace

RestDetector::RestDetector(const RestConfig& config, uint32_t tick_rate_hz)
    : config_(config),
      rest_ticks_(ticks_of(config.rest_s, tick_rate_hz)),
      patience_ticks_(ticks_of(config.patience_s, tick_rate_hz)),
      contact_ticks_(ticks_of(config.contact_s, tick_rate_hz)),
      stuck_ticks_(ticks_of(config.stuck_s, tick_rate_hz)),
      leash_growth_m_tick_(config.leash_growth_m_s / static_cast<float>(tick_rate_hz)),
      tick_s_(1.0F / static_cast<float>(tick_rate_hz)) {
  CHECK(tick_rate_hz > 0);
  CHECK(config.leash_m > 0.0F && config.leash_m <= config.leash_max_m && config.leash_growth_m_s >= 0.0F);
}

bool RestDetector::gathers_speed(const Timer& timer, const RestPiece& piece) const {
  const glm::vec3 moved_m = piece.pose.position_m - timer.anchor.position_m;
  const float speed2 = glm::dot(piece.velocity_m_s, piece.velocity_m_s);
  if (speed2 <= config_.gathers_m_s * config_.gathers_m_s) return false;
  const float still_s = static_cast<float>(timer.still_ticks) * tick_s_;
  return glm::dot(piece.velocity_m_s, moved_m) * still_s > config_.gathers_share * glm::dot(moved_m, moved_m);
}

bool RestDetector::advance_timer(const RestPiece& piece, bool on_terrain, uint32_t rest_ticks) {
  const auto [found, is_new] = timers_.try_emplace(piece.id);
  Timer& timer = found->second;
  ++timer.age_ticks;
  if (on_terrain)
    timer.terrain_ticks = 1;
  else if (timer.terrain_ticks > 0 && timer.terrain_ticks <= contact_ticks_)
    ++timer.terrain_ticks;
  const auto impatient = static_cast<float>(timer.age_ticks - std::min(timer.age_ticks, patience_ticks_));
  const float leash_m = std::min(config_.leash_m + leash_growth_m_tick_ * impatient, config_.leash_max_m);
  const bool is_stuck = timer.age_ticks > stuck_ticks_;
  const float stuck_s = is_stuck ? static_cast<float>(timer.age_ticks - stuck_ticks_) * tick_s_ : 0.0F;
  const bool is_calm = piece.speed_m_s <= config_.calm_m_s + config_.stuck_growth_m_s2 * stuck_s;
  if (is_new || !(strayed_m(timer.anchor, piece.pose, piece.reach_m) <= leash_m)) {
    timer.anchor = piece.pose;
    timer.still_ticks = 0;
  } else if (is_calm) {
    ++timer.still_ticks;
  } else {
    timer.still_ticks -= std::min(timer.still_ticks, 2U);
  }
  return is_calm && timer.still_ticks >= rest_ticks && (is_stuck || !gathers_speed(timer, piece));
}

std::vector<PieceId> RestDetector::update(std::span<const RestPiece> pieces,
                                          std::span<const PieceId> on_terrain,
                                          std::span<const RestSupport> supports, size_t merges_max,
                                          bool hurried) {
  CHECK_DEBUG(std::ranges::adjacent_find(pieces, std::ranges::greater_equal{}, &RestPiece::id) ==
              pieces.end());
  CHECK_DEBUG(std::ranges::is_sorted(on_terrain));
  const uint32_t rest_ticks = hurried ? (rest_ticks_ + 1) / 2 : rest_ticks_;
  std::vector<Resting> resting;
  auto known = timers_.begin();
  for (const RestPiece& piece : pieces) {
    while (known != timers_.end() && known->first < piece.id) known = timers_.erase(known);
    if (known != timers_.end() && known->first == piece.id) ++known;
    const bool touching = std::ranges::binary_search(on_terrain, piece.id);
    if (!advance_timer(piece, touching, rest_ticks)) continue;
    const uint32_t touched = timers_.find(piece.id)->second.terrain_ticks;
    const bool grounded = touched > 0 && touched <= contact_ticks_;
    resting.push_back({piece.id, piece.pose.position_m.y, grounded ? 1U : 0U});
  }
  timers_.erase(known, timers_.end());
  at_rest_ = resting.size();
  CHECK_EQ(timers_.size(), pieces.size());

  stack(resting, supports);
  std::erase_if(resting, [](const Resting& piece) { return piece.layer == 0; });
  std::ranges::sort(resting, {}, [](const Resting& r) { return std::tuple(r.layer, r.height_m, r.id); });
  put_off_ = resting.size() - std::min(resting.size(), merges_max);
  resting.resize(resting.size() - put_off_);
  std::vector<PieceId> ready;
  layers_.clear();
  for (const Resting& piece : resting) {
    ready.push_back(piece.id);
    layers_.push_back(piece.layer);
  }
  CHECK(ready.size() <= merges_max && ready.size() + put_off_ <= at_rest_);
  return ready;
}

RestValue RestDetector::value() const {
  RestValue value;
  value.put_off = put_off_;
  for (const auto& [id, timer] : timers_) {
    const glm::quat& q = timer.anchor.rotation;
    value.timers.push_back({id,
                            timer.anchor.position_m,
                            {q.w, q.x, q.y, q.z},
                            timer.age_ticks,
                            timer.still_ticks,
                            timer.terrain_ticks});
  }
  return value;
}

void RestDetector::restore(const RestValue& value) {
  put_off_ = static_cast<size_t>(value.put_off);
  timers_.clear();
  for (const StillnessTimer& timer : value.timers) {
    const auto& [w, x, y, z] = timer.anchor_rotation;
    timers_[timer.id] = {
        {timer.anchor_m, glm::quat(w, x, y, z)}, timer.age_ticks, timer.still_ticks, timer.terrain_ticks};
  }
}

}  // namespace scree
