// The methods beside the stamp: what they draw, and that none of them makes mass.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "shared/base/random.h"
#include "shared/operation/operation.h"
#include "shared/recombine/posed_piece.h"
#include "shared/recombine/stamp_method.h"
#include "shared/recombine/stamp_slices.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

constexpr auto all_methods = all_kinds<StampMethod>;
constexpr StampMethod other_methods[] = {StampMethod::slices, StampMethod::sphere};

QuantisedPose some_pose(glm::vec3 position_m, Random& random) {
  QuantisedPose pose = quantise({position_m, {1.0F, 0.0F, 0.0F, 0.0F}});
  pose.rotation = random.next();
  return pose;
}

/// What a carve of flat ground breaks into.
PieceTable some_pieces(Field& field) {
  PieceTable pieces;
  apply(CarveOperation{sphere({0.3F, -0.6F, 0.1F}, 2.0F), SeedPattern::uniform, 24, 42, {}, 1}, field,
        pieces);
  return pieces;
}

/// Codes of a cube, as a piece.
Volume cube(int side) {
  Volume volume;
  volume.window = Window({{-4, -4, -4}, {side + 4, side + 4, side + 4}});
  const float half = 0.5F * static_cast<float>(side - 1);
  const Shape shape = box(glm::vec3(half), glm::vec3(half + 0.5F));
  for (int x = -4; x < side + 4; ++x)
    for (int y = -4; y < side + 4; ++y)
      for (int z = -4; z < side + 4; ++z)
        volume.window.at(x, y, z) = encode(distance(shape, glm::vec3(x, y, z)));
  volume.mass = mass_of(volume.window);
  volume.centre_voxels = glm::vec3(half);
  return volume;
}

TEST(stamp_methods, slices_draw_what_lies_in_the_piece_however_it_is_turned) {
  MapField field(flat_terrain);
  Random random(3);
  int deep = 0, far = 0;
  for (const auto& [id, volume] : some_pieces(field))
    for (int turn = 0; turn < 4; ++turn) {
      const QuantisedPose pose = some_pose({3.0F, 1.0F + random.unit(), random.unit()}, random);
      const VoxelBox box = stamp_box(StampMethod::slices, *volume, pose, voxel_m);
      const std::vector<uint8_t> slices = draw_slices(*volume, pose, voxel_m, box);
      const Window codes = posed_codes(*volume, pose, voxel_m, box);
      for (size_t i = 0; i < slices.size(); ++i) {
        // Half a voxel from the surface both must agree: a ray that slipped through would draw to the end.
        if (codes.codes[i] < -21) {
          ++deep;
          EXPECT_EQ(slices[i], 1) << "piece " << id << ", turn " << turn;
        } else if (codes.codes[i] > 42) {
          ++far;
          EXPECT_EQ(slices[i], 0) << "piece " << id << ", turn " << turn;
        }
      }
    }
  EXPECT_GT(deep, 1000);
  EXPECT_GT(far, 10000);
}

TEST(stamp_methods, rays_along_the_edges_of_polygons_count_them_once) {
  // Unturned, a cube's polygons lie on the grid's lines: rays meet edges and corners, never an inside.
  const Volume volume = cube(6);
  for (const float shift : {0.0F, 0.5F, 0.25F}) {
    const glm::vec3 centre = (volume.centre_voxels + glm::vec3(shift)) * voxel_m;
    const QuantisedPose pose = quantise({centre, {1.0F, 0.0F, 0.0F, 0.0F}});
    const VoxelBox box = stamp_box(StampMethod::slices, volume, pose, voxel_m);
    const std::vector<uint8_t> slices = draw_slices(volume, pose, voxel_m, box);
    const auto nz = static_cast<size_t>(box.size().z);
    size_t drawn = 0;
    for (size_t row = 0; row < slices.size(); row += nz) {
      const auto first = slices.begin() + static_cast<ptrdiff_t>(row);
      const auto in_row = static_cast<size_t>(std::count(first, first + static_cast<ptrdiff_t>(nz), 1));
      EXPECT_LE(in_row, 7U) << "off by " << shift << ": a ray that lost a crossing draws to the end";
      drawn += in_row;
    }
    // A layer right on the surface is in on one side and out on the other; the polygons cut off the edges.
    EXPECT_LE(drawn, 216U) << "off by " << shift;
    EXPECT_GE(drawn, 216U - 12U * 6U) << "off by " << shift;
  }
}

TEST(stamp_methods, the_gain_is_what_was_planned_and_never_beyond_the_budget) {
  for (const StampMethod method : other_methods) {
    MapField field({TerrainKind::canyon, 3, voxel_m});
    MapField quarry(flat_terrain);
    Random random(5);
    PieceTable pieces = some_pieces(quarry);
    const PieceTable made = pieces;
    MassUnits dust = 0;
    for (const auto& [id, volume] : made) {
      const float x = 9.0F + 4.0F * random.unit(), z = 4.0F * random.unit();
      const float y = ground_height_m(field.source(), x, z) + random.unit() - 0.3F;
      StampOperation op{id, some_pose({x, y, z}, random), 0, method};
      const Window window = gather(field, stamp_box(method, *volume, op.pose, voxel_m));
      const MassUnits budget = stamp_budget(volume->mass, dust);
      const StampPlan plan = plan_stamp(method, window, *volume, op.pose, voxel_m, budget);
      op.shift = plan.shift;
      ASSERT_TRUE(validate(Operation(op), pieces, voxel_m).has_value());
      const Applied applied = apply(op, field, pieces);
      EXPECT_EQ(applied.terrain_gain, plan.gain) << "piece " << id;
      EXPECT_LE(applied.terrain_gain, budget) << "piece " << id;
      dust += volume->mass - applied.terrain_gain;
      EXPECT_GE(dust, 0);
    }
    EXPECT_TRUE(pieces.empty());
  }
}

TEST(stamp_methods, a_budget_of_nothing_leaves_the_field_alone) {
  for (const StampMethod method : other_methods) {
    MapField field(flat_terrain);
    Random random(7);
    PieceTable pieces = some_pieces(field);
    const uint64_t hash = field.hash();
    const auto& [id, volume] = *pieces.begin();
    StampOperation op{id, some_pose({0.0F, 0.2F, 0.0F}, random), 0, method};
    const Window window = gather(field, stamp_box(method, *volume, op.pose, voxel_m));
    const StampPlan plan = plan_stamp(method, window, *volume, op.pose, voxel_m, 0);
    EXPECT_EQ(plan.gain, 0);
    op.shift = plan.shift;
    EXPECT_EQ(apply(op, field, pieces).terrain_gain, 0);
    EXPECT_EQ(field.hash(), hash);
  }
}

TEST(stamp_methods, each_meets_the_mass_of_small_and_large_pieces_in_the_open) {
  for (const StampMethod method : other_methods)
    for (const int side : {3, 5, 12}) {
      MapField field(flat_terrain);
      Random random(static_cast<uint64_t>(side));
      const Volume volume = cube(side);
      const QuantisedPose pose = some_pose({0.1F, 10.0F, 0.3F}, random);
      const Window window = gather(field, stamp_box(method, volume, pose, voxel_m));
      const StampPlan plan = plan_stamp(method, window, volume, pose, voxel_m, volume.mass);
      EXPECT_LE(plan.gain, volume.mass);
      EXPECT_GT(static_cast<double>(plan.gain), 0.99 * static_cast<double>(volume.mass)) << "side " << side;
    }
}

TEST(stamp_methods, a_sphere_in_the_open_is_a_ball_of_the_pieces_volume_at_its_centre) {
  const Volume volume = cube(10);
  const glm::vec3 centre(1.1F, 12.0F, -0.3F);
  const QuantisedPose pose = quantise({centre, glm::normalize(glm::quat(0.3F, -0.8F, 0.2F, 0.4F))});
  MapField field(flat_terrain);
  PieceTable pieces{{1, std::make_shared<const Volume>(volume)}};
  const Window window = gather(field, stamp_box(StampMethod::sphere, volume, pose, voxel_m));
  const StampPlan plan = plan_stamp(StampMethod::sphere, window, volume, pose, voxel_m, volume.mass);
  EXPECT_NEAR(static_cast<double>(plan.gain), static_cast<double>(volume.mass),
              1e-3 * static_cast<double>(volume.mass));
  apply(StampOperation{1, pose, plan.shift, StampMethod::sphere}, field, pieces);
  const float radius = std::cbrt(static_cast<float>(volume.mass) / units_per_voxel * 0.238732415F);
  for (const glm::vec3 direction : {glm::vec3(1, 0, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0.6F, 0.8F)})
    EXPECT_NEAR(sample(field, centre / voxel_m + direction * radius).distance_voxels, 0.0F, 0.1F);
}

TEST(stamp_methods, a_sphere_grows_where_the_ground_fills_a_part_of_it) {
  const Volume volume = cube(8);
  const QuantisedPose pose = quantise({{0.0F, 0.1F, 0.0F}, {1.0F, 0.0F, 0.0F, 0.0F}});
  MapField field(flat_terrain);
  const Window window = gather(field, stamp_box(StampMethod::sphere, volume, pose, voxel_m));
  const StampPlan plan = plan_stamp(StampMethod::sphere, window, volume, pose, voxel_m, volume.mass);
  EXPECT_GT(plan.shift, stamp_shift_max / 4);
  EXPECT_LE(plan.gain, volume.mass);
  EXPECT_GT(static_cast<double>(plan.gain), 0.99 * static_cast<double>(volume.mass));
}

TEST(stamp_methods, shifts_out_of_range_and_unknown_methods_are_refused) {
  const PieceTable pieces{{1, std::make_shared<const Volume>(cube(4))}};
  for (const StampMethod method : all_methods) {
    for (const int shift : {-stamp_shift_max, stamp_shift_max})
      EXPECT_TRUE(validate(Operation(StampOperation{1, {}, shift, method}), pieces, voxel_m).has_value());
    for (const int shift : {-stamp_shift_max - 1, stamp_shift_max + 1})
      EXPECT_FALSE(validate(Operation(StampOperation{1, {}, shift, method}), pieces, voxel_m).has_value());
  }
  EXPECT_FALSE(
      validate(Operation(StampOperation{1, {}, 0, static_cast<StampMethod>(kind_count<StampMethod>)}), pieces,
               voxel_m));
}

}  // namespace
}  // namespace scree
