#include "server/formats/world_stores.h"

#include <fmt/format.h>

#include "proto/content_codec.h"
#include "proto/store_codec.h"

namespace scree {

void write_world_stores(kept::Moment& to, const WorldMoment& from) {
  for (const StoreRecord& store : from.stores) {
    kept::Store& added = *to.add_stores();
    write(*added.mutable_content(), store.content);
    added.set_dug(store.dug);
    added.set_at(store.dug_at);
  }
}

void read_world_stores(const kept::Moment& from, WorldMoment& to, FieldChecker& check) {
  if (static_cast<size_t>(from.stores_size()) > limits::stores_max)
    return check.refuse(fmt::format("{} stores are over the limit of {} (limits.stores_max)",
                                    from.stores_size(), limits::stores_max));
  for (const kept::Store& one : from.stores()) {
    if (check.failed()) return;
    StoreRecord store{read(one.content(), check), ledger_mass(one.dug(), check), one.at()};
    if (store.dug < 0) check.refuse("less than nothing was dug");
    if (!to.stores.empty() && !(to.stores.back().content.store < store.content.store))
      check.refuse("stores are not in order");
    to.stores.push_back(std::move(store));
  }
}

}  // namespace scree
