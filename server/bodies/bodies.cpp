#include "server/bodies/bodies.h"

#include <BulletCollision/BroadphaseCollision/btDbvtBroadphase.h>
#include <BulletCollision/CollisionDispatch/btDefaultCollisionConfiguration.h>
#include <BulletCollision/CollisionShapes/btEmptyShape.h>
#include <BulletDynamics/ConstraintSolver/btSequentialImpulseConstraintSolver.h>
#include <BulletDynamics/Dynamics/btDiscreteDynamicsWorld.h>
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <utility>
#include <xxhash.h>

#include "server/bodies/body_shape.h"
#include "server/bodies/hull_algorithm.h"
#include "server/bodies/impact_list.h"
#include "server/bodies/limits.h"
#include "server/bodies/terrain_manifold.h"
#include "shared/base/check.h"

namespace scree {

namespace {

btVector3 to_bullet(glm::vec3 v) {
  return {v.x, v.y, v.z};
}

glm::vec3 from_bullet(const btVector3& v) {
  return {v.x(), v.y(), v.z()};
}

btTransform to_bullet(const Pose& pose) {
  const glm::quat& q = pose.rotation;
  return btTransform(btQuaternion(q.x, q.y, q.z, q.w), to_bullet(pose.position_m));
}

glm::mat3 from_bullet(const btMatrix3x3& rows) {
  return {from_bullet(rows.getColumn(0)), from_bullet(rows.getColumn(1)), from_bullet(rows.getColumn(2))};
}

Pose from_bullet(const btTransform& transform) {
  const btQuaternion q = transform.getRotation();
  return {from_bullet(transform.getOrigin()), glm::quat(q.w(), q.x(), q.y(), q.z())};
}

btVector3 stable_inertia(glm::vec3 inertia) {
  const float least = std::max({inertia.x, inertia.y, inertia.z}) * limits::inertia_ratio_min;
  return to_bullet(glm::max(inertia, glm::vec3(least)));
}

struct Body {
  std::unique_ptr<btConvexHullShape> shape;
  std::unique_ptr<HullCorners> corners;  ///< of `shape`, turned; `rigid`'s user pointer
  std::unique_ptr<btRigidBody> rigid;
  std::vector<glm::vec3> points_m;  ///< what touches the terrain
  std::unique_ptr<TerrainProbe> probe;
  btPersistentManifold* ground = nullptr;  ///< the dispatcher's; body 0 is `rigid`
  float reach_m = 0.0F;
  float spin_max_rad_s = 0.0F;
  btTransform last;  ///< before the step: where to return to from what is no number
};

/// The piece that a Bullet object is; ids are kept in its user index, bit for bit.
PieceId id_of(const btCollisionObject* object) {
  return static_cast<PieceId>(object->getUserIndex());
}

btDefaultCollisionConstructionInfo sizes() {
  btDefaultCollisionConstructionInfo info;
  info.m_customCollisionAlgorithmMaxElementSize = sizeof(HullAlgorithm);
  return info;
}

bool touches(const btPersistentManifold& manifold) {
  for (int i = 0; i < manifold.getNumContacts(); ++i)
    if (manifold.getContactPoint(i).getDistance() < limits::contact_slack_m) return true;
  return false;
}

bool is_finite(const btVector3& v) {
  return std::isfinite(v.x()) && std::isfinite(v.y()) && std::isfinite(v.z());
}

}  // namespace

struct Bodies::State {
  State(Field& field, const BodiesConfig& c)
      : config(c),
        terrain_field(field),
        voxel_size_m(field.source().voxel_size_m),
        tick_s(1.0F / static_cast<float>(c.tick_rate_hz)),
        collision_configuration(sizes()),
        dispatcher(&collision_configuration),
        dynamics(&dispatcher, &broadphase, &solver, &collision_configuration),
        terrain_collider(make_terrain_collider(c.terrain_collider, field)) {
    terrain.setCollisionShape(&terrain_shape);
    // Asleep, so that the island manager leaves sleeping bodies on it alone.
    terrain.forceActivationState(ISLAND_SLEEPING);
    // Bullet sorts manifolds by broadphase proxy, which what is in no broadphase lacks.
    terrain_proxy.m_uniqueId = 0;
    terrain_proxy.m_clientObject = &terrain;
    terrain.setBroadphaseHandle(&terrain_proxy);
    dispatcher.registerCollisionCreateFunc(CONVEX_HULL_SHAPE_PROXYTYPE, CONVEX_HULL_SHAPE_PROXYTYPE,
                                           &hull_algorithm);
    dynamics.setGravity(btVector3(0.0F, -c.gravity_m_s2, 0.0F));
    dynamics.setForceUpdateAllAabbs(false);
    dynamics.getDispatchInfo().m_deterministicOverlappingPairs = true;
    btContactSolverInfo& info = dynamics.getSolverInfo();
    info.m_numIterations = limits::solver_iterations;
    info.m_linearSlop = limits::penetration_slop_m;
    info.m_splitImpulsePenetrationThreshold = 0.0F;
  }

  void find_ground(Body& body);
  void limit_speeds(Body& body) const;
  void settle(Body& body) const;
  void wake_near(const btVector3& lo, const btVector3& hi);

  BodiesConfig config;
  Field& terrain_field;
  float voxel_size_m;
  float tick_s;
  HullAlgorithmCreator hull_algorithm;
  btDefaultCollisionConfiguration collision_configuration;
  btCollisionDispatcher dispatcher;
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld dynamics;
  btEmptyShape terrain_shape;
  btBroadphaseProxy terrain_proxy;
  btCollisionObject terrain;
  std::unique_ptr<TerrainCollider> terrain_collider;
  std::map<PieceId, Body> bodies;
  std::vector<TerrainContact> found;  ///< scratch
};

void Bodies::State::find_ground(Body& body) {
  const btRigidBody& rigid = *body.rigid;
  const float speed = rigid.getLinearVelocity().length() + rigid.getAngularVelocity().length() * body.reach_m;
  found.clear();
  body.probe->find(from_bullet(rigid.getWorldTransform()), limits::contact_slack_m + speed * tick_s, found);
  // A body's own is a root already.
  const float friction = rigid.getFriction() * std::sqrt(config.friction);
  refill(*body.ground, rigid, found, {friction, config.restitution, tick_s});
}

/// What a body may not exceed, or it would cross the narrow band in one tick.
void Bodies::State::limit_speeds(Body& body) const {
  btRigidBody& rigid = *body.rigid;
  const float speed_max = 0.8F * limits::travel_max_voxels * voxel_size_m / tick_s;
  const float speed = rigid.getLinearVelocity().length();
  if (speed > speed_max) rigid.setLinearVelocity(rigid.getLinearVelocity() * (speed_max / speed));
  const float turning = rigid.getAngularVelocity().length();
  if (turning > body.spin_max_rad_s)
    rigid.setAngularVelocity(rigid.getAngularVelocity() * (body.spin_max_rad_s / turning));
}

/// Damping and speed limits, after the step. Bullet's own damping would call libm.
void Bodies::State::settle(Body& body) const {
  btRigidBody& rigid = *body.rigid;
  btVector3 velocity = rigid.getLinearVelocity();
  btVector3 spin = rigid.getAngularVelocity();
  if (!is_finite(velocity) || !is_finite(spin) || !is_finite(rigid.getWorldTransform().getOrigin())) {
    rigid.setWorldTransform(body.last);
    velocity = spin = btVector3(0.0F, 0.0F, 0.0F);
  }
  const bool creeping = body.ground->getNumContacts() > 0 && velocity.length() < limits::creep_m_s;
  velocity *= 1.0F - tick_s * (creeping ? limits::ground_damping : limits::air_damping);
  spin *= 1.0F - tick_s * (creeping ? limits::ground_spin_damping : limits::air_spin_damping);
  rigid.setLinearVelocity(velocity);
  rigid.setAngularVelocity(spin);
  limit_speeds(body);
}

void Bodies::State::wake_near(const btVector3& lo, const btVector3& hi) {
  for (auto& [id, body] : bodies) {
    btVector3 body_lo, body_hi;
    body.rigid->getAabb(body_lo, body_hi);
    if (TestAabbAgainstAabb2(lo, hi, body_lo, body_hi)) body.rigid->activate(true);
  }
}

Bodies::Bodies(Field& field, const BodiesConfig& config) : state_(std::make_unique<State>(field, config)) {}

Bodies::~Bodies() {
  while (size() > 0) remove(state_->bodies.begin()->first);
}

void Bodies::add(const BodyShape& shape, const BodyState& state) {
  State& s = *state_;
  CHECK(!contains(state.id));
  CHECK(shape.hull_m.size() >= 4 && shape.mass_kg > 0.0F);
  Body& body = s.bodies[state.id];
  body.shape = make_convex_shape(shape.hull_m);
  body.reach_m = reach_of(shape.hull_m);
  const float spin_travel_m = 0.2F * limits::travel_max_voxels * s.voxel_size_m / s.tick_s;
  body.spin_max_rad_s = std::min(limits::spin_max_rad_s, spin_travel_m / std::max(body.reach_m, 0.01F));
  btRigidBody::btRigidBodyConstructionInfo info(shape.mass_kg, nullptr, body.shape.get(),
                                                stable_inertia(shape.inertia_kg_m2));
  info.m_startWorldTransform = to_bullet(state.pose);
  info.m_friction = std::sqrt(shape.friction);  // Bullet multiplies those of both bodies
  info.m_restitution = std::sqrt(s.config.restitution);
  info.m_linearSleepingThreshold = limits::sleep_speed_m_s;
  info.m_angularSleepingThreshold = limits::sleep_spin_rad_s;
  body.rigid = std::make_unique<btRigidBody>(info);
  body.rigid->setFlags(0);  // no gyroscopic torque: it costs a solve a body, and rubble does not show it
  body.corners = std::make_unique<HullCorners>(corners_of(*body.shape));
  body.rigid->setUserPointer(body.corners.get());
  body.rigid->setUserIndex(static_cast<int>(state.id));
  body.rigid->setLinearVelocity(to_bullet(state.velocity_m_s));
  body.rigid->setAngularVelocity(to_bullet(state.spin_rad_s));
  body.last = body.rigid->getWorldTransform();
  body.points_m = shape.surface_m.empty()
                      ? surface_points(shape.hull_m, limits::sample_spacing_voxels * s.voxel_size_m)
                      : shape.surface_m;
  body.probe = s.terrain_collider->attach(body.points_m);
  s.dynamics.addRigidBody(body.rigid.get());
  body.ground = s.dispatcher.getNewManifold(body.rigid.get(), &s.terrain);
  s.limit_speeds(body);
}

void Bodies::remove(PieceId id) {
  State& s = *state_;
  const auto found = s.bodies.find(id);
  CHECK(found != s.bodies.end());
  Body& body = found->second;
  btVector3 lo, hi;
  body.rigid->getAabb(lo, hi);
  s.dispatcher.releaseManifold(body.ground);
  s.dynamics.removeRigidBody(body.rigid.get());
  s.bodies.erase(found);
  s.wake_near(lo, hi);
}

bool Bodies::contains(PieceId id) const {
  return state_->bodies.contains(id);
}

size_t Bodies::size() const {
  return state_->bodies.size();
}

void Bodies::step() {
  State& s = *state_;
  for (auto& [id, body] : s.bodies) {
    body.corners->turn(from_bullet(body.rigid->getWorldTransform().getBasis()));
    if (!body.rigid->isActive()) continue;
    body.last = body.rigid->getWorldTransform();
    s.find_ground(body);
  }
  s.dynamics.stepSimulation(s.tick_s, 0);
  for (auto& [id, body] : s.bodies)
    if (body.rigid->isActive()) s.settle(body);
}

void Bodies::terrain_changed(const VoxelBox& box) {
  State& s = *state_;
  s.terrain_collider->terrain_changed(box);
  for (auto& [id, body] : s.bodies) body.probe->terrain_changed(box);
  const auto corner = [&](VoxelCoord v) {
    return btVector3(static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)) *
           s.voxel_size_m;
  };
  const VoxelBox near = box.grown(1);
  s.wake_near(corner(near.lo), corner(near.hi));
}

void Bodies::set_terrain_collider(TerrainColliderKind kind) {
  State& s = *state_;
  if (kind == s.config.terrain_collider) return;
  s.config.terrain_collider = kind;
  // The old one outlives its probes.
  const std::unique_ptr<TerrainCollider> old =
      std::exchange(s.terrain_collider, make_terrain_collider(kind, s.terrain_field));
  for (auto& [id, body] : s.bodies) {
    body.probe = s.terrain_collider->attach(body.points_m);
    body.rigid->activate(true);
  }
}

std::vector<BodyState> Bodies::states() const {
  std::vector<BodyState> states;
  states.reserve(size());
  for (const auto& [id, body] : state_->bodies)
    states.push_back({id, from_bullet(body.rigid->getWorldTransform()),
                      from_bullet(body.rigid->getLinearVelocity()),
                      from_bullet(body.rigid->getAngularVelocity())});
  return states;
}

BodyState Bodies::state(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  const btRigidBody& rigid = *found->second.rigid;
  return {id, from_bullet(rigid.getWorldTransform()), from_bullet(rigid.getLinearVelocity()),
          from_bullet(rigid.getAngularVelocity())};
}

BodyContacts Bodies::contacts() const {
  BodyContacts contacts;
  const State& s = *state_;
  for (const auto& [id, body] : s.bodies)
    if (touches(*body.ground)) contacts.on_terrain.push_back(id);
  const btPersistentManifold* const* manifolds = state_->dispatcher.getInternalManifoldPointer();
  for (int i = 0; i < s.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *manifolds[i];
    if (manifold.getBody1() == &s.terrain || !touches(manifold)) continue;
    const float up = manifold.getContactPoint(0).m_normalWorldOnB.y();
    const PieceId a = id_of(manifold.getBody0()), b = id_of(manifold.getBody1());
    if (up > limits::carrying_slope) contacts.carried.push_back({a, b});
    if (up < -limits::carrying_slope) contacts.carried.push_back({b, a});
  }
  std::ranges::sort(contacts.carried);
  // clang 14 does not compile libstdc++'s std::ranges::unique.
  contacts.carried.erase(std::unique(contacts.carried.begin(), contacts.carried.end()),
                         contacts.carried.end());
  return contacts;
}

std::vector<BodyImpact> Bodies::impacts(float speed_min_m_s) const {
  return list_impacts(state_->dispatcher, state_->terrain, speed_min_m_s);
}

float Bodies::mass_kg(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  return found->second.rigid->getMass();
}

float Bodies::reach_m(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  return found->second.reach_m;
}

size_t Bodies::awake() const {
  return static_cast<size_t>(std::ranges::count_if(
      state_->bodies, [](const auto& entry) { return entry.second.rigid->isActive(); }));
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
