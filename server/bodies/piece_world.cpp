#include "server/bodies/piece_world.h"

#include <BulletCollision/CollisionShapes/btCollisionShape.h>
#include <span>
#include <utility>

#include "server/bodies/limits.h"
#include "shared/base/check.h"

namespace scree {

PieceWorld::PieceWorld(btDispatcher& dispatcher, btBroadphaseInterface& broadphase,
                       btCollisionConfiguration& configuration, Workers& workers)
    : btDiscreteDynamicsWorld(&dispatcher, &broadphase, nullptr, &configuration), workers_(workers) {}

PieceWorld::~PieceWorld() = default;

void PieceWorld::predictUnconstraintMotion(btScalar step_s) {
  moving_.clear();
  for (int i = 0; i < m_collisionObjects.size(); ++i)
    if (m_collisionObjects[i]->isActive()) moving_.push_back({btRigidBody::upcast(m_collisionObjects[i])});
  const btVector3 slack(gContactBreakingThreshold, gContactBreakingThreshold, gContactBreakingThreshold);
  workers_.share(std::span(moving_), limits::bodies_per_part, [&](size_t, std::span<Moving> some) {
    for (Moving& moving : some) {
      btRigidBody& body = *moving.body;
      body.predictIntegratedTransform(step_s, body.getInterpolationWorldTransform());
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

void PieceWorld::updateAabbs() {
  for (const Moving& moving : moving_) {
    CHECK_DEBUG(!moving.body->isStaticObject());
    if ((moving.hi - moving.lo).length2() < 1e12F)
      m_broadphasePairCache->setAabb(moving.body->getBroadphaseHandle(), moving.lo, moving.hi, m_dispatcher1);
    else
      updateSingleAabb(moving.body);  // a speed that is not finite: Bullet takes the body out
  }
}

void PieceWorld::integrateTransforms(btScalar step_s) {
  const std::span<btRigidBody*> bodies(
      m_nonStaticRigidBodies.size() > 0 ? &m_nonStaticRigidBodies[0] : nullptr,
      static_cast<size_t>(m_nonStaticRigidBodies.size()));
  workers_.share(bodies, limits::bodies_per_part, [&](size_t, std::span<btRigidBody*> some) {
    integrateTransformsInternal(some.data(), static_cast<int>(some.size()), step_s);
  });
}

void PieceWorld::solveConstraints(btContactSolverInfo& info) {
  CHECK_EQ(getNumConstraints(), 0);
  groups_.clear();
  m_islandManager->buildAndProcessIslands(m_dispatcher1, this, &groups_);
  const std::span<SolverGroups::Group> groups = groups_.divide();
  workers_.run(groups.size(), [&](size_t part) { solve(groups[part], info); });
}

void PieceWorld::solve(const SolverGroups::Group& group, const btContactSolverInfo& info) {
  std::unique_ptr<PieceSolver> solver;
  {
    const std::scoped_lock lock(mutex_);
    if (!idle_solvers_.empty()) {
      solver = std::move(idle_solvers_.back());
      idle_solvers_.pop_back();
    }
  }
  if (solver == nullptr) solver = std::make_unique<PieceSolver>();
  solver->solveGroup(group.bodies.data(), static_cast<int>(group.bodies.size()), group.manifolds.data(),
                     static_cast<int>(group.manifolds.size()), nullptr, 0, info, nullptr, m_dispatcher1);
  const std::scoped_lock lock(mutex_);
  idle_solvers_.push_back(std::move(solver));
}

}  // namespace scree
