#include "server/world/state_hash.h"

#define XXH_INLINE_ALL
#include <array>
#include <xxhash.h>

namespace scree {

uint64_t state_hash(const HashedState& state) {
  const Ledger& ledger = state.ledger;
  const std::array<uint64_t, 9> words = {state.tick,
                                         state.field,
                                         state.bodies,
                                         state.next_piece,
                                         static_cast<uint64_t>(ledger.terrain),
                                         static_cast<uint64_t>(ledger.pieces),
                                         static_cast<uint64_t>(ledger.dust),
                                         static_cast<uint64_t>(ledger.poured),
                                         static_cast<uint64_t>(ledger.moved)};
  return XXH3_64bits(words.data(), sizeof(words));
}

}  // namespace scree
