// Bodies as values: motions that are kept, what is made of them, and their hash.
#include <utility>
#include <xxhash.h>

#include "server/bodies/bodies_state.h"
#include "server/bodies/motion_checks.h"
#include "server/bodies/to_bullet.h"
#include "shared/base/check.h"

namespace scree {

MotionValue Bodies::motions() const {
  MotionValue value;
  for (const auto& [id, body] : state_->bodies) {
    const btTransform& at = body.rigid->getWorldTransform();
    BodyMotion& motion = value.bodies.emplace_back();
    motion.id = id;
    motion.origin_m = from_bullet(at.getOrigin());
    for (int row = 0; row < 3; ++row)
      motion.basis[static_cast<size_t>(row)] = from_bullet(at.getBasis()[row]);
    motion.velocity_m_s = from_bullet(body.rigid->getLinearVelocity());
    motion.spin_rad_s = from_bullet(body.rigid->getAngularVelocity());
    motion.frozen = body.frozen.has_value();
    if (body.thawed) motion.thawed = BoundsM{from_bullet(body.thawed->lo), from_bullet(body.thawed->hi)};
  }
  state_->pending.store(value);
  return value;
}

std::shared_ptr<const BodyShape> Bodies::shape(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  return found->second.given;
}

Result<void> Bodies::restore(const std::vector<std::shared_ptr<const BodyShape>>& shapes,
                             const MotionValue& motions, std::span<const KnownJoint> joints) {
  State& s = *state_;
  CHECK(s.bodies.empty());
  CHECK_EQ(shapes.size(), motions.bodies.size());
  for (size_t i = 0; i < shapes.size(); ++i) {
    if (contains(motions.bodies[i].id)) return refuse_body(motions.bodies[i].id, "it comes twice");
    TRY(s.restore(motions.bodies[i], shapes[i]));
  }
  s.pending.restore(motions);
  return s.restore_joints(joints);
}

void Bodies::renew() {
  const MotionValue now = motions();
  std::vector<std::pair<std::shared_ptr<const BodyShape>, std::vector<glm::vec3>>> known;
  for (auto& [id, body] : state_->bodies) known.emplace_back(body.given, std::move(body.points_m));
  CHECK(state_->ended.empty());
  std::vector<KnownJoint> joints;
  for (const auto& [id, joint] : state_->joints) joints.push_back({id, joint.joint()});
  while (size() > 0) remove(state_->bodies.begin()->first);
  state_ = std::make_unique<State>(state_->terrain.field(), state_->config);
  for (size_t i = 0; i < known.size(); ++i) {
    const Result<void> restored =
        state_->restore(now.bodies[i], std::move(known[i].first), std::move(known[i].second));
    CHECK(restored.has_value());
  }
  state_->pending.restore(now);
  CHECK(state_->restore_joints(joints).has_value());
}

uint64_t Bodies::state_hash() const {
  std::vector<float> exact;
  exact.reserve(size() * 18);
  const auto put = [&](const btVector3& v) { exact.insert(exact.end(), {v.x(), v.y(), v.z()}); };
  for (const auto& [id, body] : state_->bodies) {
    const btTransform& at = body.rigid->getWorldTransform();
    put(at.getOrigin());
    for (int row = 0; row < 3; ++row) put(at.getBasis()[row]);
    put(body.rigid->getLinearVelocity());
    put(body.rigid->getAngularVelocity());
  }
  return XXH3_64bits(exact.data(), exact.size() * sizeof(float));
}

}  // namespace scree
