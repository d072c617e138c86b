// How edited bricks stood before a replay changed them, so that a jump can be published as what it changed,
// and a tick be taken back. One thread at a time.
#pragma once

#include <map>
#include <optional>
#include <span>

#include "proto/messages.h"
#include "server/world/tick_delta.h"
#include "shared/field/field.h"

namespace scree {

struct PaintedBrick {
  Brick brick;
  BrickMaterials materials{};

  bool operator==(const PaintedBrick& other) const {
    return brick.codes == other.brick.codes && materials == other.materials;
  }
};

/// Nothing: the brick was not edited.
using BricksBefore = std::map<BrickCoord, std::optional<PaintedBrick>>;

/// How the brick stands.
std::optional<PaintedBrick> edit_of(Field& field, BrickCoord brick);

/// How every edited brick of the box stands, in voxels.
BricksBefore edits_within(Field& field, const VoxelBox& voxels);

/// Gives the field these edited bricks and no others, but for chunks that stay as they are (`unchanged`,
/// ordered); those that have their bricks already are left alone. What changes is noted in `before`, unless
/// it is there.
void replace_edits(Field& field, std::span<const BrickPatch> bricks, std::span<const ChunkCoord> unchanged,
                   BricksBefore& before);

/// Takes the field back to how these bricks stood; what that changes is noted in `before`.
void revert_bricks(Field& field, const BricksBefore& edits, BricksBefore& before);

/// Adds to the delta the bricks that differ from how they stood before: TickDelta::bricks and reverted.
void add_differences(Field& field, const BricksBefore& before, TickDelta& delta);

/// A brick as it is published.
BrickState published_brick(Field& field, BrickCoord brick);

}  // namespace scree
