#include "server/publish/store_stream.h"

namespace scree {

void StoreStream::serve(const ServedTick& tick, Outlet& outlet, ServedPart& part) {
  const PublishedStores& stores = tick.changes.state.stores();
  if ((stores.empty() && told_.empty()) || own_.kind == StoreKind::own) return;
  const auto found = stores.find(own_);
  const MaterialMasses masses = found == stores.end() ? MaterialMasses() : found->second;
  if (masses == told_) return;
  told_ = masses;
  outlet.send(share(StoresMessage{{{own_, masses}}}), part);
}

}  // namespace scree
