// A hash of all state that decides how a world continues. `scree-replay verify` and the determinism tests
// compare it at every tick.
#pragma once

#include <cstdint>

#include "server/world/tick_delta.h"

namespace scree {

struct HashedState {
  Tick tick = 0;
  uint64_t field = 0;   ///< Field::hash()
  uint64_t bodies = 0;  ///< Bodies::state_hash()
  PieceId next_piece = 0;
  Ledger ledger;
};

uint64_t state_hash(const HashedState& state);

}  // namespace scree
