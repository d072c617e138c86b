// Slides: rubble that lies steeper than its angle of repose runs down (shared/operation/operation.h,
// SlideOperation).
//
// Every change of the terrain puts its place on a list, by the party that caused it. A tick looks at places
// by the parties' turns, so many and as far as its budget goes; where it has no room, one now and then. A
// place where a cell of rubble or of loose ground lies too steep slides, and is looked at again; any other is
// dropped. Each slide lowers the terrain's centre of mass by a least amount, so that slides come to an end.
// Pieces near a slide wake.
//
// Loose ground slides that nothing but friction holds; soil and clay hold together
// (limits::slide_hanging_max_pa). Undisturbed ground has stood for long, and stays.
#pragma once

#include <optional>

#include "server/world/world_state.h"

namespace scree {

/// Tangent of the angle at which that row comes to rest, in 64ths; nothing where it does not slide.
std::optional<uint8_t> repose_of(const MaterialRow& row);

/// Columns of a cell, along each side, at that size of a voxel.
uint8_t slide_cell(float voxel_size_m);

/// The place of a change in the list: the first of eight bricks.
inline BrickCoord slope_of(BrickCoord brick) {
  return {brick.x & ~1, brick.y & ~1, brick.z & ~1};
}

/// Call after merges, and before drop_islands().
void slide_slopes(World::State& state, TickDelta& delta);

}  // namespace scree
