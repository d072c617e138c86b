// What one client is told of its own store (Stores in proto/store.proto).
#pragma once

#include "server/publish/outgoing.h"
#include "server/publish/served_tick.h"

namespace scree {

class StoreStream {
 public:
  /// Whose store is the client's; before, it has none.
  void set_own(const StoreName& own) { own_ = own; }
  /// The store, where it is another than the client was told.
  void serve(const ServedTick& tick, Outlet& outlet, ServedPart& part);

 private:
  StoreName own_;
  MaterialMasses told_;
};

}  // namespace scree
