// Terrain that is too heavy for what holds it breaks off (shared/field/support_search.h).
//
// Around every brick that changed, whatever changed it, what holds is searched: changes near each other in
// one search, one search a tick at least and more as the tick's budget goes; what waits is counted. The neck
// of a mass that is too heavy is crushed by an ordinary carve, and what hung on it is an island then. Every
// break takes rock away, so that it ends.
//
// Switched off (Methods::support, or Methods::islands, without which nothing would fall), changes are not
// remembered: what was left standing meanwhile stands until something touches it again.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// After all other changes of the tick, before its islands are looked for.
void break_overloads(World::State& state, TickDelta& delta);

}  // namespace scree
