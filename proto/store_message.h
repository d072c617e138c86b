// What sessions are told of stores (proto/store.proto).
#pragma once

#include <vector>

#include "shared/operation/store.h"

namespace scree {

/// As they stand; at most limits::stores_a_message.
struct StoresMessage {
  std::vector<StoreContent> stores;
};

}  // namespace scree
