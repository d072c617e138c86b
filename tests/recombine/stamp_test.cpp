// Stamps: a piece at rest becomes terrain, with exactly its mass.
#include "shared/recombine/stamp.h"

#include <gtest/gtest.h>

#include "shared/field/redistance.h"
#include "shared/operation/operation.h"
#include "shared/operation/prepared_stamp.h"
#include "shared/recombine/merge_patch.h"
#include "tests/support/flat_terrain.h"

namespace scree {
namespace {

/// Pieces of a ball out of the ground, and where they lie turned on it, apart from each other.
struct Rubble {
  MapField field{{TerrainKind::noise, 3, voxel_m}};
  PieceTable pieces;
  std::vector<std::pair<PieceId, QuantisedPose>> places;

  Rubble() {
    const glm::vec3 centre(0.0F, ground_height_m(field.source(), 0.0F, 0.0F) - 0.8F, 0.0F);
    apply(CarveOperation{sphere(centre, 2.0F), SeedPattern::uniform, 40, 7, centre, 1}, field, pieces);
    for (const auto& [id, volume] : pieces) {
      const auto place = static_cast<float>(places.size());
      const float x = 4.0F * place - 60.0F, z = 12.0F;
      const glm::quat rotation =
          glm::normalize(glm::quat(1.0F, 0.1F * place, 0.3F - 0.05F * place, 0.02F * place));
      places.emplace_back(id, quantise({{x, ground_height_m(field.source(), x, z) + 0.3F, z}, rotation}));
    }
  }
};

constexpr auto laying = kinds_that<StampMethod, lays>;

void gain_to_a_thousandth(StampMethod method) {
  for (const MassUnits dust : {0, 160}) {
    Rubble rubble;
    for (const auto& [id, pose] : rubble.places) {
      const std::shared_ptr<const Volume> volume = rubble.pieces.at(id);
      const MassUnits mass = volume->mass + dust;
      const Window window = gather(rubble.field, stamp_box(*volume, pose, voxel_m));
      const StampPlan plan = plan_stamp(method, window, *volume, pose, voxel_m, mass);
      const Applied applied =
          apply(StampOperation{id, pose, plan.shift, method}, rubble.field, rubble.pieces);
      EXPECT_EQ(applied.terrain_gain, plan.gain) << "piece " << id;
      EXPECT_LE(std::abs(applied.terrain_gain - mass) * 1000, mass) << "piece " << id;
    }
  }
}

TEST(stamp, a_piece_on_the_ground_gains_its_mass_and_the_dust_to_a_thousandth) {
  for (const StampMethod method : laying) {
    SCOPED_TRACE(name_of(method));
    gain_to_a_thousandth(method);
  }
}

TEST(stamp, single_codes_place_what_they_say_and_move_no_voxel_to_the_other_side) {
  Rubble rubble;
  for (const auto& [id, pose] : rubble.places) {
    const Window laid = lay(laying_rounded, *rubble.pieces.at(id), pose, voxel_m);
    const Window terrain = gather(rubble.field, merge_box(laid));
    for (const int units : {1, -1, 5, 6, -13, 100, -100, 401}) {
      MergePatch patch(terrain, laid, units % 2 == 0 ? Edges::round : Edges::sharp);
      const MassUnits shaped = patch.shape(20);
      const std::vector<Code> before = patch.codes();
      const MassUnits placed = patch.place(units);
      EXPECT_LE(placed, units);
      Window after = terrain;
      after.codes = patch.codes();
      for (size_t i = 0; i < before.size(); ++i) EXPECT_EQ(before[i] < 0, after.codes[i] < 0);
      redistance(after);
      EXPECT_EQ(mass_of(after) - mass_of(terrain), shaped + placed) << "piece " << id << ", units " << units;
    }
  }
}

TEST(stamp, what_it_reads_holds_all_that_it_may_change) {
  Rubble rubble;
  for (const auto& [id, pose] : rubble.places) {
    const Window laid = lay(laying_rounded, *rubble.pieces.at(id), pose, voxel_m);
    const VoxelBox reach = merge_box(laid);
    EXPECT_EQ(common(reach, stamp_box(*rubble.pieces.at(id), pose, voxel_m)), reach);
    const Window terrain = gather(rubble.field, reach);
    Window after = terrain;
    MergePatch patch(terrain, laid, Edges::round);
    patch.shape(stamp_roundness_max);
    patch.place(3000);
    after.codes = patch.codes();
    redistance(after);
    EXPECT_NE(after.codes, terrain.codes);
    const Window inner = part_of(after, reach.grown(-1));
    Window framed = terrain;
    for (int x = inner.box.lo.x; x < inner.box.hi.x; ++x)
      for (int y = inner.box.lo.y; y < inner.box.hi.y; ++y)
        for (int z = inner.box.lo.z; z < inner.box.hi.z; ++z) framed.at(x, y, z) = inner.at(x, y, z);
    EXPECT_EQ(framed.codes, after.codes) << "piece " << id;
  }
}

TEST(stamp, what_was_prepared_changes_nothing_but_the_time_it_takes) {
  for (const StampMethod method : all_kinds<StampMethod>) {
    Rubble with, without;
    for (const auto& [id, pose] : with.places) {
      const MassUnits mass = with.pieces.at(id)->mass;
      const PreparedStamp prepared = prepare_stamp(with.field, with.pieces, id, pose, method, mass);
      const Applied a = apply(prepared.operation, with.field, with.pieces, &prepared);
      const Applied b = apply(prepared.operation, without.field, without.pieces);
      EXPECT_EQ(a.terrain_gain, b.terrain_gain);
      EXPECT_EQ(a.terrain_gain, prepared.gain);
      EXPECT_EQ(a.changed, b.changed);
      ASSERT_EQ(with.field.hash(), without.field.hash()) << "piece " << id;
    }
  }
}

TEST(stamp, what_was_prepared_for_another_field_or_operation_is_not_taken) {
  Rubble rubble, other;
  const auto& [id, pose] = rubble.places.front();
  const MassUnits mass = rubble.pieces.at(id)->mass;
  const PreparedStamp prepared =
      prepare_stamp(rubble.field, rubble.pieces, id, pose, StampMethod::stamp, mass);
  EXPECT_TRUE(prepared.holds(prepared.operation, rubble.field, {rubble.pieces.at(id)}));
  EXPECT_FALSE(prepared.holds(prepared.operation, rubble.field, {other.pieces.at(id)}));
  StampOperation moved = prepared.operation;
  moved.pose.x += 1;
  EXPECT_FALSE(prepared.holds(moved, rubble.field, {rubble.pieces.at(id)}));
  const glm::vec3 ground = dequantise(pose).position_m;
  apply(FillOperation{sphere(ground, 1.0F)}, rubble.field, rubble.pieces);
  apply(FillOperation{sphere(ground, 1.0F)}, other.field, other.pieces);
  EXPECT_FALSE(prepared.holds(prepared.operation, rubble.field, {rubble.pieces.at(id)}));
  apply(prepared.operation, rubble.field, rubble.pieces, &prepared);
  apply(prepared.operation, other.field, other.pieces);
  EXPECT_EQ(rubble.field.hash(), other.field.hash());
}

TEST(stamp, every_shift_there_is_can_be_applied) {
  for (const StampMethod method : laying)
    for (const int shift : {-stamp_shift_max, -stamp_shift_max / 2, -1, 0, 1, 127, 128, stamp_shift_max}) {
      Rubble rubble;
      const auto& [id, pose] = rubble.places.front();
      const Applied applied = apply(StampOperation{id, pose, shift, method}, rubble.field, rubble.pieces);
      EXPECT_GT(applied.terrain_gain, 0) << name_of(method) << ", shift " << shift;
    }
}

}  // namespace
}  // namespace scree
