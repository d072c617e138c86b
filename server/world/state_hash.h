// A hash of the terrain, of the bodies' exact motion, and of the ledger. What else decides how a world goes
// on, requests that wait or searches, shows in these when it differs. `scree-replay verify` and the
// determinism tests compare the hash at every tick.
#pragma once

#include <cstdint>

#include "server/formats/world_value.h"
#include "server/world/tick_delta.h"
#include "shared/prop/joint.h"
#include "shared/region/region.h"

namespace scree {

struct HashedState {
  Tick tick = 0;
  uint64_t field = 0;   ///< Field::hash()
  uint64_t bodies = 0;  ///< Bodies::state_hash()
  PieceId next_piece = 0;
  Ledger ledger;
  uint64_t props = 0;       ///< sum of hash_of() of the props; 0: there are none
  uint64_t joints = 0;      ///< the same of the joints
  uint64_t kept = 0;        ///< the same of the pieces that are kept
  uint64_t regions = 0;     ///< the same of the regions
  uint64_t persons = 0;     ///< the same of the persons on foot
  uint64_t stores = 0;      ///< the same of the stores
  uint64_t provenance = 0;  ///< the same of mass that has an origin
  uint64_t game = 0;        ///< the same of what a host's rules keep, show and made of persons
};

/// The hash of what a prop is, and whose. Its motion is the bodies'.
uint64_t hash_of(PieceId id, const Prop& prop, uint64_t owner);

/// The same of a joint.
uint64_t hash_of(JointId id, const Joint& joint, uint64_t owner);

/// The hash of a region.
uint64_t hash_of(const Region& region);

/// The hash of a piece that is kept.
uint64_t hash_of_kept(PieceId id);

/// The hash of a person on foot.
uint64_t hash_of(const PersonRecord& person);

/// The hash of what a store holds, and of what counts for its rate.
uint64_t hash_of(const StoreRecord& store);

/// The hashes of what a host's rules keep, show and made of a person.
uint64_t hash_of(const KeptValue& value);
uint64_t hash_of(const Sign& sign);
uint64_t hash_of(const Player& player);

uint64_t state_hash(const HashedState& state);

}  // namespace scree
