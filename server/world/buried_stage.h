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

/// Tells whether a place in the world, in voxels, lies in rock.
using InRock = std::function<bool(glm::vec3 p_voxels)>;

/// The living pieces of which at least half lies where `in_rock` holds, in order of id. Only pieces near
/// `bounds` (voxels) are tested, so `in_rock` must not hold outside of it.
std::vector<PieceId> pieces_within(const World::State& state, const VoxelBox& bounds, const InRock& in_rock);

/// Pieces that lie in a shape that is to be filled become terrain first, so that they do not travel out of
/// it. Returns their number.
uint32_t merge_enclosed(World::State& state, const Shape& shape, TickDelta& delta);

/// Merges buried pieces by the method in the settings: pieces near terrain that gained rock in this tick, and
/// pieces that two tests in a row found buried. At least one, and more as far as the tick's budget goes; the
/// others freeze until their turn. With Recombination::off all of them freeze; they thaw as all frozen pieces
/// do.
void merge_buried(World::State& state, TickDelta& delta);

}  // namespace scree
