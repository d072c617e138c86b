#include "server/bodies/bodies.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "server/bodies/bodies_state.h"
#include "server/bodies/body_shape.h"
#include "server/bodies/contact_list.h"
#include "server/bodies/impact_list.h"
#include "server/bodies/limits.h"
#include "server/bodies/to_bullet.h"
#include "server/colliders/sound_values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

bool touches(const btPersistentManifold& manifold) {
  for (int i = 0; i < manifold.getNumContacts(); ++i)
    if (manifold.getContactPoint(i).getDistance() < limits::contact_slack_m) return true;
  return false;
}

/// clang 14 does not compile libstdc++'s std::ranges::unique.
template <typename T>
void sort_and_unite(std::vector<T>& values) {
  std::ranges::sort(values);
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// A frozen piece counts as terrain. A prop that stands still is none: what lies on it must not merge.
void note_carried(const btCollisionObject& upper, const btCollisionObject& lower, bool is_lower_fixed,
                  BodyContacts& contacts) {
  if (upper.isStaticObject()) return;
  if (lower.isStaticObject() && !is_lower_fixed)
    contacts.on_terrain.push_back(id_of(&upper));
  else
    contacts.carried.push_back({id_of(&upper), id_of(&lower)});
}

/// The state of the point of a body that lies so far off, in the body's axes.
BodyState moved_by(BodyState state, glm::vec3 offset_m) {
  if (offset_m == glm::vec3(0.0F)) return state;
  const glm::vec3 turned_m = state.pose.rotation * offset_m;
  state.pose.position_m += turned_m;
  state.velocity_m_s += glm::cross(state.spin_rad_s, turned_m);
  return state;
}

BodyState state_of(PieceId id, const Body& body) {
  if (body.frozen) return moved_by(*body.frozen, -body.given->centre_m);
  const btRigidBody& rigid = *body.rigid;
  BodyState state{id, pose_of(body), from_bullet(rigid.getLinearVelocity()),
                  from_bullet(rigid.getAngularVelocity()), false};
  return moved_by(state, -body.given->centre_m);
}

void check_sound(const BodyShape& shape, const BodyState& state) {
  const glm::mat3& inertia = shape.inertia_kg_m2;
  CHECK(shape.hull_m.size() >= 4);
  CHECK(std::isfinite(shape.mass_kg) && shape.mass_kg > 0.0F);
  CHECK(is_sound(inertia[0]) && is_sound(inertia[1]) && is_sound(inertia[2]));
  CHECK(inertia[0][0] > 0.0F && inertia[1][1] > 0.0F && inertia[2][2] > 0.0F);
  CHECK(inertia == glm::transpose(inertia));
  CHECK(shape.friction >= 0.0F);
  CHECK(is_sound(state.pose));
  CHECK(!state.frozen);
  CHECK(shape.part_radii_m.empty() || shape.part_radii_m.size() == shape.parts_m.size());
  CHECK_DEBUG(std::ranges::all_of(shape.hull_m, [](glm::vec3 corner) { return is_sound(corner); }));
}

}  // namespace

Bodies::Bodies(Field& field, const BodiesConfig& config) : state_(std::make_unique<State>(field, config)) {}

Bodies::~Bodies() {
  while (size() > 0) remove(state_->bodies.begin()->first);
  CHECK_EQ(state_->dispatcher.getNumManifolds(), 0);
}

void Bodies::add(BodyShape given, const BodyState& state) {
  State& s = *state_;
  CHECK(!contains(state.id));
  check_sound(given, state);
  const BodyState at_mass = moved_by(state, given.centre_m);
  Body& body = s.make(state.id, std::make_shared<const BodyShape>(std::move(given)));
  body.rigid->setCenterOfMassTransform(
      to_bullet(Pose{at_mass.pose.position_m, state.pose.rotation * body.axes}));
  body.rigid->setLinearVelocity(to_bullet(at_mass.velocity_m_s));
  body.rigid->setAngularVelocity(to_bullet(state.spin_rad_s));
  body.last = body.rigid->getWorldTransform();
  s.enter(body);
  limit_speeds(body);
  if (body.is_fixed()) s.freeze(state.id, body);
}

void Bodies::set_motion(PieceId id, const std::optional<Pose>& pose,
                        const std::optional<glm::vec3>& velocity_m_s,
                        const std::optional<glm::vec3>& spin_rad_s) {
  State& s = *state_;
  const auto found = s.bodies.find(id);
  CHECK(found != s.bodies.end());
  Body& body = found->second;
  CHECK(!body.nature().is_piece());
  BodyState now = state_of(id, body);
  if (pose) now.pose = *pose;
  if (velocity_m_s) now.velocity_m_s = *velocity_m_s;
  if (spin_rad_s) now.spin_rad_s = *spin_rad_s;
  const std::shared_ptr<const BodyShape> given = body.given;
  if (pose) {  // contacts are of where it was
    s.leave_joints(id);
    s.take_out(id);
    now.frozen = false;
    add(*given, now);
    s.enter_joints(id);
    return;
  }
  if (body.is_fixed()) return;
  now = moved_by(now, given->centre_m);
  body.rigid->setLinearVelocity(to_bullet(now.velocity_m_s));
  body.rigid->setAngularVelocity(to_bullet(now.spin_rad_s));
  body.rigid->forceActivationState(ACTIVE_TAG);
  body.rigid->setDeactivationTime(0.0F);
  limit_speeds(body);
}

InTerrain Bodies::look_whether_in_terrain(PieceId id) {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  if (!state_->look_for_way_out(found->second)) return InTerrain::no;
  return found->second.way_out ? InTerrain::way_out : InTerrain::no_way_out;
}

void Bodies::push(PieceId id, glm::vec3 impulse_n_s, glm::vec3 at_m) {
  State& s = *state_;
  const auto found = s.bodies.find(id);
  CHECK(found != s.bodies.end() && is_sound(impulse_n_s) && is_sound(at_m));
  Body& body = found->second;
  if (!body.is_dynamic()) return;
  if (body.frozen) s.wake(body);
  body.rigid->activate(true);
  body.rigid->applyImpulse(to_bullet(impulse_n_s),
                           to_bullet(at_m) - body.rigid->getWorldTransform().getOrigin());
  limit_speeds(body);
}

void Bodies::remove(PieceId id) {
  State& s = *state_;
  CHECK(contains(id));
  while (is_joined(id)) {
    const JointId joint = *s.joints_of.at(id).begin();
    s.ended.push_back({joint, JointEnd::body_gone});
    s.end_joint(joint);
  }
  s.take_out(id);
}

bool Bodies::contains(PieceId id) const {
  return state_->bodies.contains(id);
}

size_t Bodies::size() const {
  return state_->bodies.size();
}

void Bodies::step() {
  State& s = *state_;
  s.tell_changes();
  s.blows.clear();
  s.terrain_blows.clear();
  for (int step = 0; step < s.steps_a_tick; ++step) {
    if (step > 0)
      s.blows.add(list_impacts(s.bodies, s.dispatcher, s.terrain.object(), limits::struck_speed_min_m_s));
    s.step();
  }
  CHECK_DEBUG(
      std::ranges::all_of(s.bodies, [&](const auto& one) { return is_sound_body(one.first, one.second); }));
  CHECK_DEBUG(std::ranges::count_if(s.bodies, [](const auto& one) {
                return one.second.frozen.has_value();
              }) == static_cast<std::ptrdiff_t>(s.frozen));
}

void Bodies::freeze(PieceId id) {
  const auto found = state_->bodies.find(id);
  state_->tell_changes();  // or what changed before would thaw it
  CHECK(found != state_->bodies.end() && !found->second.frozen);
  state_->freeze(id, found->second);
}

void Bodies::thaw_all() {
  for (auto& [id, body] : state_->bodies)
    if (body.frozen) state_->wake(body);
  CHECK_DEBUG(std::ranges::all_of(
      state_->bodies, [](const auto& one) { return !one.second.frozen || one.second.is_fixed(); }));
}

size_t Bodies::frozen() const {
  return state_->frozen;
}

void Bodies::terrain_changed(const VoxelBox& box) {
  CHECK(!box.empty());
  state_->terrain.terrain_changed(box);
  state_->pending.add(box);
}

void Bodies::set_palette(std::shared_ptr<const Palette> palette) {
  CHECK(palette != nullptr);
  state_->config.palette = std::move(palette);
}

void Bodies::set_air_drag(float share_a_second) {
  CHECK(share_a_second >= 0.0F && share_a_second <= 1.0F);
  state_->config.air_drag = share_a_second;
}

void Bodies::set_terrain_collider(TerrainColliderKind kind) {
  State& s = *state_;
  if (kind == s.config.terrain_collider) return;
  s.tell_changes();
  s.config.terrain_collider = kind;
  s.terrain.set_collider(kind, s.bodies);
  for (auto& [id, body] : s.bodies) s.wake(body);
}

std::vector<PieceId> Bodies::near(glm::vec3 lo_m, glm::vec3 hi_m) const {
  struct Collector final : btBroadphaseAabbCallback {
    std::vector<PieceId> ids;
    bool process(const btBroadphaseProxy* proxy) override {
      ids.push_back(id_of(static_cast<const btCollisionObject*>(proxy->m_clientObject)));
      return true;
    }
  };
  const auto grown = [&](float by_m) {
    const btVector3 by(by_m, by_m, by_m);
    return Bounds{to_bullet(lo_m) - by, to_bullet(hi_m) + by};
  };
  // The tree holds the bounds that the last step foresaw: a blow may have sent a body farther.
  const Bounds may_be = grown(state_->moved_m + limits::travel_max_voxels * state_->step_size.voxel_size_m);
  const Bounds is = grown(limits::travel_max_voxels * state_->step_size.voxel_size_m);
  Collector collector;
  state_->broadphase.aabbTest(may_be.lo, may_be.hi, collector);
  std::erase_if(collector.ids, [&](PieceId id) { return !meet(is, bounds_of(state_->bodies.at(id))); });
  std::ranges::sort(collector.ids);
  return std::move(collector.ids);
}

std::vector<PieceId> Bodies::beyond(glm::vec3 half_m) const {
  std::vector<PieceId> ids;
  for (const auto& [id, body] : state_->bodies) {
    const glm::vec3 at = glm::abs(from_bullet(body.rigid->getWorldTransform().getOrigin()));
    if (at.x > half_m.x || at.y > half_m.y || at.z > half_m.z) ids.push_back(id);
  }
  return ids;
}

std::vector<BodyState> Bodies::states() const {
  std::vector<BodyState> states;
  states.reserve(size());
  for (const auto& [id, body] : state_->bodies) states.push_back(state_of(id, body));
  return states;
}

BodyState Bodies::state(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  return state_of(id, found->second);
}

BodyContacts Bodies::contacts() const {
  BodyContacts contacts;
  const State& s = *state_;
  for (const auto& [id, body] : s.bodies)
    if (body.ground != nullptr && touches(*body.ground)) contacts.on_terrain.push_back(id);
  const btPersistentManifold* const* manifolds = state_->dispatcher.getInternalManifoldPointer();
  for (int i = 0; i < s.dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& manifold = *manifolds[i];
    if (manifold.getBody1() == &s.terrain.object() || !touches(manifold)) continue;
    const float up = manifold.getContactPoint(0).m_normalWorldOnB.y();
    const auto note = [&](const btCollisionObject* upper, const btCollisionObject* lower) {
      note_carried(*upper, *lower, s.bodies.at(id_of(lower)).is_fixed(), contacts);
    };
    if (up > limits::carrying_slope) note(manifold.getBody0(), manifold.getBody1());
    if (up < -limits::carrying_slope) note(manifold.getBody1(), manifold.getBody0());
  }
  sort_and_unite(contacts.on_terrain);
  sort_and_unite(contacts.carried);
  return contacts;
}

std::vector<BodyImpact> Bodies::impacts(float speed_min_m_s) const {
  const State& s = *state_;
  std::vector<BodyImpact> all = list_impacts(s.bodies, s.dispatcher, s.terrain.object(), speed_min_m_s);
  s.blows.merge_into(all, [&](PieceId id) -> std::optional<float> {
    const auto body = s.bodies.find(id);
    if (body == s.bodies.end()) return std::nullopt;
    return speed_min_m_s * body->second.mass_kg;
  });
  return all;
}

const std::vector<TerrainBlow>& Bodies::terrain_blows() const {
  return state_->terrain_blows;
}

void Bodies::give_back(PieceId id, glm::vec3 impulse_n_s, glm::vec3 at_m) {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end() && !found->second.frozen && is_sound(impulse_n_s) && is_sound(at_m));
  Body& body = found->second;
  body.rigid->activate(true);
  body.rigid->applyImpulse(to_bullet(impulse_n_s),
                           to_bullet(at_m) - body.rigid->getWorldTransform().getOrigin());
  limit_speeds(body);
  // What broke bears nothing in the next step: its solver must not begin with this one's impulses.
  if (body.ground == nullptr) return;
  for (int i = 0; i < body.ground->getNumContacts(); ++i)
    body.ground->getContactPoint(i).m_appliedImpulse = 0.0F;
}

float Bodies::mass_kg(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  return found->second.mass_kg;
}

float Bodies::reach_m(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  return found->second.reach_m;
}

int Bodies::steps_a_tick() const {
  return state_->steps_a_tick;
}

bool Bodies::is_awake(PieceId id) const {
  const auto found = state_->bodies.find(id);
  CHECK(found != state_->bodies.end());
  return found->second.rigid->isActive();
}

size_t Bodies::awake() const {
  return static_cast<size_t>(std::ranges::count_if(
      state_->bodies, [](const auto& entry) { return entry.second.rigid->isActive(); }));
}

size_t Bodies::contact_points() const {
  const State& s = *state_;
  const btPersistentManifold* const* manifolds = state_->dispatcher.getInternalManifoldPointer();
  size_t points = 0;
  for (int i = 0; i < s.dispatcher.getNumManifolds(); ++i)
    points += static_cast<size_t>(manifolds[i]->getNumContacts());
  return points;
}

size_t Bodies::pairs() const {
  return static_cast<size_t>(state_->broadphase.m_paircache->getNumOverlappingPairs());
}

size_t Bodies::ground_points() const {
  size_t points = 0;
  for (const auto& [id, body] : state_->bodies)
    if (body.rigid->isActive()) points += body.points_m.size();
  return points;
}

size_t Bodies::overlaps() const {
  return state_->dispatcher.overlaps();
}

void Bodies::describe(PhysicsMessage& to) const {
  for (const auto& [id, body] : state_->bodies) {
    BodyView view{id, !body.frozen && body.rigid->isActive(), body.touches_by_surface, {}};
    if (body.parts.empty()) view.hull_m = corners_of(*body.shape);
    for (const auto& part : body.parts) {
      const std::vector<glm::vec3> corners = corners_of(*part);
      view.hull_m.insert(view.hull_m.end(), corners.begin(), corners.end());
    }
    const glm::mat3 turned = glm::mat3_cast(body.axes);
    for (glm::vec3& corner : view.hull_m) corner = turned * corner + body.given->centre_m;
    to.bodies.push_back(std::move(view));
  }
  list_contacts(state_->dispatcher, to.contacts);
}

void Bodies::release_thread() {
  state_->workers.release_owner();
}

}  // namespace scree
