// What one client is told of other persons' cursors and, if it asked, of the bodies' state. Each only when it
// reads along. One thread at a time.
#pragma once

#include <cstdint>
#include <vector>

#include "server/publish/client_view.h"
#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class PhysicsFeed {
 public:
  /// Whether the client gets PhysicsMessages. Returns whether that has changed.
  bool set_physics(bool on);
  /// The least energy of contacts of which the client gets messages, joules; 0: none.
  void set_contacts(float least_j) { contacts_j_ = least_j; }
  void serve(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part);

 private:
  void send_cursors(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part);
  void send_physics(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part);

  void send_contacts(const ServedTick& tick, const ClientView& view, Outlet& outlet, ServedPart& part) const;

  bool physics_ = false;
  float contacts_j_ = 0.0F;
  int64_t credit_bytes_ = 0;           ///< for physics
  std::vector<PlayerCursor> cursors_;  ///< as the client knows them
};

}  // namespace scree
