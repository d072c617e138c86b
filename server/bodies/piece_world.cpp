#include "server/bodies/piece_world.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <algorithm>
#include <span>
#include <utility>

#include "server/bodies/limits.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// Bullet's order of manifolds: by the age of their bodies.
uint64_t order_of(const btPersistentManifold& manifold) {
  const auto number = [](const btCollisionObject* body) {
    return static_cast<uint64_t>(body->getBroadphaseHandle()->m_uniqueId);
  };
  return number(manifold.getBody0()) << 32 | number(manifold.getBody1());
}

}  // namespace

PieceWorld::PieceWorld(PairDispatcher& dispatcher, btBroadphaseInterface& broadphase,
                       btCollisionConfiguration& configuration, Workers& workers)
    : btDiscreteDynamicsWorld(&dispatcher, &broadphase, nullptr, &configuration),
      pairs_(dispatcher),
      workers_(workers) {}

PieceWorld::~PieceWorld() = default;

void PieceWorld::begin(float step_s) {
  step_s_ = step_s;
  moving_.clear();
  for (int i = 0; i < m_collisionObjects.size(); ++i)
    if (m_collisionObjects[i]->isActive()) moving_.push_back({btRigidBody::upcast(m_collisionObjects[i])});
}

void PieceWorld::foresee(WorkBatch& batch) {
  const btVector3 slack(gContactBreakingThreshold, gContactBreakingThreshold, gContactBreakingThreshold);
  batch.share(std::span(moving_), limits::bodies_per_part, [=, this](std::span<Moving> some) {
    for (Moving& moving : some) {
      btRigidBody& body = *moving.body;
      body.applyGravity();
      body.predictIntegratedTransform(step_s_, body.getInterpolationWorldTransform());
      btVector3 lo, hi;
      body.getAabb(moving.lo, moving.hi);
      body.getCollisionShape()->getAabb(body.getInterpolationWorldTransform(), lo, hi);
      moving.lo.setMin(lo);
      moving.hi.setMax(hi);
      moving.lo -= slack;
      moving.hi += slack;
    }
  });
}

void PieceWorld::find_pairs() {
  for (const Moving& moving : moving_) {
    CHECK_DEBUG(!moving.body->isStaticObject());
    if ((moving.hi - moving.lo).length2() < 1e12F)
      m_broadphasePairCache->setAabb(moving.body->getBroadphaseHandle(), moving.lo, moving.hi, m_dispatcher1);
    else
      updateSingleAabb(moving.body);  // a speed that is not finite: Bullet takes the body out
  }
  computeOverlappingPairs();
  pairs_.list(*getPairCache());
}

void PieceWorld::find_contacts(WorkBatch& batch) {
  batch.add([this] { islands_.update(m_collisionObjects, *getPairCache(), joints_); });
  pairs_.search(batch, step_s_);
}

void PieceWorld::gather() {
  groups_.clear();
  const auto is_awake = [&](const btCollisionObject* body) {
    return body != nullptr && !body->isStaticObject() && islands_.is_awake(*body);
  };
  for (int i = 0; i < m_collisionObjects.size(); ++i)
    if (is_awake(m_collisionObjects[i])) groups_.add(*m_collisionObjects[i]);
  for (int i = 0; i < pairs_.getNumManifolds(); ++i) {
    btPersistentManifold* const manifold = pairs_.getManifoldByIndexInternal(i);
    if (manifold->getNumContacts() == 0) continue;
    if (is_awake(manifold->getBody0()) || is_awake(manifold->getBody1()))
      groups_.add({order_of(*manifold), manifold});
  }
  for (JointRows* joint : joints_)
    if (is_awake(joint->body_a()) || is_awake(joint->body_b())) groups_.add(*joint);
}

void PieceWorld::solve() {
  CHECK_EQ(getNumConstraints(), 0);
  pairs_.update_manifolds();
  getSolverInfo().m_timeStep = step_s_;
  gather();
  const std::span<SolverGroups::Group> groups = groups_.divide();
  workers_.run(groups.size(), [&](size_t part) { solve(groups[part]); });
  pairs_.hold_fast(step_s_);
}

void PieceWorld::solve(const SolverGroups::Group& group) {
  std::unique_ptr<Solver> solver;
  {
    const std::scoped_lock lock(mutex_);
    if (!idle_solvers_.empty()) {
      solver = std::move(idle_solvers_.back());
      idle_solvers_.pop_back();
    }
  }
  if (solver == nullptr) solver = std::make_unique<Solver>();
  solver->rows.set_fall(getGravity() * step_s_);
  solver->rows.set_joints(group.joints);
  std::ranges::sort(group.contacts, {}, &SolverGroups::Contacts::order);
  solver->manifolds.clear();
  for (const SolverGroups::Contacts& contacts : group.contacts)
    solver->manifolds.push_back(contacts.manifold);
  solver->rows.solveGroup(group.bodies.data(), static_cast<int>(group.bodies.size()),
                          solver->manifolds.data(), static_cast<int>(solver->manifolds.size()), nullptr, 0,
                          getSolverInfo(), nullptr, m_dispatcher1);
  for (const JointRows* joint : group.joints)
    if (joint->is_driven())
      for (btRigidBody* body : {joint->body_a(), joint->body_b()})
        if (body != nullptr && !body->isStaticObject()) body->setDeactivationTime(0.0F);
  const std::scoped_lock lock(mutex_);
  idle_solvers_.push_back(std::move(solver));
}

/// It is awake while it moves.
void PieceWorld::move_as_told(btRigidBody& body) const {
  const bool moves = !body.getLinearVelocity().fuzzyZero() || !body.getAngularVelocity().fuzzyZero();
  body.forceActivationState(moves ? ACTIVE_TAG : ISLAND_SLEEPING);
  if (!moves) return;
  btTransform next;
  body.predictIntegratedTransform(step_s_, next);
  body.setCenterOfMassTransform(next);
}

void PieceWorld::move(btRigidBody& body, float share) {
  if (body.isKinematicObject()) return move_as_told(body);
  btRigidBody* one = &body;
  integrateTransformsInternal(&one, 1, step_s_ * share);
  body.clearForces();
  body.updateDeactivation(step_s_);
  if (!body.wantsSleeping()) {
    if (body.getActivationState() != DISABLE_DEACTIVATION) body.setActivationState(ACTIVE_TAG);
  } else if (body.getActivationState() == ACTIVE_TAG) {
    body.setActivationState(WANTS_DEACTIVATION);
  } else if (body.getActivationState() == ISLAND_SLEEPING) {
    body.setLinearVelocity(btVector3(0.0F, 0.0F, 0.0F));
    body.setAngularVelocity(btVector3(0.0F, 0.0F, 0.0F));
  }
}

}  // namespace scree
