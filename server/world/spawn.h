// New pieces become bodies.
#pragma once

#include <functional>

#include "server/world/world_state.h"

namespace scree {

/// How a new piece starts out; `body.id` is filled in by spawn().
struct Newborn {
  BodyState body;
  PieceTraits traits;
  bool may_be_concave = false;  ///< touches the ground with its own surface, not with its hull's
};

/// Each piece that the operation made gets a hull, a body and its traits, is entered in the delta, and uses
/// up its id. Call right after apply_and_record().
void spawn(World::State& state, const Applied& applied,
           const std::function<Newborn(PieceId, const Volume&)>& born, TickDelta& delta);

}  // namespace scree
