// Which operations may be applied: what comes off a wire or out of a file is asked this first.
#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>

#include "shared/base/edit_reach.h"
#include "shared/base/limits.h"
#include "shared/base/plain_number.h"
#include "shared/operation/limits.h"
#include "shared/operation/operation.h"
#include "shared/operation/restore_operation.h"

namespace scree {

namespace {

bool in_world(glm::vec3 p) {
  return std::abs(p.x) <= limits::world_half_width_m && std::abs(p.z) <= limits::world_half_width_m &&
         std::abs(p.y) <= limits::world_half_height_m;
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
    return fail(std::to_string(seeds) + " seeds are over the limit of " + std::to_string(limits::seeds_max));
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
    if (!in_world(point_m)) return fail("an authored seed is outside the world");
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
    if (!in_world(dequantise(other.pose).position_m)) return fail("the stamp is outside the world");
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

Result<void> validate_material(Material material) {
  if (row_number(material) < materials_max) return {};
  return fail("material " + std::to_string(row_number(material)) + " is over the last of a palette, " +
              std::to_string(materials_max - 1));
}

Result<void> validate_place(const VoxelBox& box, const std::string& what) {
  constexpr auto far = static_cast<int>(limits::world_half_width_m / limits::voxel_size_min_m);
  const VoxelBox world{{-far, -far, -far}, {far, far, far}};
  if (world.holds(box.lo) && world.holds(box.hi)) return {};
  return fail("the " + what + " is outside the world");
}

Result<void> validate_cut(const PieceCut& cut, PieceId first_piece, float voxel_size_m) {
  TRY(validate_edit(cut.shape, voxel_size_m));
  if (!in_world(dequantise(cut.pose).position_m)) return fail("the piece that is cut is outside the world");
  if (first_piece > UINT32_MAX - limits::seeds_max - limits::cut_rests_max)
    return fail("the piece ids are used up");
  return {};
}

struct Validator {
  const PieceTable& pieces;
  float voxel_size_m;

  Result<void> operator()(const CarveOperation& op) const {
    TRY(validate_edit(op.shape, voxel_size_m));
    if (!is_finite(op.impact_m)) return fail("the impact's position is not a finite number");
    if (!in_world(op.impact_m)) return fail("the impact is outside the world");
    TRY(validate_carve_pattern(op.pattern));
    TRY(validate_authored(op));
    return validate_seeds(op.cutter, op.seeds, op.first_piece);
  }
  Result<void> operator()(const FillOperation& op) const {
    if (op.material) TRY(validate_material(*op.material));
    return validate_edit(op.shape, voxel_size_m);
  }
  Result<void> operator()(const PaintOperation& op) const {
    TRY(validate_material(op.material));
    return validate_edit(op.shape, voxel_size_m);
  }
  Result<void> operator()(const StampOperation& op) const {
    TRY(known(op.piece, pieces));
    TRY(validate_kind(op.method, "stamp's method"));
    if (std::abs(op.shift) > stamp_shift_max)
      return fail("the stamp's shift is over ±" + std::to_string(stamp_shift_max));
    if (!in_world(dequantise(op.pose).position_m)) return fail("the stamp is outside the world");
    if (!op.others.empty()) return validate_group(op, pieces);
    return validate_window(op, *pieces.at(op.piece), voxel_size_m);
  }
  Result<void> operator()(const DiscardOperation& op) const { return known(op.piece, pieces); }
  Result<void> operator()(const ShatterOperation& op) const {
    TRY(known(op.piece, pieces));
    if (!is_finite(op.impact_voxels)) return fail("the impact's position is not a finite number");
    TRY(validate_shatter_pattern(op.pattern));
    if (op.cut) TRY(validate_cut(*op.cut, op.first_piece, voxel_size_m));
    return validate_seeds(op.cutter, op.seeds, op.first_piece);
  }
  Result<void> operator()(const IslandOperation& op) const {
    TRY(validate_place(op.box, "island"));
    const VoxelCoord size = op.box.size();
    if (std::max({size.x, size.y, size.z}) > limits::island_side_max_bricks * brick_size)
      return fail("the island is longer than " + std::to_string(limits::island_side_max_bricks) +
                  " bricks (limits.island_side_max_bricks)");
    if (!op.box.holds(op.start)) return fail("the island's start is outside its box");
    if (op.piece == UINT32_MAX) return fail("the piece ids are used up");
    return {};
  }
  Result<void> operator()(const DigOperation& op) const {
    if (op.piece != 0) TRY(known(op.piece, pieces));
    return validate_edit(op.shape, voxel_size_m);
  }
  Result<void> operator()(const PlaceOperation& op) const {
    TRY(validate_material(op.material));
    return validate_edit(op.shape, voxel_size_m);
  }
  Result<void> operator()(const RestoreOperation& op) const {
    return validate_restore(op, pieces, voxel_size_m);
  }
  Result<void> operator()(const SlideOperation& op) const {
    TRY(validate_material(op.material));
    TRY(validate_place(op.box, "slide"));
    const VoxelCoord size = op.box.size();
    if (std::max(size.x, size.z) > limits::slide_side_max_voxels || size.y > limits::slide_height_max_voxels)
      return fail("the slide is larger than " + std::to_string(limits::slide_side_max_voxels) +
                  " voxels a side, or higher than " + std::to_string(limits::slide_height_max_voxels) +
                  " (limits.slide_side_max_voxels)");
    if (op.cell < 1 || op.cell > limits::slide_cell_max_voxels)
      return fail("a slide's cell has 1 to " + std::to_string(limits::slide_cell_max_voxels) +
                  " voxels a side");
    if (op.box.empty() || size.x % op.cell != 0 || size.z % op.cell != 0)
      return fail("the slide's box is not one of whole cells");
    if (op.tangent < 1 || op.tangent > limits::slide_tangent_max)
      return fail("the tangent of a slide's angle is 1 to " + std::to_string(limits::slide_tangent_max) +
                  " 64ths");
    return {};
  }
};

}  // namespace

Result<void> validate_edit(const Shape& shape, float voxel_size_m) {
  TRY(validate(shape));
  const float reach = reach_of(shape), most = greatest_edit_reach_m(voxel_size_m);
  if (reach > most + limits::edit_reach_rounding_m)
    return fail("half the shape's longest extent is " + metres(reach) + ", and may be at most " +
                metres(most) +
                (most < limits::edit_reach_max_m ? " in voxels of " + metres(voxel_size_m) : std::string()));
  if (reach < limits::edit_reach_min_m - limits::edit_reach_rounding_m)
    return fail("half the shape's longest extent is " + metres(reach) + ", and must be at least " +
                metres(limits::edit_reach_min_m));
  if (!in_world(centre_of(shape))) return fail("the place is outside the world");
  return {};
}

Result<void> validate(const Operation& operation, const PieceTable& pieces, float voxel_size_m) {
  TRY(std::visit(Validator{pieces, voxel_size_m}, operation));
  return validate_new_ids(ids_made_by(operation), pieces);
}

}  // namespace scree
