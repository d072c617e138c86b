#include "server/publish/physics_feed.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <utility>

#include "server/publish/interest_filter.h"
#include "server/world/world.h"

namespace scree {

bool PhysicsFeed::set_physics(bool on) {
  return std::exchange(physics_, on) != on;
}

void PhysicsFeed::serve(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part) {
  if (tick.tick() % ticks_per_physics == 0) send_cursors(tick, view, outlet, part);
  if (physics_ && tick.changes.delta.physics) send_physics(tick, view, outlet, part);
  if (contacts_j_ > 0.0F && !tick.changes.delta.contacts.empty()) send_contacts(tick, view, outlet, part);
}

void PhysicsFeed::send_contacts(const ServedTick& tick, const ClientView& view, Outlet& outlet,
                                ServedPart& part) const {
  ContactsMessage message{tick.tick(), {}};
  for (const ContactEvent& contact : tick.changes.delta.contacts)
    if (contact.energy_j >= contacts_j_ && glm::distance(contact.place_m, view.eye_m()) <= view.radius_m())
      message.contacts.push_back(contact);
  if (!message.contacts.empty() && outlet.room_bytes() > 0) outlet.send(share(message), part);
}

void PhysicsFeed::send_cursors(const ServedTick& tick, const ClientView& view, Outlet& outlet,
                               ServedPart& part) {
  std::vector<PlayerCursor> now = cursors_for(outlet.session(), tick.cursors, view.eye_m(), view.radius_m());
  if (now == cursors_) return;
  cursors_ = now;
  outlet.send(share(CursorsMessage{std::move(now)}), part);
}

void PhysicsFeed::send_physics(const ServedTick& tick, const ClientView& view, Outlet& outlet,
                               ServedPart& part) {
  constexpr int64_t budget = limits::physics_bytes_per_tick * int64_t{ticks_per_physics};
  credit_bytes_ = std::min(credit_bytes_ + budget, budget);
  if (credit_bytes_ <= 0 || outlet.room_bytes() <= 0) return;
  const PhysicsMessage near = physics_for(*tick.changes.delta.physics, tick.changes.state,
                                          tick.changes.voxel_size_m, view.eye_m(), view.radius_m());
  const SharedBytes bytes = share(near);
  credit_bytes_ -= size_of(bytes);
  outlet.send(bytes, part);
}

}  // namespace scree
