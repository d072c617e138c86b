// The bounds of operations: what lies exactly at one is within, whatever its place rounds, and what is within
// fits every window that it needs.
#include <cmath>
#include <glm/common.hpp>
#include <gtest/gtest.h>

#include "shared/base/edit_reach.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/operation/operation.h"
#include "shared/recombine/stamp_method.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/rounds.h"

namespace scree {
namespace {

constexpr auto all_methods = all_kinds<StampMethod>;

glm::vec3 some_place(Random& random) {
  const auto within = [&](float half_m) { return (random.unit() * 2.0F - 1.0F) * half_m; };
  const float x = within(limits::world_half_width_m), y = within(limits::world_half_height_m);
  return {x, y, within(limits::world_half_width_m)};
}

/// Every kind of shape with that reach about a place, the lengths of some of them thirds.
std::vector<Shape> shapes_of_reach(float reach_m, glm::vec3 place_m, Random& random) {
  const float part_m = reach_m * (0.01F + 0.98F * random.unit()), rest_m = reach_m - part_m;
  Shape rounded = box(place_m, {rest_m / 9.0F, rest_m, rest_m / 7.0F});
  rounded.radius_m = part_m;
  std::vector<Shape> shapes{sphere(place_m, reach_m), box(place_m, {reach_m / 3.0F, reach_m / 3.0F, reach_m}),
                            rounded};
  for (int axis = 0; axis < 3; ++axis) {
    glm::vec3 along_m(0.0F);
    along_m[axis] = rest_m;
    along_m[(axis + 1) % 3] = rest_m / 3.0F;
    shapes.push_back(capsule(place_m - along_m, place_m + along_m, part_m));
  }
  return shapes;
}

TEST(Borders, a_reach_of_exactly_a_limit_is_within_it_wherever_the_shape_lies) {
  Random random(335);
  for (int round = 0; round < 2000; ++round) {
    const glm::vec3 place_m = some_place(random);
    for (const float voxel_m : {0.25F, limits::voxel_size_min_m})
      for (const float reach_m : {greatest_edit_reach_m(voxel_m), limits::edit_reach_min_m})
        for (const Shape& shape : shapes_of_reach(reach_m, place_m, random)) {
          const Result<void> valid = validate(FillOperation{shape}, {}, voxel_m);
          ASSERT_TRUE(valid) << valid.error().message << ", kind " << static_cast<int>(shape.kind) << " at "
                             << place_m.x << " " << place_m.y << " " << place_m.z;
        }
  }
}

TEST(Borders, a_reach_beyond_a_limit_is_refused_wherever_the_shape_lies) {
  Random random(336);
  for (int round = 0; round < 500; ++round) {
    const glm::vec3 place_m = some_place(random);
    for (const float voxel_m : {0.25F, limits::voxel_size_min_m})
      for (const float reach_m : {greatest_edit_reach_m(voxel_m) + 0.01F, limits::edit_reach_min_m - 0.01F})
        for (const Shape& shape : shapes_of_reach(reach_m, place_m, random))
          ASSERT_FALSE(validate(FillOperation{shape}, {}, voxel_m)) << static_cast<int>(shape.kind);
  }
}

TEST(Borders, an_edit_reaches_8_m_down_to_voxels_of_15_cm_and_5_m_in_the_smallest) {
  EXPECT_EQ(greatest_edit_reach_m(2.0F), 8.0F);
  EXPECT_EQ(greatest_edit_reach_m(0.15F), 8.0F) << "worlds of earlier versions";
  EXPECT_NEAR(greatest_edit_reach_m(limits::voxel_size_min_m), 5.4F, 1e-5F);
}

/// The operations with a shape, each with this one.
std::vector<Operation> operations_of(const Shape& shape) {
  ShatterOperation cut{.piece = 1, .seeds = 4, .first_piece = 10};
  cut.cut = PieceCut{shape, {}};
  return {CarveOperation{.shape = shape, .seeds = 4, .impact_m = shape.a, .first_piece = 10},
          FillOperation{shape},
          PaintOperation{shape, material::rock},
          DigOperation{shape},
          PlaceOperation{.shape = shape, .material = material::rock},
          cut};
}

TEST(Borders, what_reaches_too_far_for_fine_voxels_is_refused_with_the_greatest_reach) {
  Volume volume;
  volume.window = Window(VoxelBox{{0, 0, 0}, {4, 4, 4}}, code_solid);
  volume.mass = mass_of(volume.window);
  const PieceTable pieces{{1, std::make_shared<const Volume>(std::move(volume))}};
  for (const Operation& operation : operations_of(sphere({0.0F, 0.0F, 0.0F}, 6.0F))) {
    EXPECT_TRUE(validate(operation, pieces, 0.25F)) << operation.index();
    const Result<void> valid = validate(operation, pieces, 0.1F);
    ASSERT_FALSE(valid) << operation.index();
    EXPECT_EQ(valid.error().message,
              "half the shape's longest extent is 6 m, and may be at most 5.4 m in voxels of 0.1 m");
  }
  for (const Operation& operation : operations_of(sphere({0.0F, 0.0F, 0.0F}, 5.4F)))
    EXPECT_TRUE(validate(operation, pieces, 0.1F)) << operation.index();
}

TEST(Borders, the_largest_edit_of_the_smallest_voxels_fits_a_window) {
  Random random(337);
  const float reach_m = greatest_edit_reach_m(limits::voxel_size_min_m) + limits::edit_reach_rounding_m;
  for (int round = 0; round < 200; ++round) {
    const glm::vec3 place_m = some_place(random);
    for (const Shape& shape : {sphere(place_m, reach_m), box(place_m, glm::vec3(reach_m))}) {
      const VoxelCoord size = band_box(in_voxels(shape, limits::voxel_size_min_m)).size();
      EXPECT_LE(std::max({size.x, size.y, size.z}), limits::window_side_max);
    }
  }
}

/// The largest carve that there is, in one piece.
class LargestPiece : public ::testing::Test {
 protected:
  LargestPiece() {
    const Shape shape = box({0.0F, -20.0F, 0.0F}, glm::vec3(greatest_edit_reach_m(limits::voxel_size_min_m)));
    apply(CarveOperation{shape, SeedPattern::uniform, 1, 1, shape.a, 1}, field, pieces);
  }
  const Volume& volume() const { return *pieces.at(1); }

  MapField field{{TerrainKind::flat, 1, limits::voxel_size_min_m}};
  PieceTable pieces;
  /// Half a turn about a diagonal: no box grows by more along all three axes.
  const glm::quat widest{0.0F, 0.57735027F, 0.57735027F, 0.57735027F};
};

TEST_F(LargestPiece, becomes_terrain_again_by_stamp_and_slices_however_it_is_turned) {
  ASSERT_EQ(pieces.size(), 1U);
  Random random(338);
  for (const StampMethod method : {StampMethod::stamp, StampMethod::slices}) {
    for (int round = 0; round < rounds(50, 5); ++round) {
      const QuantisedPose pose{0, 0, 0, round == 0 ? quantise({{}, widest}).rotation : random.next()};
      const Result<void> valid =
          validate(StampOperation{1, pose, 0, method}, pieces, field.source().voxel_size_m);
      ASSERT_TRUE(valid) << valid.error().message;
    }
    MapField ground(field.source());
    PieceTable table = pieces;
    const QuantisedPose on_ground = quantise({{0.0F, 9.0F, 0.0F}, widest});
    const Applied applied = apply(StampOperation{1, on_ground, 0, method}, ground, table);
    EXPECT_GT(applied.terrain_gain, volume().mass / 2) << static_cast<int>(method);
    EXPECT_TRUE(table.empty());
  }
}

TEST_F(LargestPiece, is_not_replaced_by_an_operation_that_names_its_id_anew) {
  const auto refusal = [&](uint32_t seeds, PieceId first_piece) {
    const Shape shape = sphere({0.0F, 0.0F, 0.0F}, 1.0F);
    const Result<void> valid =
        validate(CarveOperation{shape, SeedPattern::uniform, seeds, 1, shape.a, first_piece}, pieces,
                 field.source().voxel_size_m);
    return valid ? std::string() : valid.error().message;
  };
  EXPECT_EQ(refusal(1, 1), "piece 1 is alive already");
  EXPECT_EQ(refusal(8, 0), "piece 1 is alive already");
  EXPECT_EQ(refusal(8, 2), "");
}

/// As large as a piece off a wire may be, and larger than a world makes.
TEST(Borders, a_stamp_whose_window_is_too_large_is_refused_by_name) {
  constexpr int side = limits::window_side_max;
  Volume volume;
  volume.window = Window(VoxelBox{{0, 0, 0}, {side, side, side}}, code_solid);
  volume.mass = mass_of(volume.window);
  volume.centre_voxels = glm::vec3(0.5F * side);
  const PieceTable pieces{{1, std::make_shared<const Volume>(std::move(volume))}};
  const uint32_t straight = quantise({}).rotation;
  const uint32_t turned = quantise({{}, {0.0F, 0.57735027F, 0.57735027F, 0.57735027F}}).rotation;
  const auto refusal = [&](uint32_t rotation, StampMethod method) {
    const Result<void> valid = validate(StampOperation{1, {0, 0, 0, rotation}, 0, method}, pieces, 0.25F);
    return valid ? std::string() : valid.error().message;
  };
  EXPECT_EQ(refusal(straight, StampMethod::stamp), "");
  EXPECT_EQ(refusal(straight, StampMethod::slices), "");
  for (const StampMethod method : all_methods)
    EXPECT_NE(refusal(turned, method).find("limits.stamp_voxels_max"), std::string::npos)
        << refusal(turned, method);
}

/// Polygons about every voxel of it would take gigabytes.
TEST(Borders, a_volume_of_too_many_faces_is_cut_without_polygons) {
  constexpr int side = 64;
  Volume volume;
  volume.window = Window(VoxelBox{{0, 0, 0}, {side, side, side}});
  for (int x = 0; x < side; ++x)
    for (int y = 0; y < side; ++y)
      for (int z = 0; z < side; ++z)
        if ((x + y + z) % 2 == 0) volume.window.at(x, y, z) = code_solid;
  volume.mass = mass_of(volume.window);
  volume.centre_voxels = glm::vec3(0.5F * side);
  MapField field(flat_terrain);
  std::vector<uint64_t> sizes;
  for (const Cutter cutter : {Cutter::field, Cutter::slice, Cutter::conform}) {
    PieceTable pieces{{1, std::make_shared<const Volume>(volume)}};
    const Applied applied =
        apply(ShatterOperation{1, SeedPattern::uniform, 20, 5, {}, 10, cutter}, field, pieces);
    MassUnits mass = applied.dust;
    for (const auto& [id, piece] : pieces) mass += piece->mass;
    EXPECT_EQ(mass, volume.mass);
    sizes.push_back(0);
    for (const auto& [id, piece] : pieces) sizes.back() = sizes.back() * 31 + piece->window.codes.size();
  }
  EXPECT_EQ(sizes[1], sizes[0]);
  EXPECT_EQ(sizes[2], sizes[0]);
}

}  // namespace
}  // namespace scree
