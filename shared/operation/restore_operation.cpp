#include "shared/operation/restore_operation.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "shared/base/limits.h"
#include "shared/operation/flows.h"
#include "shared/operation/limits.h"

namespace scree {

namespace {

bool is_same(const BrickPatch& a, const BrickPatch& b) {
  return a.coord == b.coord && a.brick == b.brick && a.materials == b.materials;
}

/// What a brick of the field weighs, by material.
void enter_brick(Applied& applied, const Field& field, BrickCoord coord, int sign) {
  const Brick codes = field.brick(coord);
  if (uniform_equivalent(codes) == &air_brick()) return;
  const BrickMaterials says = field.materials(coord);
  const VoxelMaterials said_by_voxels = says.unpacked();
  VoxelMaterials of_ground{};
  if (says.says_ground()) field.ground_materials(coord).unpack(of_ground);
  const RubbleRows& rows = field.rubble();
  std::array<MassUnits, materials_max> masses{};
  for (size_t i = 0; i < said_by_voxels.size(); ++i) {
    const int occupied = occupancy(codes.codes[i]);
    if (occupied == 0) continue;
    const size_t row =
        row_number(material_of(said_by_voxels[i] == ground_own ? of_ground[i] : said_by_voxels[i]));
    masses[row_number(rows.stones[row])] += mass_in_voxel(occupied, rows.fill[row]);
  }
  for (size_t row = 0; row < masses.size(); ++row)
    if (masses[row] != 0) flow_of(applied, static_cast<Material>(row)).terrain += sign * masses[row];
}

bool in_world(BrickCoord brick, float voxel_size_m) {
  const VoxelCoord v = first_voxel(brick);
  const auto beyond = [&](int voxel, float half_m) {
    return std::abs(static_cast<float>(voxel)) * voxel_size_m > half_m;
  };
  return !beyond(v.x, limits::world_half_width_m) && !beyond(v.y, limits::world_half_height_m) &&
         !beyond(v.z, limits::world_half_width_m);
}

}  // namespace

bool RestoreOperation::operator==(const RestoreOperation& other) const {
  if (pieces != other.pieces) return false;
  if (bricks == nullptr || other.bricks == nullptr) return bricks == other.bricks;
  return std::ranges::equal(*bricks, *other.bricks, is_same);
}

VoxelBox restored_box(const RestoreOperation& op) {
  if (op.bricks == nullptr || op.bricks->empty()) return {};
  const ChunkCoord chunk = chunk_of(op.bricks->front().coord);
  const VoxelCoord lo = first_voxel(chunk);
  return {lo, lo + VoxelCoord{chunk_size, chunk_size, chunk_size}};
}

Result<void> validate_restore(const RestoreOperation& op, const PieceTable& pieces, float voxel_size_m) {
  const size_t bricks = op.bricks == nullptr ? 0 : op.bricks->size();
  if (bricks > limits::restored_bricks_max || op.pieces.size() > limits::restored_pieces_max)
    return fail("a restore has more than " + std::to_string(limits::restored_bricks_max) +
                " bricks or pieces (limits.restored_bricks_max)");
  for (size_t i = 0; i < bricks; ++i) {
    const BrickCoord coord = (*op.bricks)[i].coord;
    if (chunk_of(coord) != chunk_of(op.bricks->front().coord))
      return fail("the bricks of a restore are of several chunks");
    if (i > 0 && !((*op.bricks)[i - 1].coord < coord))
      return fail("the bricks of a restore are not in order");
    if (!in_world(coord, voxel_size_m)) return fail("the restore is outside the world");
  }
  for (size_t i = 0; i < op.pieces.size(); ++i) {
    if (!pieces.contains(op.pieces[i])) return fail("there is no piece " + std::to_string(op.pieces[i]));
    if (i > 0 && op.pieces[i - 1] >= op.pieces[i]) return fail("the pieces of a restore are not in order");
  }
  return {};
}

Applied apply_restore(const RestoreOperation& op, Field& field, PieceTable& pieces) {
  Applied applied;
  if (op.bricks != nullptr)
    for (const BrickPatch& patch : *op.bricks) {
      if (field.brick(patch.coord) == patch.brick && field.materials(patch.coord) == patch.materials)
        continue;
      enter_brick(applied, field, patch.coord, -1);
      field.set_brick(patch.coord, patch.brick, patch.materials);
      enter_brick(applied, field, patch.coord, 1);
      applied.changed.push_back(patch.coord);
    }
  for (const MaterialFlow& flow : applied.flows) applied.terrain_gain += flow.terrain;
  for (const PieceId id : op.pieces) enter_piece(applied, *remove_piece(pieces, id), -1);
  for (MaterialFlow& flow : applied.flows) flow.poured = flow.terrain + flow.pieces;
  return applied;
}

}  // namespace scree
