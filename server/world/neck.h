// Necks that break: by weight (support_stage.h) or by a blow (blow_stage.h). Each is crushed by an ordinary
// carve, and the mass beyond it is an island.
#pragma once

#include "server/world/world_state.h"
#include "shared/falling/overload.h"

namespace scree {

/// What a blow gives the pieces of necks that it breaks: no more momentum and energy than it has left.
struct NeckPush {
  glm::vec3 direction{0.0F};  ///< unit
  float speed_m_s = 0.0F;     ///< none is faster
  float momentum_n_s = 0.0F;
  float energy_j = 0.0F;
};

/// A region in which a neck lies that may not be crushed there; null: there is none.
const Region* region_of_necks(const World::State& state, const Overload& overload);

/// Crushes the necks. The pieces part, or move as `push` says, which is then less by what they took. False
/// when there is no room for the pieces under WorldConfig::pieces_max: the rest stands.
bool crush_necks(World::State& state, const Overload& overload, uint64_t party, NeckPush* push,
                 TickDelta& delta);

}  // namespace scree
