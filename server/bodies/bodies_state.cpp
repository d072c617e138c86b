#include "server/bodies/bodies_state.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "server/bodies/free_way.h"
#include "server/bodies/limits.h"
#include "server/bodies/motion_checks.h"
#include "server/bodies/sweep.h"
#include "server/bodies/terrain_blows.h"
#include "server/bodies/to_bullet.h"
#include "server/colliders/sound_values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

btDefaultCollisionConstructionInfo sizes() {
  btDefaultCollisionConstructionInfo info;
  info.m_customCollisionAlgorithmMaxElementSize = sizeof(HullAlgorithm);
  return info;
}

/// The impulse of a contact in the last step on the one of its bodies that is static.
struct BlowOnStatic {
  btVector3 impulse{0.0F, 0.0F, 0.0F};
  btVector3 at{0.0F, 0.0F, 0.0F};
  float strength = 0.0F;  ///< sum of the points' impulses
};

BlowOnStatic blow_on(const btPersistentManifold& manifold, bool first) {
  BlowOnStatic blow;
  for (int k = 0; k < manifold.getNumContacts(); ++k) {
    const btManifoldPoint& point = manifold.getContactPoint(k);
    blow.impulse += point.m_normalWorldOnB * (first ? point.m_appliedImpulse : -point.m_appliedImpulse);
    blow.at += point.m_positionWorldOnB * point.m_appliedImpulse;
    blow.strength += point.m_appliedImpulse;
  }
  if (blow.strength > 0.0F) blow.at /= blow.strength;
  return blow;
}

btTransform transform_of(const BodyMotion& motion) {
  const auto& [x, y, z] = motion.basis;
  return btTransform(btMatrix3x3(x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z), to_bullet(motion.origin_m));
}

/// How far the body's farthest points moved in the step, at most.
float way_m(const Body& body) {
  const btTransform& now = body.rigid->getWorldTransform();
  float turned = 0.0F;
  for (int axis = 0; axis < 3; ++axis)
    turned += (now.getBasis().getColumn(axis) - body.last.getBasis().getColumn(axis)).length();
  return (now.getOrigin() - body.last.getOrigin()).length() + turned * body.reach_m;
}

/// 1,000 Hz has one step a tick, as has 60 Hz; 10 Hz has six.
int steps_in(float tick_s) {
  int steps = 1;
  while (tick_s > limits::step_max_s * 1.001F * static_cast<float>(steps)) ++steps;
  return steps;
}

}  // namespace

bool MeetingFilter::needBroadphaseCollision(btBroadphaseProxy* a, btBroadphaseProxy* b) const {
  const auto is_still = [](const btBroadphaseProxy& proxy) {
    return static_cast<const btCollisionObject*>(proxy.m_clientObject)->isStaticObject();
  };
  return (a->m_collisionFilterGroup & b->m_collisionFilterMask) != 0 &&
         (b->m_collisionFilterGroup & a->m_collisionFilterMask) != 0 && !(is_still(*a) && is_still(*b));
}

Bodies::State::State(Field& field, const BodiesConfig& c)
    : config(c),
      steps_a_tick(steps_in(1.0F / static_cast<float>(c.tick_rate_hz))),
      step_size{field.source().voxel_size_m,
                1.0F / static_cast<float>(c.tick_rate_hz * static_cast<uint32_t>(steps_a_tick))},
      collision_configuration(sizes()),
      workers(c.threads),
      dispatcher(&collision_configuration),
      dynamics(dispatcher, broadphase, collision_configuration, workers),
      terrain(field, c.terrain_collider, dispatcher, {step_size.voxel_size_m, step_size.step_s}),
      seen(field) {
  CHECK(std::isfinite(step_size.step_s) && std::isfinite(c.gravity_m_s2));
  CHECK(c.palette != nullptr);
  broadphase.getOverlappingPairCache()->setOverlapFilterCallback(&meeting);
  dispatcher.registerCollisionCreateFunc(CONVEX_HULL_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE,
                                         &hull_algorithm);
  dynamics.setGravity(btVector3(0.0F, -c.gravity_m_s2, 0.0F));
  dynamics.setForceUpdateAllAabbs(false);
  dynamics.getDispatchInfo().m_deterministicOverlappingPairs = true;
  btContactSolverInfo& info = dynamics.getSolverInfo();
  info.m_numIterations = limits::solver_iterations;
  info.m_erp2 = limits::undone_a_step;
  info.m_linearSlop = limits::penetration_slop_m;
  info.m_warmstartingFactor = 1.0F;
  info.m_splitImpulsePenetrationThreshold = 0.0F;
  info.m_solverMode |= SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;  // PieceSolver sets the directions
}

Body& Bodies::State::make(PieceId id, std::shared_ptr<const BodyShape> given,
                          std::vector<glm::vec3> points_m) {
  Body& body = bodies[id];
  body = make_body(id, std::move(given), std::move(points_m), step_size);
  terrain.attach(body);
  return body;
}

Result<void> Bodies::State::restore(const BodyMotion& motion, std::shared_ptr<const BodyShape> shape,
                                    std::vector<glm::vec3> points_m) {
  TRY(check_shape(motion.id, *shape));
  TRY(check_motion(motion));
  if (shape->nature.motion != PropMotion::dynamic &&
      motion.frozen != (shape->nature.motion == PropMotion::fixed))
    return refuse_body(motion.id, "what is fixed is frozen, and what is kinematic is not");
  Body& body = make(motion.id, std::move(shape), std::move(points_m));
  body.rigid->setCenterOfMassTransform(transform_of(motion));
  body.rigid->setLinearVelocity(to_bullet(motion.velocity_m_s));
  body.rigid->setAngularVelocity(to_bullet(motion.spin_rad_s));
  if (body.rigid->getLinearVelocity().length() > speed_rounding * speed_max_m_s(body) ||
      body.rigid->getAngularVelocity().length() > speed_rounding * body.spin_max_rad_s ||
      !is_sound(pose_of(body))) {
    bodies.erase(motion.id);
    return refuse_body(motion.id, "it is faster than bodies are");
  }
  body.last = body.rigid->getWorldTransform();
  enter(body);
  if (motion.frozen) freeze(motion.id, body);
  if (motion.thawed) body.thawed = Bounds{to_bullet(motion.thawed->lo_m), to_bullet(motion.thawed->hi_m)};
  return {};
}

// Each body is one thread's. Only one thread may read the terrain, and one change the broadphase: both go on
// beside what needs neither.
void Bodies::State::step() {
  loose.clear();
  for (auto& [id, body] : bodies)
    if (!body.frozen) loose.push_back(&body);
  for (Body* body : loose) {
    body->speed_before = body->rigid->getLinearVelocity();
    body->spin_before = body->rigid->getAngularVelocity();
  }
  const auto for_all = [this](WorkBatch& batch, auto work) {
    batch.share(std::span(loose), limits::bodies_per_part, work);
  };
  const auto run = [this](const WorkBatch& batch) {
    if (loose.size() > limits::bodies_per_part) return batch.run(workers);
    batch.run_alone();
  };
  WorkBatch turning, copying, touching, moving;
  list_joints();
  dynamics.begin(step_size.step_s);
  dynamics.foresee(turning);
  for_all(turning, [this](std::span<Body*> some) {
    for (Body* body : some) terrain.turn(*body);
  });
  run(turning);
  look_for_ways_out();
  copying.add([this] { dynamics.find_pairs(); });
  if (std::ranges::any_of(loose, &Body::needs_copy))
    copying.add([this] {
      for (Body* body : loose)
        if (body->needs_copy) body->probe->copy_terrain();
    });
  for_all(copying, [this](std::span<Body*> some) { terrain.refill(some, false); });
  run(copying);
  dynamics.find_contacts(touching);
  for_all(touching, [this](std::span<Body*> some) { terrain.refill(some, true); });
  run(touching);
  terrain.roughen(loose, *config.palette);
  dynamics.solve();
  break_joints();
  keep_strongest(terrain_blows, list_terrain_blows(bodies, dispatcher, limits::struck_speed_min_m_s));
  fast.clear();
  for (Body* body : loose)
    if (body->awake && is_fast(*body, step_size)) fast.push_back(body);
  sweep(fast, step_size, seen);
  stop_together();
  for_all(moving, [this](std::span<Body*> some) {
    for (Body* body : some) {
      dynamics.move(*body->rigid, body->hulls->step_share());
      if (body->rigid->isActive() && body->is_dynamic()) settle(*body, step_size, config.air_drag);
    }
  });
  run(moving);
  moved_m = 0.0F;
  for (const Body* body : loose) moved_m = std::max(moved_m, way_m(*body));
  if (frozen > 0) thaw_struck();
  for (auto& [id, body] : bodies)
    if (body.thawed) wake_around_thawed(body);
}

bool Bodies::State::look_for_way_out(Body& body) {
  body.sinks = is_sunk(body, terrain.field());
  body.looked = body.sinks;
  body.way_out = body.sinks ? free_way(body, terrain.field()) : std::nullopt;
  return body.sinks;
}

void Bodies::State::look_for_ways_out() {
  size_t left = limits::free_ways_a_step;
  for (Body* body : loose) {
    if (!body->sinks) {
      body->looked = false;
      body->way_out.reset();
      continue;
    }
    if (body->awake && !body->looked && left > 0) {
      --left;
      look_for_way_out(*body);
    }
    if (body->way_out) body->rigid->setDeactivationTime(0.0F);
  }
}

void Bodies::State::wake_near(const Bounds& bounds) {
  for (auto& [id, body] : bodies)
    if (meet(bounds, bounds_of(body))) wake(body);
}

void Bodies::State::tell_changes() {
  if (pending.empty()) return;
  const std::vector<Bounds> near = pending.waking(step_size.voxel_size_m);
  std::vector<Body*> all;
  for (auto& [id, body] : bodies) all.push_back(&body);
  workers.share(std::span(all), limits::bodies_per_part, [&](size_t, std::span<Body*> some) {
    for (Body* body : some) {
      for (const VoxelBox& box : pending.boxes()) body->probe->terrain_changed(box);
      const Bounds now = bounds_of(*body);
      body->roused = std::ranges::any_of(near, [&](const Bounds& b) { return meet(b, now); });
    }
  });
  for (Body* body : all) {
    if (!body->roused) continue;
    body->looked = false;
    wake(*body);
  }
  pending.clear();
}

void Bodies::State::take_out(PieceId id) {
  Body& body = bodies.at(id);
  pending.add(bounds_of(body));
  leave(body);
  if (body.frozen) --frozen;
  bodies.erase(id);
  CHECK(frozen <= bodies.size());
}

void Bodies::State::enter(Body& body) {
  CHECK(body.ground == nullptr && body.rigid->getBroadphaseHandle() == nullptr);
  const BodyNature& nature = body.nature();
  dynamics.addRigidBody(body.rigid.get(), static_cast<int>(nature.groups), static_cast<int>(nature.meets));
  if (nature.gravity != 1.0F) body.rigid->setGravity(dynamics.getGravity() * nature.gravity);
  if (!body.frozen) terrain.add_contacts(body);
}

void Bodies::State::leave(Body& body) {
  terrain.remove_contacts(body);
  dynamics.removeRigidBody(body.rigid.get());
}

void Bodies::State::freeze(PieceId id, Body& body) {
  leave(body);
  btRigidBody& rigid = *body.rigid;
  rigid.setLinearVelocity(btVector3(0.0F, 0.0F, 0.0F));
  rigid.setAngularVelocity(btVector3(0.0F, 0.0F, 0.0F));
  rigid.setMassProps(0.0F, btVector3(0.0F, 0.0F, 0.0F));
  body.hulls->turn(from_bullet(rigid.getWorldTransform().getBasis()));
  body.speed_before = body.spin_before = btVector3(0.0F, 0.0F, 0.0F);
  body.frozen = BodyState{id, pose_of(body), glm::vec3(0.0F), glm::vec3(0.0F), true};
  body.thawed.reset();
  ++frozen;
  enter(body);
}

void Bodies::State::wake(Body& body) {
  btRigidBody& rigid = *body.rigid;
  if (body.is_fixed()) return;
  if (!body.frozen) {
    if (body.is_dynamic()) rigid.activate(true);
    return;
  }
  leave(body);
  body.frozen.reset();
  CHECK(frozen > 0);
  --frozen;
  rigid.setCollisionFlags(0);
  rigid.setMassProps(body.mass_kg, body.inertia_kg_m2);
  rigid.updateInertiaTensor();
  rigid.forceActivationState(ACTIVE_TAG);
  rigid.setDeactivationTime(0.0F);
  body.last = rigid.getWorldTransform();
  body.thawed = bounds_of(body);
  enter(body);
}

void Bodies::State::thaw_struck() {
  std::vector<std::pair<PieceId, BlowOnStatic>> struck;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *dispatcher.getManifoldByIndexInternal(i);
    if (manifold.getBody1() == &terrain.object()) continue;
    const bool first = manifold.getBody0()->isStaticObject();
    if (first == manifold.getBody1()->isStaticObject()) continue;
    if (!(first ? manifold.getBody1() : manifold.getBody0())->isActive()) continue;
    const PieceId id = id_of(first ? manifold.getBody0() : manifold.getBody1());
    if (!bodies.at(id).frozen || bodies.at(id).is_fixed()) continue;
    const BlowOnStatic blow = blow_on(manifold, first);
    if (blow.strength >= limits::thaw_speed_m_s * bodies.at(id).mass_kg) struck.emplace_back(id, blow);
  }
  for (const auto& [id, blow] : struck) {
    Body& body = bodies.at(id);
    wake(body);
    body.rigid->applyImpulse(blow.impulse, blow.at - body.rigid->getWorldTransform().getOrigin());
    limit_speeds(body);
  }
}

void Bodies::State::wake_around_thawed(Body& body) {
  const Bounds now = bounds_of(body);
  const btVector3 moved = (now.lo - body.thawed->lo).absolute() + (now.hi - body.thawed->hi).absolute();
  if (std::max({moved.x(), moved.y(), moved.z()}) < 2.0F * limits::thawed_leash_m) return;
  const Bounds stood = *body.thawed;
  body.thawed.reset();
  wake_near(stood);
}

}  // namespace scree
