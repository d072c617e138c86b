// Lists the blows of bodies on terrain in a step, with the speed that each contact took, for what breaks by
// them. Private to this folder.
#pragma once

#include <map>
#include <vector>

#include "server/bodies/body.h"

namespace scree {

/// The blows of a step that took at least that speed, which is positive; ordered by id. Call after the
/// solver: Body::speed_before and spin_before are those of the step's start.
std::vector<TerrainBlow> list_terrain_blows(const std::map<PieceId, Body>& bodies,
                                            const btDispatcher& dispatcher, float speed_min_m_s);

/// Adds a step's blows to those of a tick's earlier ones: the one of most energy stays of each body.
void keep_strongest(std::vector<TerrainBlow>& kept, const std::vector<TerrainBlow>& more);

}  // namespace scree
