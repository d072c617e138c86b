#include "shared/operation/operation.h"

#include <algorithm>
#include <glm/common.hpp>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/falling/island.h"
#include "shared/field/edit.h"
#include "shared/field/material_changes.h"
#include "shared/field/paint.h"
#include "shared/fracture/material_shares.h"
#include "shared/fracture/seeds.h"
#include "shared/operation/edit_operations.h"
#include "shared/operation/flows.h"
#include "shared/operation/prepared_stamp.h"
#include "shared/operation/restore_operation.h"
#include "shared/operation/shatter_operation.h"
#include "shared/operation/slide_operation.h"
#include "shared/recombine/stamp_materials.h"

namespace scree {

namespace {

/// The cut's pieces go into the table, from that id on.
void enter(Cut cut, PieceId id, PieceTable& pieces, Applied& applied) {
  for (CutPiece& piece : cut.pieces) {
    enter_piece(applied, piece.volume, 1);
    pieces[id] = std::make_shared<const Volume>(std::move(piece.volume));
    applied.created.push_back({id, std::move(piece.seeds)});
    ++id;
  }
  applied.dust = cut.dust;
}

MassUnits mass_created(const Applied& applied, const PieceTable& pieces) {
  MassUnits sum = 0;
  for (const CreatedPiece& created : applied.created) sum += pieces.at(created.id)->mass;
  return sum;
}

std::vector<glm::vec3> seeds_of(const CarveOperation& op, const Window& volume, float voxel_size_m) {
  if (is_drawn(op.pattern))
    return scatter_seeds(volume, op.pattern, first_seeds(op), op.random_seed, op.impact_m / voxel_size_m);
  std::vector<glm::vec3> points;
  for (const glm::vec3& point_m : op.authored_m) points.push_back(point_m / voxel_size_m);
  return authored_seeds(volume, points, op.random_seed);
}

Applied apply_carve(const CarveOperation& carve_op, Field& field, PieceTable& pieces) {
  const float dx = field.source().voxel_size_m;
  CarvedTerrain carved = carved_terrain(carve_op.shape, field);
  const Window volume = extract(carved.before, carved.solid);
  Applied applied;
  applied.seeds_voxels = seeds_of(carve_op, volume, dx);
  Cut cut = cut_volume(carve_op.cutter, volume, std::move(carved.lost_at), applied.seeds_voxels);
  enter_lost(carved, applied);
  share_materials(cut, carved.rock.stones, carved.lost);
  finish_cut(cut, carve_op, carve_op.impact_m / dx);
  enter(std::move(cut), carve_op.first_piece, pieces, applied);
  applied.changed = scatter(field, carved.after);
  CHECK_EQ(mass_created(applied, pieces) + applied.dust, -applied.terrain_gain);
  return applied;
}

using Volumes = std::vector<std::shared_ptr<const Volume>>;

std::vector<MergedPiece> merged_pieces(const StampOperation& op, const Volumes& volumes) {
  std::vector<MergedPiece> merged{{*volumes.front(), op.pose}};
  for (size_t i = 0; i < op.others.size(); ++i) merged.push_back({*volumes[i + 1], op.others[i].pose});
  return merged;
}

/// The terrain around the pieces, and the same merged with them.
struct Stamped {
  Window before, after;
};

Stamped stamped(const StampOperation& op, const Field& field, const Volumes& volumes) {
  const float dx = field.source().voxel_size_m;
  const Volume& volume = *volumes.front();
  const bool whole = !lays(op.method);
  const Window laid = whole ? Window() : lay_all(op, volumes, dx);
  Stamped made;
  made.before = gather(field, whole ? stamp_box(op.method, volume, op.pose, dx) : merge_box(laid));
  made.after = made.before;
  if (whole) {
    stamp(op.method, made.after, volume, op.pose, dx, op.shift);
    return made;
  }
  MassUnits mass = 0;
  for (const auto& one : volumes) mass += one->mass;
  stamp_laid(laying_of(op.method), made.after, laid, mass, op.shift,
             merge_fills(MaterialReader(field, made.before.box), field.rubble(), merged_pieces(op, volumes),
                         op.brings, dx));
  return made;
}

/// Whether stamping now gives the same result as the prepared stamp.
bool gives(const StampOperation& op, const Field& field, const Volumes& volumes,
           const PreparedStamp& prepared) {
  const Stamped made = stamped(op, field, volumes);
  return made.before.codes == prepared.before.codes && made.after.codes == prepared.after.codes;
}

Applied apply_stamp(const StampOperation& op, Field& field, PieceTable& pieces,
                    const PreparedStamp* prepared) {
  Volumes volumes{remove_piece(pieces, op.piece)};
  for (const StampedPiece& other : op.others) volumes.push_back(remove_piece(pieces, other.piece));
  Applied applied;
  for (const auto& volume : volumes) enter_piece(applied, *volume, -1);
  Stamped computed;
  const bool holds = prepared != nullptr && prepared->holds(op, field, volumes);
  if (holds)
    CHECK_DEBUG(gives(op, field, volumes, *prepared));
  else
    computed = stamped(op, field, volumes);
  const Window& before = holds ? prepared->before : computed.before;
  const Window& after = holds ? prepared->after : computed.after;
  const MaterialReader were(field, after.box);
  const std::vector<MergedPiece> merged = merged_pieces(op, volumes);
  const RubbleRows& rows = field.rubble();
  const auto one = were.uniform();
  const bool stays =
      one && rows.fill[row_number(*one)] == fill_solid &&
      (op.brings == Brings::nothing || (are_all_of(merged, *one) && (op.brings == Brings::materials ||
                                                                     rows.rubble[row_number(*one)] == *one)));
  if (stays) {
    applied.terrain_gain = mass_of(after) - mass_of(before);
    flow_of(applied, *one).terrain += applied.terrain_gain;
    applied.changed = scatter(field, after);
  } else {
    const AddedMaterials added =
        merge_materials(were, rows, before, after, merged, op.brings, field.source().voxel_size_m);
    applied.terrain_gain = sum_of(added.gains);
    write_terrain(field, after, added, applied);
  }
  if (holds) CHECK_EQ(applied.terrain_gain, prepared->gain);
  return applied;
}

Applied apply_discard(const DiscardOperation& op, PieceTable& pieces) {
  const std::shared_ptr<const Volume> volume = remove_piece(pieces, op.piece);
  Applied applied;
  applied.dust = volume->mass;
  enter_piece(applied, *volume, -1);
  return applied;
}

Applied apply_shatter(const ShatterOperation& op, float voxel_size_m, PieceTable& pieces) {
  const std::shared_ptr<const Volume> volume = remove_piece(pieces, op.piece);
  Applied applied;
  Cut cut = cut_of(op, *volume, voxel_size_m, applied);
  enter_piece(applied, *volume, -1);
  enter(std::move(cut), op.first_piece, pieces, applied);
  CHECK_EQ(mass_created(applied, pieces) + applied.dust, volume->mass);
  return applied;
}

/// The materials of an island, and its mass by material: what the terrain lost.
void give_materials(Volume& volume, const Window& before, const Window& after, const RockWindow& rock,
                    Applied& applied) {
  MaterialMasses lost = masses_lost(before, after, rock);
  for (const MaterialMass& one : lost) flow_of(applied, one.material).terrain -= one.mass;
  // Redistancing may add a little to what stays. The piece has no less than nothing of any material.
  const auto most = std::ranges::max_element(lost, {}, &MaterialMass::mass);
  for (MaterialMass& one : lost) {
    if (one.mass >= 0) continue;
    most->mass += one.mass;
    one.mass = 0;
  }
  std::erase_if(lost, [](const MaterialMass& one) { return one.mass == 0; });
  if (lost.size() == 1) {
    volume.materials.all = lost.front().material;
    return;
  }
  volume.materials = part_of(rock.stones, volume.window.box);
  volume.masses = std::move(lost);
}

Applied apply_island(const IslandOperation& op, Field& field, PieceTable& pieces) {
  Window window = gather(field, lift_box(op.box));
  const RockWindow rock = rock_of(gather_materials(field, window.box), field.rubble());
  const bool one = rock.stones.is_uniform() && rock.fills.is_solid();
  const Window before = one ? Window() : window;
  Volume volume = lift(window, op.box, op.start);
  volume.materials.all = rock.stones.all;
  if (!rock.fills.is_solid()) volume.mass = sum_of(masses_lost(before, window, rock));
  Applied applied;
  applied.terrain_gain = -volume.mass;
  if (one)
    enter_terrain(applied, {{rock.stones.all, applied.terrain_gain}});
  else
    give_materials(volume, before, window, rock, applied);
  applied.changed = scatter(field, window);
  if (volume.mass < limits::piece_mass_min) {
    applied.dust = volume.mass;
    return applied;
  }
  pieces[op.piece] = std::make_shared<const Volume>(std::move(volume));
  enter_piece(applied, *pieces[op.piece], 1);
  applied.created.push_back({op.piece, {}});
  return applied;
}

/// What a voxel becomes by paint, which adds no mass and takes none: rubble stays rubble, of other stones,
/// and what is solid stays solid. Where that cannot be, the voxel stays what it was.
Material painted(const RubbleRows& rows, Material was, Material paint) {
  const Material stones = rows.stones[row_number(paint)];
  const bool is_rubble = rows.fill[row_number(was)] != fill_solid;
  const Material is = is_rubble ? rows.rubble[row_number(stones)] : stones;
  return rows.fill[row_number(is)] == rows.fill[row_number(was)] ? is : was;
}

/// What paint makes of the voxels with rock that `within` holds: changes, and what they weigh by material.
template <typename F>
AddedMaterials paint_of(const MaterialReader& were, const RubbleRows& rows, const Window& codes,
                        Material material, F&& within) {
  std::vector<uint8_t> solid(codes.codes.size());
  std::transform(codes.codes.begin(), codes.codes.end(), solid.begin(),
                 [](Code code) { return static_cast<uint8_t>(occupancy(code)); });
  AddedMaterials added;
  MaterialChanges changes(were);
  changes.change(solid, [&](VoxelCoord voxel, size_t at, Material was) {
    const Material is = painted(rows, was, material);
    if (was == is || !within(voxel)) return was;
    const int occupied = occupancy(codes.codes[at]);
    const auto enter = [&](Material one, int sign) {
      const size_t row = row_number(one);
      add(added.gains, rows.stones[row], sign * mass_in_voxel(occupied, rows.fill[row]));
    };
    enter(was, -1);
    enter(is, 1);
    return is;
  });
  added.says = changes.says();
  return added;
}

Applied apply_paint(const PaintOperation& op, Field& field) {
  const Shape shape = in_voxels(op.shape, field.source().voxel_size_m);
  const Window codes = gather(field, op.whole_bricks ? paint_box(shape) : band_box(shape));
  const std::vector<BrickCoord> bricks = op.whole_bricks ? bricks_of(shape) : std::vector<BrickCoord>();
  const AddedMaterials added =
      paint_of(MaterialReader(field, codes.box), field.rubble(), codes, op.material, [&](VoxelCoord voxel) {
        if (op.whole_bricks) return std::ranges::binary_search(bricks, brick_of(voxel));
        return distance(shape, glm::vec3(voxel.x, voxel.y, voxel.z)) <= 0.0F;
      });
  Applied applied;
  applied.changed =
      op.whole_bricks ? paint_bricks(field, shape, op.material) : scatter(field, codes, added.says);
  for (const MaterialMass& gain : added.gains) {
    MaterialFlow& flow = flow_of(applied, gain.material);
    flow.terrain += gain.mass;
    flow.converted += gain.mass;
  }
  return applied;
}

/// The volumes of the stamp's pieces, all of which must be in the table.
VoxelBox box_of(const StampOperation& op, const PieceTable& pieces, float voxel_size_m) {
  const auto one = [&](PieceId piece, const QuantisedPose& pose) {
    const auto found = pieces.find(piece);
    CHECK(found != pieces.end());
    return stamp_box(op.method, *found->second, pose, voxel_size_m);
  };
  VoxelBox box = one(op.piece, op.pose);
  for (const StampedPiece& other : op.others) box = hull_of(box, one(other.piece, other.pose));
  return box;
}

}  // namespace

bool can_merge_together(std::span<const StampedPiece> group, const PieceTable& pieces) {
  CHECK(!group.empty());
  if (group.size() > limits::stamp_group_max) return false;
  const glm::vec3 first_m = dequantise(group.front().pose).position_m;
  return std::ranges::all_of(group, [&](const StampedPiece& one) {
    const VoxelCoord size = pieces.at(one.piece)->window.box.size();
    const glm::vec3 off_m = glm::abs(dequantise(one.pose).position_m - first_m);
    return std::max({size.x, size.y, size.z}) <= limits::stamp_group_side_max_voxels &&
           std::max({off_m.x, off_m.y, off_m.z}) <= limits::stamp_group_reach_max_m;
  });
}

VoxelBox read_box(const Operation& operation, const PieceTable& pieces, float voxel_size_m) {
  const auto around = [&](const Shape& shape) { return band_box(in_voxels(shape, voxel_size_m)); };
  return std::visit(Overloaded{
                        [&](const CarveOperation& op) { return around(op.shape); },
                        [&](const FillOperation& op) { return around(op.shape); },
                        [&](const StampOperation& op) { return box_of(op, pieces, voxel_size_m); },
                        [](const DiscardOperation&) { return VoxelBox{}; },
                        [](const ShatterOperation&) { return VoxelBox{}; },
                        [](const IslandOperation& op) { return lift_box(op.box); },
                        [&](const PaintOperation& op) {
                          return op.whole_bricks ? paint_box(in_voxels(op.shape, voxel_size_m))
                                                 : around(op.shape);
                        },
                        [](const SlideOperation& op) { return slide_window(op.box); },
                        [&](const DigOperation& op) { return op.piece != 0 ? VoxelBox{} : around(op.shape); },
                        [&](const PlaceOperation& op) { return around(op.shape); },
                        [](const RestoreOperation& op) { return restored_box(op); },
                    },
                    operation);
}

Applied apply(const Operation& operation, Field& field, PieceTable& pieces, const PreparedStamp* prepared) {
  return std::visit(
      Overloaded{
          [&](const CarveOperation& op) { return apply_carve(op, field, pieces); },
          [&](const FillOperation& op) { return apply_fill(op, field); },
          [&](const StampOperation& op) { return apply_stamp(op, field, pieces, prepared); },
          [&](const DiscardOperation& op) { return apply_discard(op, pieces); },
          [&](const ShatterOperation& op) { return apply_shatter(op, field.source().voxel_size_m, pieces); },
          [&](const IslandOperation& op) { return apply_island(op, field, pieces); },
          [&](const PaintOperation& op) { return apply_paint(op, field); },
          [&](const SlideOperation& op) { return apply_slide(op, field); },
          [&](const DigOperation& op) { return apply_dig(op, field, pieces); },
          [&](const PlaceOperation& op) { return apply_place(op, field); },
          [&](const RestoreOperation& op) { return apply_restore(op, field, pieces); },
      },
      operation);
}

Window carved_volume(Field& field, const Shape& shape) {
  const Shape in_field = in_voxels(shape, field.source().voxel_size_m);
  const Window before = gather(field, band_box(in_field));
  return extract(before, codes_of(in_field, before.box));
}

}  // namespace scree
