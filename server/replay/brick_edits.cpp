#include "server/replay/brick_edits.h"

#include <algorithm>
#include <set>
#include <vector>

namespace scree {

namespace {

using PatchesByChunk = std::map<ChunkCoord, std::vector<const BrickPatch*>>;

uint64_t hash_of(const std::vector<const BrickPatch*>& bricks) {
  uint64_t hash = 0;
  for (const BrickPatch* patch : bricks) hash += brick_hash(patch->coord, patch->brick, patch->materials);
  return hash;
}

void set_edit(Field& field, BrickCoord brick, const PaintedBrick& edit) {
  field.set_brick(brick, edit.brick, edit.materials);
}

/// A field forgets whole chunks: the other bricks are set again.
void forget_bricks(Field& field, ChunkCoord chunk, const std::set<BrickCoord>& gone) {
  std::vector<std::pair<BrickCoord, PaintedBrick>> kept;
  for (const BrickCoord brick : field.edited_bricks(chunk))
    if (!gone.contains(brick)) kept.emplace_back(brick, *edit_of(field, brick));
  field.forget_chunk(chunk);
  for (const auto& [brick, edit] : kept) set_edit(field, brick, edit);
}

}  // namespace

std::optional<PaintedBrick> edit_of(Field& field, BrickCoord brick) {
  if (!field.is_edited(brick)) return std::nullopt;
  return PaintedBrick{field.brick(brick), field.materials(brick)};
}

BricksBefore edits_within(Field& field, const VoxelBox& voxels) {
  BricksBefore edits;
  for_each_chunk(voxels, [&](ChunkCoord chunk) {
    if (!field.has_edits(chunk)) return;
    for (const BrickCoord brick : field.edited_bricks(chunk)) edits.emplace(brick, edit_of(field, brick));
  });
  return edits;
}

void replace_edits(Field& field, std::span<const BrickPatch> bricks, std::span<const ChunkCoord> unchanged,
                   BricksBefore& before) {
  PatchesByChunk wanted;
  for (const BrickPatch& patch : bricks) wanted[chunk_of(patch.coord)].push_back(&patch);
  for (const ChunkCoord chunk : field.edited_chunks())
    if (!std::ranges::binary_search(unchanged, chunk)) wanted.try_emplace(chunk);
  for (const auto& [chunk, patches] : wanted) {
    if (field.has_edits(chunk) && !patches.empty() && field.chunk_hash(chunk) == hash_of(patches)) continue;
    for (const BrickCoord brick : field.edited_bricks(chunk))
      before.try_emplace(brick, edit_of(field, brick));
    for (const BrickPatch* patch : patches) before.try_emplace(patch->coord, std::nullopt);
    field.forget_chunk(chunk);
    for (const BrickPatch* patch : patches) set_edit(field, patch->coord, {patch->brick, patch->materials});
  }
}

void revert_bricks(Field& field, const BricksBefore& edits, BricksBefore& before) {
  std::map<ChunkCoord, std::set<BrickCoord>> gone;
  for (const auto& [brick, edit] : edits) {
    before.try_emplace(brick, edit_of(field, brick));
    if (edit)
      set_edit(field, brick, *edit);
    else
      gone[chunk_of(brick)].insert(brick);
  }
  for (const auto& [chunk, bricks] : gone) forget_bricks(field, chunk, bricks);
}

void add_differences(Field& field, const BricksBefore& before, TickDelta& delta) {
  for (const auto& [brick, edit] : before) {
    const auto now = edit_of(field, brick);
    if (now == edit) continue;
    if (now)
      delta.bricks.push_back(published_brick(field, brick));
    else
      delta.reverted.push_back(brick);
  }
}

BrickState published_brick(Field& field, BrickCoord coord) {
  auto brick = std::make_shared<const Brick>(field.brick(coord));
  const BrickMaterials materials = field.materials(coord);
  const uint64_t hash = brick_hash(coord, *brick, materials);
  return {coord, std::move(brick), hash, materials};
}

}  // namespace scree
