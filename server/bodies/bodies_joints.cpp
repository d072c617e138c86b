// Joints between bodies: how they are added, change, break and end.
#include <algorithm>
#include <utility>

#include "server/bodies/bodies_state.h"
#include "server/bodies/motion_checks.h"
#include "server/bodies/to_bullet.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Joints are given in the frames of pieces and props; Bullet's bodies are in their principal axes, about the
/// centre of mass.
HeldFrame held_frame(const JointSide& side, std::map<PieceId, Body>& bodies) {
  const auto axes_of = [](const glm::quat& turn) {
    return btMatrix3x3(btQuaternion(turn.x, turn.y, turn.z, turn.w));
  };
  if (side.holds_terrain()) return {nullptr, to_bullet(side.place_m), axes_of(side.turn)};
  Body& body = bodies.at(side.body);
  const glm::quat back = glm::conjugate(body.axes);
  return {body.rigid.get(), to_bullet(back * (side.place_m - body.given->centre_m)),
          axes_of(back * side.turn), body.spin_max_rad_s};
}

}  // namespace

void Bodies::State::enter_joint(JointId id, const Joint& joint) {
  JointRows rows(id, joint, held_frame(joint.a, bodies), held_frame(joint.b, bodies));
  const auto [added, is_new] = joints.try_emplace(id, std::move(rows));
  CHECK(is_new);
  for (const PieceId body : {joint.a.body, joint.b.body})
    if (body != 0) joints_of[body].insert(id);
  keep_apart(added->second, true);
  joints_listed = false;
}

void Bodies::State::end_joint(JointId id) {
  const auto found = joints.find(id);
  CHECK(found != joints.end());
  const Joint joint = found->second.joint();
  keep_apart(found->second, false);
  joints.erase(found);
  for (const PieceId body : {joint.a.body, joint.b.body}) {
    if (body == 0) continue;
    std::set<JointId>& others = joints_of.at(body);
    others.erase(id);
    if (others.empty()) joints_of.erase(body);
    wake(bodies.at(body));
  }
  joints_listed = false;
}

void Bodies::State::list_joints() {
  if (std::exchange(joints_listed, true)) return;
  std::vector<JointRows*> all;
  for (auto& [id, joint] : joints) all.push_back(&joint);
  dynamics.set_joints(std::move(all));
}

/// Bullet counts: two bodies that several joints keep apart meet again when the last of these has ended.
/// Contacts that they have already would stay, so their pair begins anew.
void Bodies::State::keep_apart(JointRows& joint, bool apart) {
  btRigidBody *const a = joint.body_a(), *const b = joint.body_b();
  if (joint.joint().touches || a == nullptr || b == nullptr) return;
  a->setIgnoreCollisionCheck(b, apart);
  b->setIgnoreCollisionCheck(a, apart);
  if (a->getBroadphaseHandle() == nullptr || b->getBroadphaseHandle() == nullptr) return;
  btOverlappingPairCache& pairs = *broadphase.getOverlappingPairCache();
  btBroadphasePair* const pair = pairs.findPair(a->getBroadphaseHandle(), b->getBroadphaseHandle());
  if (pair != nullptr) pairs.cleanOverlappingPair(*pair, &dispatcher);
}

void Bodies::State::leave_joints(PieceId body) {
  const auto of_body = joints_of.find(body);
  if (of_body == joints_of.end()) return;
  for (const JointId id : of_body->second) keep_apart(joints.at(id), false);
}

void Bodies::State::enter_joints(PieceId body) {
  const auto of_body = joints_of.find(body);
  if (of_body == joints_of.end()) return;
  for (const JointId id : of_body->second) {
    JointRows& joint = joints.at(id);
    joint.replace(body, bodies.at(body).rigid.get());
    keep_apart(joint, true);
    for (const PieceId held : {joint.joint().a.body, joint.joint().b.body})
      if (held != 0) wake(bodies.at(held));
  }
}

void Bodies::State::break_joints() {
  std::vector<JointId> broken;
  for (const auto& [id, joint] : joints)
    if (joint.breaks()) broken.push_back(id);
  for (const JointId id : broken) {
    ended.push_back({id, JointEnd::broken});
    end_joint(id);
  }
}

// Passes in both directions, until none changes anything: chains are mostly in the order of their joints'
// ids.
void Bodies::State::stop_together() {
  const auto hulls_of_mover = [](const btRigidBody* body) -> const CollisionHulls* {
    if (body == nullptr || body->isStaticOrKinematicObject()) return nullptr;
    return static_cast<const CollisionHulls*>(body->getUserPointer());
  };
  bool changed = true;
  const auto join = [&](const JointRows& joint) {
    const CollisionHulls *const a = hulls_of_mover(joint.body_a()), *const b = hulls_of_mover(joint.body_b());
    if (a == nullptr || b == nullptr || a->step_share() == b->step_share()) return;
    const float least = std::min(a->step_share(), b->step_share());
    a->stop_at(least);
    b->stop_at(least);
    changed = true;
  };
  while (std::exchange(changed, false)) {
    for (auto joint = joints.begin(); joint != joints.end(); ++joint) join(joint->second);
    for (auto joint = joints.rbegin(); joint != joints.rend(); ++joint) join(joint->second);
  }
}

Result<void> Bodies::State::restore_joints(std::span<const KnownJoint> known) {
  for (const auto& [id, joint] : known) {
    const auto is_there = [&](const JointSide& side) {
      return side.holds_terrain() || bodies.contains(side.body);
    };
    if (const Result<void> valid = validate(joint); !valid)
      return fail("joint " + std::to_string(id) + ": " + valid.error().message);
    if (joints.contains(id) || !is_there(joint.a) || !is_there(joint.b))
      return fail("joint " + std::to_string(id) + " comes twice, or holds a body that is not there");
    enter_joint(id, joint);
  }
  return {};
}

void Bodies::add_joint(JointId id, const Joint& joint) {
  State& s = *state_;
  CHECK(validate(joint).has_value());
  CHECK(joint.a.holds_terrain() || contains(joint.a.body));
  CHECK(joint.b.holds_terrain() || contains(joint.b.body));
  for (const PieceId body : {joint.a.body, joint.b.body})
    if (body != 0) s.wake(s.bodies.at(body));
  s.enter_joint(id, joint);
}

void Bodies::remove_joint(JointId id) {
  state_->end_joint(id);
}

void Bodies::set_motor(JointId id, const JointMotor& motor) {
  State& s = *state_;
  const auto found = s.joints.find(id);
  CHECK(found != s.joints.end() && validate(motor, found->second.joint().kind).has_value());
  found->second.set_motor(motor);
  for (const PieceId body : {found->second.joint().a.body, found->second.joint().b.body})
    if (body != 0) s.wake(s.bodies.at(body));
}

bool Bodies::has_joint(JointId id) const {
  return state_->joints.contains(id);
}

size_t Bodies::joints() const {
  return state_->joints.size();
}

size_t Bodies::awake_joints() const {
  const auto is_awake = [](const btRigidBody* body) { return body != nullptr && body->isActive(); };
  return static_cast<size_t>(std::ranges::count_if(state_->joints, [&](const auto& entry) {
    return is_awake(entry.second.body_a()) || is_awake(entry.second.body_b());
  }));
}

bool Bodies::is_joined(PieceId id) const {
  return state_->joints_of.contains(id);
}

JointLoad Bodies::joint_load(JointId id) const {
  const auto found = state_->joints.find(id);
  CHECK(found != state_->joints.end());
  return {found->second.force_n(), found->second.torque_nm()};
}

std::vector<EndedJoint> Bodies::take_broken_joints() {
  std::vector<EndedJoint> ended = std::exchange(state_->ended, {});
  std::ranges::sort(ended, {}, &EndedJoint::id);
  return ended;
}

}  // namespace scree
