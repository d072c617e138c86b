#include "shared/operation/edit_operations.h"

#include "shared/field/edit.h"
#include "shared/fracture/material_shares.h"
#include "shared/operation/flows.h"

namespace scree {

namespace {

/// The terrain with a shape filled, and what that adds.
struct FilledTerrain {
  Window after;
  AddedMaterials added;
};

FilledTerrain filled_terrain(const Shape& shape, std::optional<Material> material, const Field& field) {
  const Shape in_field = in_voxels(shape, field.source().voxel_size_m);
  const Window before = gather(field, band_box(in_field));
  FilledTerrain filled{before, {}};
  fill(filled.after, codes_of(in_field, before.box));
  filled.added =
      fill_materials(MaterialReader(field, before.box), field.rubble(), before, filled.after, material);
  return filled;
}

}  // namespace

CarvedTerrain carved_terrain(const Shape& shape, const Field& field) {
  const Shape in_field = in_voxels(shape, field.source().voxel_size_m);
  CarvedTerrain carved;
  carved.before = gather(field, band_box(in_field));
  carved.solid = codes_of(in_field, carved.before.box);
  carved.after = carved.before;
  carve(carved.after, carved.solid);
  carved.rock = rock_of(gather_materials(field, carved.before.box), field.rubble());
  carved.lost_at = mass_changes(carved.before.codes, carved.after.codes, carved.rock.fills);
  carved.lost = masses_lost(carved.lost_at, carved.rock.stones);
  return carved;
}

void enter_lost(const CarvedTerrain& carved, Applied& applied) {
  for (const MaterialMass& one : carved.lost) flow_of(applied, one.material).terrain -= one.mass;
  applied.terrain_gain = -sum_of(carved.lost);
}

Applied apply_fill(const FillOperation& op, Field& field) {
  const FilledTerrain filled = filled_terrain(op.shape, op.material, field);
  Applied applied;
  applied.terrain_gain = sum_of(filled.added.gains);
  if (op.material)
    flow_of(applied, field.rubble().stones[row_number(*op.material)]).poured += applied.terrain_gain;
  else
    for (const MaterialMass& gain : filled.added.gains) flow_of(applied, gain.material).poured += gain.mass;
  write_terrain(field, filled.after, filled.added, applied);
  return applied;
}

Applied apply_dig(const DigOperation& op, Field& field, PieceTable& pieces) {
  Applied applied;
  if (op.piece != 0) {
    const std::shared_ptr<const Volume> volume = remove_piece(pieces, op.piece);
    enter_piece(applied, *volume, -1);
    for (MaterialFlow& flow : applied.flows) flow.stored = -flow.pieces;
    applied.stored = volume->mass;
    return applied;
  }
  const CarvedTerrain carved = carved_terrain(op.shape, field);
  enter_lost(carved, applied);
  for (MaterialFlow& flow : applied.flows) flow.stored = -flow.terrain;
  applied.stored = -applied.terrain_gain;
  applied.changed = scatter(field, carved.after);
  return applied;
}

Applied apply_place(const PlaceOperation& op, Field& field) {
  const FilledTerrain filled = filled_terrain(op.shape, op.material, field);
  Applied applied;
  applied.terrain_gain = sum_of(filled.added.gains);
  applied.stored = -applied.terrain_gain;
  flow_of(applied, field.rubble().stones[row_number(op.material)]).stored += applied.stored;
  write_terrain(field, filled.after, filled.added, applied);
  return applied;
}

MassUnits mass_dug(const DigOperation& operation, const Field& field) {
  return sum_of(carved_terrain(operation.shape, field).lost);
}

MassUnits mass_placed(const PlaceOperation& operation, const Field& field) {
  return sum_of(filled_terrain(operation.shape, operation.material, field).added.gains);
}

}  // namespace scree
