// Slides: rubble that lies too steep runs down to its angle of repose, and keeps the mass of each material.
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "bench/support/heap_shape.h"
#include "content/builtin_palette.h"
#include "tests/support/ledger_ground.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

Material named(const char* name) {
  return *builtin_palette().named(name);
}

struct SlideGround : LedgerGround {
  SlideGround() : LedgerGround(terrain_of_worlds(rock_terrain)) {}

  Material rubble() const { return field.rubble().rubble[row_number(material::rock)]; }
  void pour(const Shape& shape, Material of) { act(FillOperation{shape, of}); }

  /// Slides in a box (metres) until nothing moves. Returns how many slides that took, or 0 if it does not
  /// end.
  int settle(glm::vec3 lo_m, glm::vec3 hi_m, Material of, uint8_t tangent = 46, uint8_t cell = 2) {
    const auto voxel = [&](glm::vec3 at) {
      const glm::vec3 v = at / voxel_m;
      return VoxelCoord{static_cast<int>(v.x) & ~1, static_cast<int>(v.y) & ~1, static_cast<int>(v.z) & ~1};
    };
    const SlideOperation slide{{voxel(lo_m), voxel(hi_m)}, of, tangent, cell};
    EXPECT_TRUE(validate(slide, pieces, voxel_m)) << validate(slide, pieces, voxel_m).error().message;
    for (int slides = 1; slides < 2000; ++slides) {
      const Ledger before = ledger;
      const MaterialLedger kept = materials;
      const Applied applied = act(slide);
      EXPECT_EQ(applied.terrain_gain, 0);
      EXPECT_TRUE(applied.flows.empty());
      EXPECT_TRUE(ledger == before && materials == kept);
      if (applied.changed.empty() || HasFailure()) return slides;
    }
    return 0;
  }
  static bool HasFailure() { return testing::Test::HasFailure(); }

  /// Mass of each row's stones in a box of voxels.
  std::map<Material, MassUnits> masses(const VoxelBox& box) const {
    const Window codes = gather(field, box);
    const MaterialWindow rows = gather_materials(field, box);
    std::map<Material, MassUnits> sums;
    for (size_t i = 0; i < codes.codes.size(); ++i) {
      const size_t row = row_number(rows.at(i));
      sums[field.rubble().stones[row]] += mass_in_voxel(occupancy(codes.codes[i]), field.rubble().fill[row]);
    }
    return sums;
  }
};

constexpr VoxelBox everywhere{{-48, -24, -48}, {48, 64, 48}};

void expect_cliff_slides(const char* name, uint8_t tangent, double least_deg, double most_deg) {
  SlideGround ground;
  const Material of = name == std::string("rock_rubble") ? ground.rubble() : named(name);
  ground.pour(box({0.0F, 2.0F, 0.0F}, {2.5F, 2.0F, 2.5F}), of);
  const auto before = ground.masses(everywhere);
  const int slides = ground.settle({-10.0F, -3.0F, -10.0F}, {10.0F, 8.0F, 10.0F}, of, tangent);
  EXPECT_GT(slides, 1);
  EXPECT_EQ(ground.masses(everywhere), before);
  const HeapShape shape(ground.field, everywhere);
  std::printf("%s: %d slides, flank %.1f°, steepest metre %.1f°, top %.2f m\n", name, slides,
              shape.flank_deg(0.0), shape.steepest_deg(), shape.top_m());
  EXPECT_GE(shape.flank_deg(0.0), least_deg);
  EXPECT_LE(shape.steepest_deg(), most_deg);
}

TEST(slide, a_cliff_of_rubble_on_flat_ground_comes_to_its_angle_of_repose) {
  expect_cliff_slides("rock_rubble", 46, 33.0, 40.0);
  expect_cliff_slides("gravel", 48, 33.0, 41.0);
  expect_cliff_slides("sand", 41, 30.0, 37.0);
}

/// What is solid rock, to compare with later.
struct RockThen {
  explicit RockThen(const Field& field)
      : codes(gather(field, everywhere)), rows(gather_materials(field, everywhere)) {}

  void expect_stands(const Field& field) const {
    const RockThen now(field);
    int gone = 0;
    for (size_t i = 0; i < codes.codes.size(); ++i)
      if (codes.codes[i] < 0 && rows.at(i) == material::rock)
        gone += now.codes.codes[i] >= 0 || now.rows.at(i) != material::rock ? 1 : 0;
    EXPECT_EQ(gone, 0) << "voxels of rock moved";
  }

  Window codes;
  MaterialWindow rows;
};

/// Mass of rubble in a box, metres, in voxels of solid rock.
double rubble_in(const SlideGround& ground, glm::vec3 lo_m, glm::vec3 hi_m) {
  const auto voxel = [](glm::vec3 at) {
    const glm::vec3 v = at / voxel_m;
    return VoxelCoord{static_cast<int>(v.x), static_cast<int>(v.y), static_cast<int>(v.z)};
  };
  const VoxelBox box{voxel(lo_m), voxel(hi_m)};
  const Window codes = gather(ground.field, box);
  const MaterialWindow rows = gather_materials(ground.field, box);
  MassUnits sum = 0;
  for (size_t i = 0; i < codes.codes.size(); ++i)
    if (rows.at(i) == ground.rubble())
      sum += mass_in_voxel(occupancy(codes.codes[i]), ground.field.rubble().fill[row_number(rows.at(i))]);
  return static_cast<double>(sum) / units_per_voxel;
}

constexpr glm::vec3 lo_m{-10.0F, -5.0F, -10.0F}, hi_m{10.0F, 10.0F, 10.0F};

/// Settles, with the mass of each material and the rock as they were.
void expect_settles(SlideGround& ground) {
  const RockThen rock(ground.field);
  const auto before = ground.masses(everywhere);
  EXPECT_GT(ground.settle(lo_m, hi_m, ground.rubble()), 1);
  EXPECT_EQ(ground.masses(everywhere), before);
  rock.expect_stands(ground.field);
}

TEST(slide, rubble_runs_down_a_hill_of_rock) {
  SlideGround ground;
  ground.pour(sphere({0.0F, -3.0F, 0.0F}, 6.0F), material::rock);
  ground.pour(box({0.0F, 4.0F, 0.0F}, {1.25F, 1.5F, 1.25F}), ground.rubble());
  const double above = rubble_in(ground, {-3.0F, 2.5F, -3.0F}, {3.0F, 9.0F, 3.0F});
  expect_settles(ground);
  EXPECT_LT(rubble_in(ground, {-3.0F, 2.5F, -3.0F}, {3.0F, 9.0F, 3.0F}), 0.9 * above);
}

TEST(slide, a_wall_holds_rubble_back) {
  SlideGround ground;
  ground.pour(box({3.5F, 3.0F, 0.0F}, {0.5F, 3.0F, 8.0F}), material::rock);
  ground.pour(box({1.0F, 2.0F, 0.0F}, {2.0F, 2.0F, 2.0F}), ground.rubble());
  expect_settles(ground);
  EXPECT_EQ(rubble_in(ground, {4.25F, -2.0F, -9.0F}, {9.0F, 9.0F, 9.0F}), 0.0);
  EXPECT_GT(rubble_in(ground, {-5.0F, 0.0F, -1.0F}, {-1.5F, 3.0F, 1.0F}), 50.0) << "it ran to the other side";
}

TEST(slide, rubble_runs_into_a_hole) {
  SlideGround ground;
  ground.act(
      CarveOperation{.shape = box({3.0F, -1.0F, 0.0F}, {1.5F, 1.5F, 1.5F}), .seeds = 1, .first_piece = 1});
  ground.act(DiscardOperation{1});
  ground.pour(box({0.0F, 1.5F, 0.0F}, {1.5F, 1.5F, 1.5F}), ground.rubble());
  expect_settles(ground);
  EXPECT_GT(rubble_in(ground, {1.5F, -2.75F, -1.5F}, {4.5F, -0.5F, 1.5F}), 100.0);
}

TEST(slide, rubble_on_a_table_runs_over_its_edge_and_not_through_it) {
  SlideGround ground;
  ground.pour(box({0.0F, 1.5F, 0.0F}, {0.75F, 2.0F, 0.75F}), material::rock);
  ground.pour(box({0.0F, 3.5F, 0.0F}, {2.5F, 0.5F, 2.5F}), material::rock);
  ground.pour(box({0.0F, 5.5F, 0.0F}, {2.0F, 1.5F, 2.0F}), ground.rubble());
  expect_settles(ground);
  EXPECT_GT(rubble_in(ground, {-9.0F, -0.5F, -9.0F}, {9.0F, 2.5F, 9.0F}), 10.0);
  EXPECT_EQ(rubble_in(ground, {-2.0F, 0.0F, -2.0F}, {2.0F, 2.75F, 2.0F}), 0.0) << "rubble under the table";
}

TEST(slide, what_is_at_rest_or_no_rubble_stays) {
  SlideGround ground;
  ground.pour(box({0.0F, 2.0F, 0.0F}, {2.5F, 2.0F, 2.5F}), material::rock);
  EXPECT_EQ(ground.settle(lo_m, hi_m, material::rock), 1) << "rock is no rubble";
  EXPECT_EQ(ground.settle(lo_m, hi_m, ground.rubble()), 1) << "there is none";
  ground.pour(box({7.0F, 0.25F, 0.0F}, {1.5F, 0.5F, 1.5F}), ground.rubble());
  EXPECT_EQ(ground.settle(lo_m, hi_m, ground.rubble(), 127), 1) << "it is lower than a cell is steep";
}

TEST(slide, operations_off_a_wire_are_bounded) {
  const PieceTable none;
  const SlideOperation good{{{0, 0, 0}, {12, 8, 12}}, material::rock, 48, 3};
  EXPECT_TRUE(validate(good, none, voxel_m));
  const auto refused = [&](SlideOperation bad, const char* why) {
    const auto valid = validate(bad, none, voxel_m);
    ASSERT_FALSE(valid);
    EXPECT_NE(valid.error().message.find(why), std::string::npos) << valid.error().message;
  };
  SlideOperation bad = good;
  bad.cell = 5;
  refused(bad, "whole cells");
  bad.cell = 0;
  refused(bad, "cell has 1 to 8");
  bad = good;
  bad.box.hi.x = 84;
  refused(bad, "slide_side_max_voxels");
  bad = good;
  bad.box.hi.y = 0;
  refused(bad, "whole cells");
  bad = good;
  bad.tangent = 0;
  refused(bad, "1 to 127");
  bad = good;
  bad.box = {{1 << 24, 0, 0}, {(1 << 24) + 12, 8, 12}};
  refused(bad, "outside the world");
  bad = good;
  bad.material = static_cast<Material>(255);
  refused(bad, "material 255");
}

}  // namespace
}  // namespace scree
