#include "server/publish/motions.h"

#include <algorithm>
#include <map>

#include "proto/motion_codec.h"
#include "shared/base/check.h"
#include "shared/operation/operation.h"

namespace scree {

namespace {

/// Steps without a change after which a piece rests.
constexpr uint32_t still_steps_min = 2;

int64_t square(glm::ivec3 v) {
  return int64_t{v.x} * v.x + int64_t{v.y} * v.y + int64_t{v.z} * v.z;
}

/// Square of the largest error that needs no correction: a little more than rounding to steps leaves at
/// worst.
int64_t bearable(int32_t step) {
  return int64_t{step} * step * 77 / 100;
}

glm::ivec3 difference(glm::ivec3 to, glm::ivec3 from) {
  // Saturated like the positions themselves, so that squares fit.
  const auto axis = [](int64_t n) {
    return static_cast<int32_t>(std::clamp<int64_t>(n, -(1 << 30), 1 << 30));
  };
  return {axis(int64_t{to.x} - from.x), axis(int64_t{to.y} - from.y), axis(int64_t{to.z} - from.z)};
}

/// An error in steps: rounded, then less on each axis where the rest stays bearable, for small numbers are
/// cheap.
glm::ivec3 in_steps(glm::ivec3 error, int32_t step) {
  if (square(error) <= bearable(step)) return {};
  glm::ivec3 steps;
  for (int axis = 0; axis < 3; ++axis)
    steps[axis] = (error[axis] + (error[axis] < 0 ? -step / 2 : step / 2)) / step;
  for (int round = 0; round < 3; ++round) {
    int best = -1;
    int64_t least = bearable(step);
    for (int axis = 0; axis < 3; ++axis) {
      if (steps[axis] == 0) continue;
      glm::ivec3 fewer = steps;
      fewer[axis] -= steps[axis] > 0 ? 1 : -1;
      const int64_t rest = square(error - fewer * step);
      if (rest > least) continue;
      least = rest;
      best = axis;
    }
    if (best < 0) break;
    steps[best] -= steps[best] > 0 ? 1 : -1;
  }
  return steps;
}

struct Miss {
  glm::ivec3 position{0};
  glm::ivec3 rotation{0};
};

Miss miss_of(const Motion& motion, MotionMode mode, const MotionTarget& target, const MotionRules& rules) {
  const Motion predicted = predict(motion, mode, rules);
  return {difference(target.at.position, predicted.position),
          turn_between(predicted.rotation, target.at.rotation)};
}

Correction corrected(const Miss& miss, MotionMode mode, const MotionRules& rules) {
  return {mode, in_steps(miss.position, position_step(mode, rules)),
          in_steps(miss.rotation, rotation_step(mode, rules))};
}

}  // namespace

std::optional<Correction> correction_of(const Motion& motion, const MotionTarget& target,
                                        const MotionRules& rules) {
  const bool rests = motion.mode == MotionMode::rest;
  if (!rests && target.still_steps >= still_steps_min) {
    const Miss miss = miss_of(motion, MotionMode::rest, target, rules);
    return corrected(miss, MotionMode::rest, rules);
  }
  const Miss miss = miss_of(motion, motion.mode, target, rules);
  const int64_t off = square(miss.position);
  const bool is_near = off <= bearable(position_step(motion.mode, rules));
  if (is_near && square(miss.rotation) <= bearable(rotation_step(motion.mode, rules))) return std::nullopt;
  if (rests) {
    // It woke, unless it crept here over many steps.
    const bool woke = is_near ? target.still_steps == 0 : 10 * square(target.moved) >= 3 * off;
    return corrected(miss, woke ? MotionMode::slide : MotionMode::rest, rules);
  }
  if (!is_near) {
    const MotionMode other = motion.mode == MotionMode::fall ? MotionMode::slide : MotionMode::fall;
    const Miss other_miss = miss_of(motion, other, target, rules);
    if (square(other_miss.position) < off) return corrected(other_miss, other, rules);
  }
  return corrected(miss, motion.mode, rules);
}

TrackedMotion* Motions::find(PieceId id) {
  const auto found = std::ranges::lower_bound(pieces_, id, {}, &TrackedMotion::id);
  return found != pieces_.end() && found->id == id ? &*found : nullptr;
}

/// As KnownMotions::add_made does for a client.
void Motions::make(PieceId id, glm::vec3 centre_m, std::optional<PieceId> parent, Tick tick) {
  TrackedMotion made;
  made.id = id;
  made.centre_m = centre_m;
  made.changed = tick;
  const TrackedMotion* from = parent ? find(*parent) : nullptr;
  made.motion =
      from != nullptr ? born_of(from->motion, made.centre_m - from->centre_m) : born_at(made.centre_m);
  made.before = made.motion;
  made.check = motion_check(id, made.motion);
  const auto after = std::ranges::lower_bound(pieces_, id, {}, &TrackedMotion::id);
  if (after == pieces_.end() || after->id != id) pieces_.insert(after, made);
}

void Motions::advance(TrackedMotion& piece, Tick tick) const {
  piece.before = piece.motion;
  piece.before_check = piece.check;
  if (piece.motion.mode == MotionMode::rest && piece.target.still_steps > 0 && !piece.correction)
    return;  // nothing has changed since it was near enough
  piece.correction = correction_of(piece.motion, piece.target, rules_);
  if (!piece.correction && piece.motion.mode == MotionMode::rest) return;
  piece.changed = tick;
  piece.motion = scree::advance(piece.motion, piece.correction, rules_);
  piece.check = motion_check(piece.id, piece.motion);
}

void Motions::follow(TrackedMotion& one, const QuantisedPose& pose, bool step, Tick tick) const {
  one.place_m = glm::vec3(pose.x, pose.y, pose.z) / pose_steps_per_m;
  if (!step) return;
  MotionTarget& target = one.target;
  const uint32_t steps = target.steps + 1;
  if (target.pose == pose && target.still_steps > 0) {
    ++target.still_steps;
    target.moved = {};
  } else {
    const MotionTarget last = target;
    target = {pose, resting_at(pose), {}, last.pose == pose ? last.still_steps + 1 : 0};
    target.moved = difference(target.at.position, last.at.position);
  }
  target.steps = steps;
  advance(one, tick);
}

void Motions::track(const TickDelta& delta, const PublishedState& state, bool step) {
  std::map<PieceId, glm::vec3> spawned_m;  // the volumes' centres
  for (const SpawnedPiece& piece : delta.spawned)
    spawned_m.emplace(piece.id, piece.volume->centre_voxels * voxel_size_m_);
  for (const AppliedOperation& applied : delta.operations) {
    const std::optional<PieceId> parent = parent_of(applied.operation);
    for (const PieceId id : applied.created)
      if (const auto found = spawned_m.find(id); found != spawned_m.end())
        make(id, found->second, parent, delta.tick);
  }
  // A keyframe has pieces that no operation made, and no operation makes props.
  for (const SpawnedProp& prop : delta.props_spawned) spawned_m.emplace(prop.id, glm::vec3(0.0F));
  for (const auto& [id, centre_m] : spawned_m)
    if (find(id) == nullptr) make(id, centre_m, std::nullopt, delta.tick);

  auto piece = state.pieces().begin();
  auto prop = state.props().begin();
  for (TrackedMotion& one : pieces_) {
    while (piece != state.pieces().end() && piece->first < one.id) ++piece;
    while (prop != state.props().end() && prop->first < one.id) ++prop;
    const bool is_piece = piece != state.pieces().end() && piece->first == one.id;
    one.alive = is_piece || (prop != state.props().end() && prop->first == one.id);
    if (one.alive) follow(one, is_piece ? piece->second.pose : prop->second.pose, step, delta.tick);
  }
  std::erase_if(pieces_, [](const TrackedMotion& one) { return !one.alive; });
  CHECK_EQ(pieces_.size(), state.pieces().size() + state.props().size());
  if (!step) return;
  stepped_before_ = stepped_;
  stepped_ = delta.tick;
}

}  // namespace scree
