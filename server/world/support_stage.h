// Terrain that is too heavy for what holds it breaks off (shared/falling/support_search.h).
//
// Around every brick that changed, whatever changed it, what holds is searched: changes near each other in
// one search, one search a tick at least and more as the tick's budget goes; what waits is counted. The neck
// of a mass that is too heavy is crushed by an ordinary carve, and what hung on it is an island of the next
// tick. Every break takes rock away, so that it ends. While islands wait, to be searched or to fall, nothing
// is known of what holds: then all of it waits.
//
// Switched off (Methods::support, or Methods::islands, without which nothing would fall), changes are not
// remembered: what was left standing meanwhile stands until something touches it again.
#pragma once

#include "server/world/world_state.h"

namespace scree {

/// After the tick's islands fell.
void break_overloads(World::State& state, TickDelta& delta);

}  // namespace scree
