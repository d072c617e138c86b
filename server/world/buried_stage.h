// Buried pieces: pieces that a merge or a fill enclosed in rock, or that got stuck in it. They become terrain
// where they lie, so that no piece travels through rock. Their mass goes where any merged piece's mass goes:
// into the terrain as far as the rock around them leaves room, and into dust otherwise.
//
// A piece counts as buried when at least half of it (limits::buried_share) lies deeper than one voxel in
// rock. The field alone decides, whatever the terrain collider. Deterministic; simulation thread.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <vector>

#include "server/world/world_state.h"

namespace scree {

/// A place in the world, in voxels.
using InRock = std::function<bool(glm::vec3 p_voxels)>;

/// The pieces alive, in order of id, at least half of whose volume lies where `in_rock` holds. Only pieces
/// whose bounding sphere meets `bounds` (voxels) are looked at.
std::vector<PieceId> pieces_within(const World::State& state, const VoxelBox& bounds, const InRock& in_rock);

/// Pieces around terrain that gained rock in this tick, and pieces that stayed buried between two looks,
/// become terrain by the method that the settings name, as many as the tick's budget allows and one at least;
/// the others stand still until their turn comes. With recombination off all of them stand still.
void merge_buried(World::State& state, TickDelta& delta);

}  // namespace scree
