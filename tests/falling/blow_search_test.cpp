// What a blow breaks off: the weakest of a plug, a cut, a bent section and a span; the same however hard.
#include "shared/falling/blow_search.h"

#include <gtest/gtest.h>
#include <memory>

#include "shared/falling/load_flow.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_terrain.h"
#include "tests/support/materials.h"

namespace scree {
namespace {

constexpr int reach_bricks = 7;

/// Boxes of rock on flat rock, by lowest corner and size, metres, between planes of voxels.
std::unique_ptr<Field> built(const std::vector<std::pair<glm::vec3, glm::vec3>>& boxes) {
  auto field = std::make_unique<MapField>(rock_terrain);
  PieceTable none;
  for (const auto& [lo_m, size_m] : boxes)
    apply(FillOperation{box(lo_m + 0.5F * size_m - 0.5F * voxel_m, 0.5F * size_m)}, *field, none);
  return field;
}

BlowLoad load_on(std::vector<VoxelCoord> on, glm::dvec3 newtons) {
  glm::dvec3 at(0.0);
  for (const VoxelCoord v : on) at += glm::dvec3(v.x, v.y, v.z) / static_cast<double>(on.size());
  return {std::move(on), at, newtons};
}

BlowFound struck(Field& field, const BlowLoad& load) {
  return find_break(field, builtin_palette(), load, reach_bricks);
}

/// A roof of one voxel, 5 m above the ground, on four walls.
std::unique_ptr<Field> roof() {
  return built({{{-6.0F, -0.5F, -6.0F}, {1.0F, 5.5F, 12.0F}},
                {{5.0F, -0.5F, -6.0F}, {1.0F, 5.5F, 12.0F}},
                {{-6.0F, -0.5F, -6.0F}, {12.0F, 5.5F, 1.0F}},
                {{-6.0F, -0.5F, 5.0F}, {12.0F, 5.5F, 1.0F}},
                {{-6.0F, 5.0F, -6.0F}, {12.0F, 0.25F, 12.0F}}});
}

TEST(BlowSearch, a_roof_of_one_voxel_lets_a_block_through_and_stops_a_pebble) {
  const auto field = roof();
  const BlowLoad block = load_on({{-4, 20, -4}, {-4, 20, 3}, {3, 20, -4}, {3, 20, 3}}, {0.0, -3e7, 0.0});
  const BlowFound found = struck(*field, block);
  ASSERT_TRUE(found.overload.has_value());
  EXPECT_LT(found.share, 0.2);
  BlowLoad pebble = block;
  pebble.newtons = {0.0, -1e3, 0.0};
  EXPECT_FALSE(struck(*field, pebble).overload.has_value());
}

TEST(BlowSearch, a_plug_is_what_was_struck_and_bears_what_shears_it) {
  // Between walls that are so near that the roof bears more in bending.
  const auto field = built({{{-2.0F, -0.5F, -2.0F}, {1.5F, 5.5F, 4.0F}},
                            {{0.75F, -0.5F, -2.0F}, {1.5F, 5.5F, 4.0F}},
                            {{-2.0F, 5.0F, -2.0F}, {4.25F, 0.25F, 4.0F}}});
  const BlowLoad load = load_on({{-1, 20, -1}, {-1, 20, 1}, {1, 20, -1}, {1, 20, 1}}, {0.0, -2e6, 0.0});
  const BlowFound found = struck(*field, load);
  ASSERT_TRUE(found.overload.has_value());
  const float sideways_pa = builtin_row(material::rock).bearing.sideways_pa;
  EXPECT_LE(found.share * 2e6, 1.01 * static_cast<double>(12.0F * voxel_m * voxel_m * sideways_pa))
      << "twelve faces around nine voxels bear no more";
}

TEST(BlowSearch, a_pillar_snaps_and_massive_rock_holds) {
  const auto field =
      built({{{0.0F, -0.5F, 0.0F}, {0.5F, 6.5F, 0.5F}}, {{10.0F, -0.5F, -8.0F}, {16.0F, 10.5F, 16.0F}}});
  const BlowFound found = struck(*field, load_on({{0, 12, 0}, {0, 12, 1}}, {3.6e7, 0.0, 0.0}));
  ASSERT_TRUE(found.overload.has_value());
  EXPECT_LT(found.share, 0.05);
  const BlowLoad at_rock = load_on({{40, 20, 0}, {40, 20, 1}}, {5e6, 0.0, 0.0});
  EXPECT_TRUE(surely_holds(*field, builtin_palette(), at_rock));
  EXPECT_FALSE(struck(*field, at_rock).overload.has_value());
}

TEST(BlowSearch, a_tower_breaks_at_its_foot_at_the_force_that_bends_it_so_far) {
  const auto field = built({{{0.0F, -0.5F, -2.0F}, {1.5F, 12.5F, 4.0F}}});
  const BlowFound found = struck(*field, load_on({{0, 40, -2}, {0, 40, 1}}, {1e7, 0.0, 0.0}));
  ASSERT_TRUE(found.overload.has_value());
  EXPECT_TRUE(found.overload->by_leverage);
  EXPECT_LT(found.overload->necks.front().box.lo.y, 8);
  // σ = F L / W − the weight's pressure.
  const MaterialRow& rock = builtin_row(material::rock);
  const double modulus_m3 = 4.0 * 1.5 * 1.5 / 6.0, lever_m = 10.0;
  const double pressed_pa = 12.0 * 9.81 * static_cast<double>(rock.density_kg_m3);
  const double breaks_n = (static_cast<double>(rock.bearing.bending_pa) + pressed_pa) * modulus_m3 / lever_m;
  EXPECT_NEAR(found.share * 1e7 / breaks_n, 1.0, 0.15);
}

TEST(BlowSearch, what_breaks_does_not_depend_on_how_much_harder_the_blow_is) {
  const auto scenes = [] {
    std::vector<std::pair<std::unique_ptr<Field>, BlowLoad>> all;
    all.emplace_back(roof(), load_on({{-4, 20, -4}, {3, 20, 3}}, {0.0, -1.0, 0.0}));
    all.emplace_back(built({{{0.0F, -0.5F, -2.0F}, {1.5F, 12.5F, 4.0F}}}),
                     load_on({{0, 40, -2}, {0, 40, 1}}, {1.0, 0.0, 0.0}));
    all.emplace_back(built({{{0.0F, -0.5F, -5.0F}, {0.5F, 6.5F, 10.0F}}}),
                     load_on({{0, 16, 0}, {0, 17, 0}}, {1.0, 0.0, 0.0}));
    return all;
  }();
  for (const auto& [field, unit] : scenes) {
    std::optional<BlowFound> first;
    for (const double newtons : {1e4, 1e5, 1e6, 4e6, 1.6e7, 6.4e7, 2.56e8}) {
      BlowLoad load = unit;
      load.newtons *= newtons;
      BlowFound found = struck(*field, load);
      if (!found.overload) {
        EXPECT_FALSE(first.has_value()) << "a weaker blow broke it, " << newtons << " N do not";
        continue;
      }
      found.share *= newtons;
      if (!first) first = found;
      EXPECT_NEAR(found.share / first->share, 1.0, 0.02) << newtons;
      EXPECT_EQ(found.overload->necks, first->overload->necks) << newtons;
    }
    EXPECT_TRUE(first.has_value());
  }
}

TEST(BlowSearch, of_sections_that_are_equally_weak_the_nearest_to_the_load_breaks) {
  LoadFlow flow;
  for (int i = 0; i < 6; ++i) flow.add_node(i == 0 ? 10 : 0);
  for (uint32_t i = 0; i < 5; ++i) flow.link(i, i + 1, i == 1 || i == 3 ? 4 : 6, 0);
  flow.ground(5);
  ASSERT_TRUE(flow.run(1000));
  EXPECT_EQ(flow.left(), 6);
  EXPECT_EQ(flow.smallest_overloaded(), (std::vector<bool>{true, true, false, false, false, false}));
  EXPECT_TRUE(flow.overloaded(3)) << "the largest of them reaches farther";
}

}  // namespace
}  // namespace scree
