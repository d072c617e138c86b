// Support: terrain that is too heavy for its support breaks off (shared/falling/support_search.h).
//
// Every changed brick is searched for support: changes near each other in one search, at least one search a
// tick, and more as far as the tick's budget goes; waiting bricks are counted. The neck of a mass that is too
// heavy is crushed by an ordinary carve, and the mass beyond it is an island of the next tick. Every break
// takes rock away, so that the breaking ends. While searches for islands or islands wait, support is not
// known: then all searches for support wait.
//
// While Methods::support or Methods::islands is off, changes are not remembered: terrain that became too
// heavy meanwhile stands until something touches it again.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// Call after drop_islands().
void break_overloads(World::State& state, TickDelta& delta);

}  // namespace scree
