#include "server/bodies/sleep_islands.h"

#include "server/bodies/joint_rows.h"

namespace scree {

namespace {

const btCollisionObject* object_of(const btBroadphaseProxy* proxy) {
  return static_cast<const btCollisionObject*>(proxy->m_clientObject);
}

bool keeps_awake(const btCollisionObject& body) {
  return body.getActivationState() == ACTIVE_TAG || body.getActivationState() == DISABLE_DEACTIVATION;
}

}  // namespace

void SleepIslands::update(const btCollisionObjectArray& bodies, btOverlappingPairCache& pairs,
                          std::span<JointRows* const> joints) {
  const auto count = static_cast<uint32_t>(bodies.size());
  islands_.reset(count);
  awake_.assign(count, 0);
  for (uint32_t i = 0; i < count; ++i) {
    btCollisionObject& body = *bodies[static_cast<int>(i)];
    body.setIslandTag(body.isStaticObject() ? -1 : static_cast<int>(i));
  }
  const btBroadphasePairArray& all = pairs.getOverlappingPairArray();
  for (int i = 0; i < all.size(); ++i) {
    const int a = object_of(all[i].m_pProxy0)->getIslandTag(),
              b = object_of(all[i].m_pProxy1)->getIslandTag();
    if (a >= 0 && b >= 0) islands_.join(static_cast<uint32_t>(a), static_cast<uint32_t>(b));
  }
  for (const JointRows* joint : joints) {
    if (joint->body_a() == nullptr || joint->body_b() == nullptr) continue;
    const int a = joint->body_a()->getIslandTag(), b = joint->body_b()->getIslandTag();
    if (a >= 0 && b >= 0) islands_.join(static_cast<uint32_t>(a), static_cast<uint32_t>(b));
  }
  for (uint32_t i = 0; i < count; ++i)
    if (keeps_awake(*bodies[static_cast<int>(i)])) awake_[islands_.root_of(i)] = 1;
  for (uint32_t i = 0; i < count; ++i) {
    btCollisionObject& body = *bodies[static_cast<int>(i)];
    if (body.isStaticObject()) continue;
    awake_[i] = awake_[islands_.root_of(i)];  // the root comes first, and stays as it is
    if (awake_[i] == 0) {
      body.setActivationState(ISLAND_SLEEPING);
    } else if (body.getActivationState() == ISLAND_SLEEPING) {
      body.setActivationState(WANTS_DEACTIVATION);
      body.setDeactivationTime(0.0F);
    }
  }
}

}  // namespace scree
