// Specks: nothing lighter than the smallest piece hangs loose, whatever was merged where.
#include "shared/recombine/specks.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "bench/support/scenes.h"
#include "server/world/world.h"
#include "shared/base/limits.h"
#include "shared/base/random.h"
#include "shared/falling/island.h"
#include "shared/field/edit.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/rounds.h"
#include "tests/support/world_steps.h"

namespace scree {
namespace {

constexpr VoxelBox air{{0, 16, 0}, {16, 32, 16}};

/// By brute force: every component of solid voxels in the box that does not touch its sides and is lighter
/// than a piece may be.
std::vector<Island> specks_by_brute_force(const Field& field, const VoxelBox& box) {
  const Window window = gather(field, box);
  std::vector<uint8_t> seen(window.codes.size(), 0);
  std::vector<Island> specks;
  for (int x = box.lo.x; x < box.hi.x; ++x)
    for (int y = box.lo.y; y < box.hi.y; ++y)
      for (int z = box.lo.z; z < box.hi.z; ++z) {
        if (window.at(x, y, z) >= 0 || seen[window.index(x, y, z)] != 0) continue;
        std::vector<VoxelCoord> voxels{{x, y, z}};
        seen[window.index(x, y, z)] = 1;
        bool inside = true;
        for (size_t i = 0; i < voxels.size(); ++i)
          for (const BrickCoord& face : brick_faces) {
            const VoxelCoord next = voxels[i] + VoxelCoord{face.x, face.y, face.z};
            inside = inside && box.holds(next);
            if (!box.holds(next) || window.at(next.x, next.y, next.z) >= 0) continue;
            if (seen[window.index(next.x, next.y, next.z)]++ == 0) voxels.push_back(next);
            seen[window.index(next.x, next.y, next.z)] = 1;
          }
        Island island{
            {box.hi, box.lo}, *std::min_element(voxels.begin(), voxels.end()), int64_t(voxels.size())};
        for (const VoxelCoord& v : voxels) {
          VoxelBox& b = island.box;
          b.lo = {std::min(b.lo.x, v.x), std::min(b.lo.y, v.y), std::min(b.lo.z, v.z)};
          b.hi = {std::max(b.hi.x, v.x + 1), std::max(b.hi.y, v.y + 1), std::max(b.hi.z, v.z + 1)};
        }
        if (!inside || std::max({island.box.size().x, island.box.size().y, island.box.size().z}) > 16)
          continue;
        Window around = gather(field, lift_box(island.box));
        if (lift(around, island.box, island.start).mass < limits::piece_mass_min) specks.push_back(island);
      }
  std::ranges::sort(specks, {}, &Island::start);
  return specks;
}

TEST(specks, the_search_finds_what_brute_force_finds_in_random_fields) {
  constexpr uint64_t fields = rounds(10, 3);
  size_t found = 0;
  MapField field(flat_terrain);
  std::vector<BrickCoord> bricks;
  for_each_brick(air, [&](BrickCoord brick) { bricks.push_back(brick); });
  for (uint64_t round = 0; round < fields; ++round) {
    Random random(round);
    Window window(air);
    const float share = 0.01F + 0.1F * random.unit();
    for (Code& code : window.codes)
      if (random.unit() < share) code = static_cast<Code>(-1 - static_cast<int>(random.below(127)));
    scatter(field, window);
    const std::vector<Island> want = specks_by_brute_force(field, air.grown(1));
    EXPECT_EQ(find_specks(field, bricks), want) << "round " << round;
    found += want.size();
  }
  EXPECT_GT(found, 50 * fields);
}

/// A ball, and a crumb of one voxel beside it.
Volume ball_with_a_crumb() {
  Volume volume;
  volume.window = codes_of(sphere({0.0F, 0.0F, 0.0F}, 2.5F), {{-6, -6, -6}, {7, 7, 12}});
  volume.window.at(0, 3, 8) = -100;
  volume.mass = mass_of(volume.window);
  return volume;
}

TEST(specks, what_an_odd_stamp_leaves_in_the_air_becomes_dust_to_the_unit) {
  MapField field(flat_terrain);
  PieceTable pieces{{1, std::make_shared<const Volume>(ball_with_a_crumb())}};
  const MassUnits mass = pieces.at(1)->mass;
  const QuantisedPose pose = quantise({{5.0F, 0.5F, 5.0F}, glm::quat(1.0F, 0.0F, 0.0F, 0.0F)});
  const StampPlan plan = plan_stamp(StampMethod::stamp, gather(field, stamp_box(*pieces.at(1), pose, 0.25F)),
                                    *pieces.at(1), pose, 0.25F, mass);
  const Applied stamped = apply(StampOperation{1, pose, plan.shift}, field, pieces);
  const VoxelBox around{{0, -16, 0}, {40, 24, 40}};
  const std::vector<Island> specks = find_specks(field, stamped.changed);
  ASSERT_EQ(specks.size(), 1U);
  EXPECT_EQ(specks, specks_by_brute_force(field, around));
  const MassUnits before = mass_of(gather(field, around));
  const Applied swept = apply(IslandOperation{specks[0].box, specks[0].start, 2}, field, pieces);
  EXPECT_TRUE(pieces.empty());
  EXPECT_GT(swept.dust, 0);
  EXPECT_EQ(swept.terrain_gain, -swept.dust);
  EXPECT_EQ(mass_of(gather(field, around)) - before, swept.terrain_gain);
  EXPECT_TRUE(find_specks(field, stamped.changed).empty());
  EXPECT_TRUE(specks_by_brute_force(field, around).empty());
}

/// The smallest box of whole bricks with all that was edited, and a brick more.
VoxelBox edited_box(const Field& field) {
  VoxelBox box;
  for (const ChunkCoord chunk : field.edited_chunks())
    for (const BrickCoord brick : field.edited_bricks(chunk)) {
      const VoxelCoord v = first_voxel(brick);
      if (box.empty()) box = {v, v + VoxelCoord{brick_size, brick_size, brick_size}};
      box.lo = {std::min(box.lo.x, v.x), std::min(box.lo.y, v.y), std::min(box.lo.z, v.z)};
      box.hi = {std::max(box.hi.x, v.x + brick_size), std::max(box.hi.y, v.y + brick_size),
                std::max(box.hi.z, v.z + brick_size)};
    }
  return box.grown(brick_size);
}

template <typename Kind>
size_t count_of(const TickDelta& delta) {
  return static_cast<size_t>(std::ranges::count_if(delta.operations, [](const AppliedOperation& applied) {
    return std::holds_alternative<Kind>(applied.operation);
  }));
}

/// Specks in a tick in which nothing was carved that they could come from.
size_t swept_by_merges(const TickDelta& delta) {
  return count_of<CarveOperation>(delta) == 0 ? count_of<IslandOperation>(delta) : 0;
}

class SpecksAfterMerges : public ::testing::TestWithParam<Recombination> {};

TEST_P(SpecksAfterMerges, none_are_left_over_random_cycles_of_blows_and_merges) {
  constexpr int cycles = rounds(25, 6);
  WorldConfig config;
  config.methods.recombine = GetParam();
  World world(config);
  ScatteredBlows blows(config.terrain, 4.0F, 1.2F, 24, 5);
  size_t swept = 0;
  for (int cycle = 0; cycle < cycles; ++cycle) {
    auto delta = world.step(std::vector<Command>{{1, 1, blows.next()}});
    for (int tick = 0; tick < settle_ticks_max && !delta->pieces.empty(); ++tick) {
      delta = world.step({});
      swept += swept_by_merges(*delta);
    }
    ASSERT_TRUE(delta->pieces.empty());
    ASSERT_EQ(world.measure_terrain(), delta->ledger.terrain);
    const auto left = specks_by_brute_force(world.field(), edited_box(world.field()));
    EXPECT_TRUE(left.empty()) << left.size() << " specks after cycle " << cycle;
  }
  // Slices leave many, stamps hardly any.
  EXPECT_TRUE(swept > 0 || GetParam() == Recombination::stamp);
}

INSTANTIATE_TEST_SUITE_P(specks, SpecksAfterMerges,
                         ::testing::Values(Recombination::stamp, Recombination::slices));

}  // namespace
}  // namespace scree
