#include "server/bodies/terrain_body.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "server/bodies/limits.h"
#include "server/bodies/sweep.h"
#include "server/colliders/sound_values.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// How near the ground must be for the body to touch it within the step, as far as a probe sees.
float ground_reach_m(const Body& body, const TerrainSurface& surface) {
  const btRigidBody& rigid = *body.rigid;
  const float speed = rigid.getLinearVelocity().length() + rigid.getAngularVelocity().length() * body.reach_m;
  const float travel_m = std::min(speed * surface.step_s, limits::travel_max_voxels * surface.voxel_size_m);
  return limits::contact_slack_m + body.round.sag_m + travel_m;
}

/// For CHECK_DEBUG: a contact as a TerrainProbe must report it.
bool is_sound_contact(const TerrainContact& contact, size_t points, float reach_m) {
  return contact.point >= 0 && static_cast<size_t>(contact.point) < points && is_sound(contact.offset_m) &&
         is_unit(contact.normal) && std::isfinite(contact.distance_m) && !(contact.distance_m > reach_m);
}

/// Notes whether a prop lies in the terrain with most of its points. Its contacts then push it the way out,
/// if it has one: each by itself would push it another way.
void sink(Body& body, std::vector<TerrainContact>& found) {
  if (body.nature().is_piece()) return;
  const auto is_deep = [](const TerrainContact& contact) {
    return contact.distance_m < -limits::overlap_shallow_m;
  };
  const auto deep = static_cast<size_t>(std::ranges::count_if(found, is_deep));
  body.sinks = body.way_out ? deep > 0 : 2 * deep > body.points_m.size();
  if (!body.sinks || !body.way_out) return;
  for (TerrainContact& contact : found)
    if (contact.distance_m < 0.0F) contact.normal = *body.way_out;
}

}  // namespace

TerrainBody::TerrainBody(Field& field, TerrainColliderKind kind, PairDispatcher& dispatcher,
                         const TerrainSurface& surface)
    : field_(field),
      dispatcher_(dispatcher),
      surface_(surface),
      collider_(make_terrain_collider(kind, field)) {
  object_.setCollisionShape(&shape_);
  // Asleep, so that it wakes nothing that touches it.
  object_.forceActivationState(ISLAND_SLEEPING);
  // Contacts are put in order by broadphase proxy; the terrain is in no broadphase, so it gets one here.
  proxy_.m_uniqueId = 0;
  proxy_.m_clientObject = &object_;
  object_.setBroadphaseHandle(&proxy_);
}

void TerrainBody::add_contacts(Body& body) {
  CHECK(body.ground == nullptr);
  body.ground = dispatcher_.getNewManifold(body.rigid.get(), &object_);
}

void TerrainBody::remove_contacts(Body& body) {
  if (body.ground != nullptr) dispatcher_.releaseManifold(std::exchange(body.ground, nullptr));
}

void TerrainBody::set_collider(TerrainColliderKind kind, std::map<PieceId, Body>& bodies) {
  // Each probe is replaced before its collider is destroyed.
  const std::unique_ptr<TerrainCollider> old = std::exchange(collider_, make_terrain_collider(kind, field_));
  for (auto& [id, body] : bodies) attach(body);
}

void TerrainBody::turn(Body& body) const {
  const btRigidBody& rigid = *body.rigid;
  body.hulls->begin_step();
  body.hulls->turn(from_bullet(rigid.getWorldTransform().getBasis()));
  body.awake = rigid.isActive() && body.meets_terrain();
  body.needs_copy = false;
  if (rigid.isActive()) body.last = rigid.getWorldTransform();
  if (!body.awake) return;
  body.needs_copy = !body.probe->turn(from_bullet(rigid.getWorldTransform()), ground_reach_m(body, surface_));
}

void TerrainBody::refill(std::span<Body*> some, bool copying) const {
  std::vector<TerrainContact> found;
  for (Body* body : some) {
    if (!body->awake || body->needs_copy != copying) continue;
    found.clear();
    body->probe->list(found);
    CHECK_DEBUG(std::ranges::all_of(found, [&](const TerrainContact& contact) {
      return is_sound_contact(contact, body->points_m.size(), ground_reach_m(*body, surface_));
    }));
    touch_as_round(*body, found);
    sink(*body, found);
    stop_at_blows(*body, {surface_.voxel_size_m, surface_.step_s}, found);
    body->rubs_at_m = scree::refill(*body->ground, *body->rigid, found, surface_);
  }
}

void TerrainBody::roughen(std::span<Body*> some, const Palette& palette) const {
  for (Body* body : some) {
    if (!body->awake || body->ground->getNumContacts() == 0) continue;
    scree::roughen(*body->ground, *body->rigid, palette.row_or_first(material_at(field_, body->rubs_at_m)));
  }
}

}  // namespace scree
