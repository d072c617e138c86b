#include "shared/operation/operation.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "shared/base/check.h"
#include "shared/base/limits.h"
#include "shared/base/overloaded.h"
#include "shared/falling/island.h"
#include "shared/field/edit.h"
#include "shared/field/paint.h"
#include "shared/fracture/seeds.h"
#include "shared/fracture/shatter.h"
#include "shared/operation/prepared_stamp.h"

namespace scree {

namespace {

bool in_world(glm::vec3 p) {
  return std::abs(p.x) <= limits::world_half_width_m && std::abs(p.z) <= limits::world_half_width_m &&
         std::abs(p.y) <= limits::world_half_height_m;
}

/// The cut's pieces go into the table, from that id on.
template <typename MaterialOf>
void enter(Cut cut, PieceId id, MaterialOf&& material_of, PieceTable& pieces, Applied& applied) {
  for (CutPiece& piece : cut.pieces) {
    piece.volume.material = material_of(piece.volume);
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
    return scatter_seeds(volume, op.pattern, op.seeds, op.random_seed, op.impact_m / voxel_size_m);
  std::vector<glm::vec3> points;
  for (const glm::vec3& point_m : op.authored_m) points.push_back(point_m / voxel_size_m);
  return authored_seeds(volume, points, op.random_seed);
}

Applied apply_carve(const CarveOperation& carve_op, Field& field, PieceTable& pieces) {
  const float dx = field.source().voxel_size_m;
  const Shape shape = in_voxels(carve_op.shape, dx);
  const Window before = gather(field, band_box(shape));
  const Window solid = codes_of(shape, before.box);
  Window after = before;
  carve(after, solid);
  const Window volume = extract(before, solid);
  Applied applied;
  applied.seeds_voxels = seeds_of(carve_op, volume, dx);
  const auto material_of = [&](const Volume& piece) { return material_at(field, piece.centre_voxels * dx); };
  enter(cut_volume(carve_op.cutter, volume, before, after, applied.seeds_voxels), carve_op.first_piece,
        material_of, pieces, applied);
  applied.changed = scatter(field, after);
  applied.terrain_gain = mass_of(after) - mass_of(before);
  CHECK_EQ(mass_created(applied, pieces) + applied.dust, -applied.terrain_gain);
  return applied;
}

Applied apply_fill(const FillOperation& fill_op, Field& field) {
  const Shape shape = in_voxels(fill_op.shape, field.source().voxel_size_m);
  Window window = gather(field, band_box(shape));
  Applied applied;
  applied.terrain_gain = -mass_of(window);
  fill(window, codes_of(shape, window.box));
  applied.terrain_gain += mass_of(window);
  applied.changed = scatter(field, window);
  return applied;
}

std::shared_ptr<const Volume> remove_piece(PieceTable& pieces, PieceId id) {
  const auto found = pieces.find(id);
  CHECK(found != pieces.end());
  std::shared_ptr<const Volume> volume = std::move(found->second);
  pieces.erase(found);
  return volume;
}

using Volumes = std::vector<std::shared_ptr<const Volume>>;

/// The terrain around the pieces, merged with them, and its gain of mass.
Window stamped(const StampOperation& op, Field& field, const Volumes& volumes, MassUnits& gain) {
  const float dx = field.source().voxel_size_m;
  const Volume& volume = *volumes.front();
  const bool whole = !lays(op.method);
  const Window laid = whole ? Window() : lay_all(op, volumes, dx);
  Window window = gather(field, whole ? stamp_box(op.method, volume, op.pose, dx) : merge_box(laid));
  const MassUnits before = mass_of(window);
  if (whole) {
    stamp(op.method, window, volume, op.pose, dx, op.shift);
  } else {
    MassUnits mass = 0;
    for (const auto& one : volumes) mass += one->mass;
    stamp_laid(laying_of(op.method), window, laid, mass, op.shift);
  }
  gain = mass_of(window) - before;
  return window;
}

/// Whether stamping now gives the same result as the prepared stamp.
bool gives(const StampOperation& op, Field& field, const Volumes& volumes, const PreparedStamp& prepared) {
  MassUnits gain = 0;
  return stamped(op, field, volumes, gain).codes == prepared.after.codes && gain == prepared.gain;
}

Applied apply_stamp(const StampOperation& op, Field& field, PieceTable& pieces,
                    const PreparedStamp* prepared) {
  Volumes volumes{remove_piece(pieces, op.piece)};
  for (const StampedPiece& other : op.others) volumes.push_back(remove_piece(pieces, other.piece));
  Applied applied;
  if (prepared != nullptr && prepared->holds(op, field, volumes)) {
    CHECK_DEBUG(gives(op, field, volumes, *prepared));
    applied.terrain_gain = prepared->gain;
    applied.changed = scatter(field, prepared->after);
    return applied;
  }
  applied.changed = scatter(field, stamped(op, field, volumes, applied.terrain_gain));
  return applied;
}

Applied apply_discard(const DiscardOperation& op, PieceTable& pieces) {
  Applied applied;
  applied.dust = remove_piece(pieces, op.piece)->mass;
  return applied;
}

Applied apply_shatter(const ShatterOperation& op, PieceTable& pieces) {
  const std::shared_ptr<const Volume> volume = remove_piece(pieces, op.piece);
  Applied applied;
  applied.seeds_voxels =
      scatter_seeds(volume->window, op.pattern, op.seeds, op.random_seed, op.impact_voxels);
  const auto parents = [&](const Volume&) { return volume->material; };
  enter(shatter(op.cutter, *volume, applied.seeds_voxels), op.first_piece, parents, pieces, applied);
  CHECK_EQ(mass_created(applied, pieces) + applied.dust, volume->mass);
  return applied;
}

Applied apply_island(const IslandOperation& op, Field& field, PieceTable& pieces) {
  Window window = gather(field, lift_box(op.box));
  Volume volume = lift(window, op.box, op.start);
  volume.material = material_at(field, volume.centre_voxels * field.source().voxel_size_m);
  Applied applied;
  applied.terrain_gain = -volume.mass;
  applied.changed = scatter(field, window);
  if (volume.mass < limits::piece_mass_min) {
    applied.dust = volume.mass;
    return applied;
  }
  pieces[op.piece] = std::make_shared<const Volume>(std::move(volume));
  applied.created.push_back({op.piece, {}});
  return applied;
}

Applied apply_paint(const PaintOperation& op, Field& field) {
  Applied applied;
  applied.changed = paint(field, in_voxels(op.shape, field.source().voxel_size_m), op.material);
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

Result<void> known(PieceId id, const PieceTable& pieces) {
  if (pieces.contains(id)) return {};
  return fail("there is no piece " + std::to_string(id));
}

/// New ids must be free: an operation off a wire could otherwise replace living pieces.
Result<void> validate_new_ids(PieceIds made, const PieceTable& pieces) {
  const auto taken = pieces.lower_bound(made.first);
  if (made.count == 0 || taken == pieces.end() || taken->first - made.first >= made.count) return {};
  return fail("piece " + std::to_string(taken->first) + " is alive already");
}

Result<void> validate_seeds(Cutter cutter, uint32_t seeds, PieceId first_piece) {
  TRY(validate_kind(cutter, "cutter"));
  if (seeds == 0) return fail("a carve needs at least one seed");
  if (seeds > limits::seeds_max)
    return fail(std::to_string(seeds) + " seeds are over the limit of " + std::to_string(limits::seeds_max) +
                " (limits.seeds_max)");
  if (first_piece > UINT32_MAX - seeds) return fail("the piece ids are used up");
  return {};
}

bool is_finite(glm::vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Result<void> validate_authored(const CarveOperation& op) {
  const size_t wanted = is_drawn(op.pattern) ? 0 : op.seeds;
  if (wanted > limits::authored_seeds_max)
    return fail(std::to_string(wanted) + " " + std::string(name_of(op.pattern)) +
                " seeds are over the limit of " + std::to_string(limits::authored_seeds_max) +
                " (limits.authored_seeds_max)");
  if (op.authored_m.size() != wanted)
    return fail(std::to_string(op.authored_m.size()) + " authored seeds for a carve of " +
                std::to_string(wanted) + " (a pattern that needs points has as many as seeds, others none)");
  for (const glm::vec3& point_m : op.authored_m) {
    if (!is_finite(point_m)) return fail("an authored seed's position is not a finite number");
    if (!in_world(point_m)) return fail("an authored seed is outside the world (limits.world_half_width_m)");
  }
  return {};
}

Result<void> validate_group(const StampOperation& op, const PieceTable& pieces) {
  if (!lays(op.method))
    return fail("the method " + std::string(name_of(op.method)) + " merges one piece at a time");
  std::vector<StampedPiece> group{{op.piece, op.pose}};
  for (const StampedPiece& other : op.others) {
    TRY(known(other.piece, pieces));
    if (std::ranges::find(group, other.piece, &StampedPiece::piece) != group.end())
      return fail("piece " + std::to_string(other.piece) + " is stamped twice");
    if (!in_world(dequantise(other.pose).position_m))
      return fail("the stamp is outside the world (limits.world_half_width_m)");
    group.push_back(other);
  }
  if (!can_merge_together(group, pieces))
    return fail("the pieces are too many, too large or too far apart for one stamp (limits.stamp_group_max)");
  return {};
}

/// A piece off a wire may be larger than any that a world makes.
Result<void> validate_window(const StampOperation& op, const Volume& volume, float voxel_size_m) {
  const size_t voxels = Window::count(stamp_box(op.method, volume, op.pose, voxel_size_m));
  if (voxels <= limits::stamp_voxels_max) return {};
  return fail("the stamp of piece " + std::to_string(op.piece) + " has a window of " +
              std::to_string(voxels) + " voxels, over the limit of " +
              std::to_string(limits::stamp_voxels_max) + " (limits.stamp_voxels_max)");
}

struct Validator {
  const PieceTable& pieces;
  float voxel_size_m;

  Result<void> operator()(const CarveOperation& op) const {
    TRY(validate_edit(op.shape));
    if (!is_finite(op.impact_m)) return fail("the impact's position is not a finite number");
    if (!in_world(op.impact_m)) return fail("the impact is outside the world (limits.world_half_width_m)");
    TRY(validate_carve_pattern(op.pattern));
    TRY(validate_authored(op));
    return validate_seeds(op.cutter, op.seeds, op.first_piece);
  }
  Result<void> operator()(const FillOperation& op) const { return validate_edit(op.shape); }
  Result<void> operator()(const PaintOperation& op) const {
    TRY(validate_kind(op.material, "material"));
    return validate_edit(op.shape);
  }
  Result<void> operator()(const StampOperation& op) const {
    TRY(known(op.piece, pieces));
    TRY(validate_kind(op.method, "stamp's method"));
    if (std::abs(op.shift) > stamp_shift_max)
      return fail("the stamp's shift is over ±" + std::to_string(stamp_shift_max));
    if (!in_world(dequantise(op.pose).position_m))
      return fail("the stamp is outside the world (limits.world_half_width_m)");
    if (!op.others.empty()) return validate_group(op, pieces);
    return validate_window(op, *pieces.at(op.piece), voxel_size_m);
  }
  Result<void> operator()(const DiscardOperation& op) const { return known(op.piece, pieces); }
  Result<void> operator()(const ShatterOperation& op) const {
    TRY(known(op.piece, pieces));
    if (!is_finite(op.impact_voxels)) return fail("the impact's position is not a finite number");
    TRY(validate_shatter_pattern(op.pattern));
    return validate_seeds(op.cutter, op.seeds, op.first_piece);
  }
  Result<void> operator()(const IslandOperation& op) const {
    constexpr auto far = static_cast<int>(limits::world_half_width_m / limits::voxel_size_min_m);
    const VoxelBox world{{-far, -far, -far}, {far, far, far}};
    if (!world.holds(op.box.lo) || !world.holds(op.box.hi))
      return fail("the island is outside the world (limits.world_half_width_m)");
    const VoxelCoord size = op.box.size();
    if (std::max({size.x, size.y, size.z}) > limits::island_side_max_bricks * brick_size)
      return fail("the island is longer than " + std::to_string(limits::island_side_max_bricks) +
                  " bricks (limits.island_side_max_bricks)");
    if (!op.box.holds(op.start)) return fail("the island's start is outside its box");
    if (op.piece == UINT32_MAX) return fail("the piece ids are used up");
    return {};
  }
};

}  // namespace

Result<void> validate_edit(const Shape& shape) {
  TRY(validate(shape));
  const float reach = reach_of(shape);
  if (reach > limits::edit_reach_max_m + limits::edit_reach_rounding_m)
    return fail("half the shape's longest extent is " + std::to_string(reach) + " m, and may be at most " +
                std::to_string(limits::edit_reach_max_m) + " m (limits.edit_reach_max_m)");
  if (reach < limits::edit_reach_min_m - limits::edit_reach_rounding_m)
    return fail("half the shape's longest extent is " + std::to_string(reach) + " m, and must be at least " +
                std::to_string(limits::edit_reach_min_m) + " m (limits.edit_reach_min_m)");
  if (!in_world(centre_of(shape)))
    return fail("the place is outside the world (limits.world_half_width_m, limits.world_half_height_m)");
  return {};
}

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
  return std::visit(
      Overloaded{
          [&](const CarveOperation& op) { return around(op.shape); },
          [&](const FillOperation& op) { return around(op.shape); },
          [&](const StampOperation& op) { return box_of(op, pieces, voxel_size_m); },
          [](const DiscardOperation&) { return VoxelBox{}; },
          [](const ShatterOperation&) { return VoxelBox{}; },
          [](const IslandOperation& op) { return lift_box(op.box); },
          [&](const PaintOperation& op) { return paint_box(in_voxels(op.shape, voxel_size_m)); },
      },
      operation);
}

Applied apply(const Operation& operation, Field& field, PieceTable& pieces, const PreparedStamp* prepared) {
  return std::visit(Overloaded{
                        [&](const CarveOperation& op) { return apply_carve(op, field, pieces); },
                        [&](const FillOperation& op) { return apply_fill(op, field); },
                        [&](const StampOperation& op) { return apply_stamp(op, field, pieces, prepared); },
                        [&](const DiscardOperation& op) { return apply_discard(op, pieces); },
                        [&](const ShatterOperation& op) { return apply_shatter(op, pieces); },
                        [&](const IslandOperation& op) { return apply_island(op, field, pieces); },
                        [&](const PaintOperation& op) { return apply_paint(op, field); },
                    },
                    operation);
}

Result<void> validate(const Operation& operation, const PieceTable& pieces, float voxel_size_m) {
  TRY(std::visit(Validator{pieces, voxel_size_m}, operation));
  return validate_new_ids(ids_made_by(operation), pieces);
}

Window carved_volume(Field& field, const Shape& shape) {
  const Shape in_field = in_voxels(shape, field.source().voxel_size_m);
  const Window before = gather(field, band_box(in_field));
  return extract(before, codes_of(in_field, before.box));
}

}  // namespace scree
