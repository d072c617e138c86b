// What materials do to bodies, breaks and falls, against numbers computed by hand.
#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

#include "server/bodies/bodies.h"
#include "server/fracture/hull.h"
#include "server/world/world.h"
#include "shared/falling/support_search.h"
#include "shared/field/material_window.h"
#include "shared/operation/operation.h"
#include "tests/support/flat_world.h"
#include "tests/support/materials.h"
#include "tests/support/memory_heights.h"

namespace scree {
namespace {

Material named(std::string_view name) {
  return builtin_palette().named(name).value();
}

/// A box of so many voxels, whose low half along x is of one material and whose high half of another.
Volume composite(VoxelCoord size, Material low, Material high) {
  const VoxelBox box{{0, 0, 0}, size};
  Volume volume;
  volume.window = Window(box.grown(2), code_air);
  volume.materials = {volume.window.box, low, std::vector<Material>(volume.window.codes.size(), low)};
  for (int x = 0; x < size.x; ++x)
    for (int y = 0; y < size.y; ++y)
      for (int z = 0; z < size.z; ++z) {
        volume.window.at(x, y, z) = code_solid;
        const Material material = 2 * x < size.x ? low : high;
        volume.materials.each[volume.window.index(x, y, z)] = material;
        add(volume.masses, material, units_per_voxel);
        volume.mass += units_per_voxel;
      }
  volume.centre_voxels = 0.5F * (glm::vec3(size.x, size.y, size.z) - 1.0F);
  return volume;
}

TEST(material_physics, a_composite_has_the_centre_and_the_inertia_of_its_two_halves) {
  const VoxelCoord size{24, 10, 8};
  const Volume volume = composite(size, named("timber"), named("steel"));
  const WeighedVolume weighed = weigh(volume, make_hull(1, volume, voxel_m), builtin_palette(), voxel_m);
  const double timber = builtin_row(named("timber")).density_kg_m3;
  const double steel = builtin_row(named("steel")).density_kg_m3;
  const double a = size.x * voxel_m / 2, b = size.y * voxel_m, c = size.z * voxel_m;  // of a half
  const double m1 = timber * a * b * c, m2 = steel * a * b * c, m = m1 + m2;
  const double centre = (m2 - m1) / m * a / 2;  // from the middle
  EXPECT_NEAR(weighed.mass_kg / m, 1.0, 0.01);
  EXPECT_NEAR(static_cast<double>(weighed.centre_m.x) / centre, 1.0, 0.01);
  EXPECT_NEAR(weighed.centre_m.y, 0.0F, 1e-4F);
  const double about_x = m * (b * b + c * c) / 12;
  const auto half = [&](double mass, double at) {
    return mass * ((a * a) / 12 + (at - centre) * (at - centre));
  };
  const double along = half(m1, -a / 2) + half(m2, a / 2);
  EXPECT_NEAR(static_cast<double>(weighed.inertia_kg_m2[0][0]) / about_x, 1.0, 0.01);
  EXPECT_NEAR(static_cast<double>(weighed.inertia_kg_m2[1][1]) / (along + m * c * c / 12), 1.0, 0.01);
  EXPECT_NEAR(static_cast<double>(weighed.inertia_kg_m2[2][2]) / (along + m * b * b / 12), 1.0, 0.01);
}

TEST(material_physics, a_thrown_composite_turns_about_its_centre_of_mass) {
  MapField field(TerrainSource{TerrainKind::flat, 1, voxel_m});
  const Volume volume = composite({24, 8, 8}, named("timber"), named("steel"));
  const PieceHull hull = make_hull(1, volume, voxel_m);
  const WeighedVolume weighed = weigh(volume, hull, builtin_palette(), voxel_m);
  BodyShape shape;
  shape.hull_m = hull.corners_m;
  for (glm::vec3& p : shape.hull_m) p -= weighed.centre_m;
  shape.mass_kg = weighed.mass_kg;
  shape.inertia_kg_m2 = weighed.inertia_kg_m2;
  shape.centre_m = weighed.centre_m;
  Bodies bodies(field, {});
  BodyState state;
  state.id = 1;
  state.pose.position_m = {0.0F, 60.0F, 0.0F};
  state.spin_rad_s = {0.0F, 3.0F, 0.0F};
  bodies.add(shape, state);
  const auto centre_of_mass = [&] {
    const BodyState now = bodies.state(1);
    return now.pose.position_m + now.pose.rotation * weighed.centre_m;
  };
  const glm::vec3 before = centre_of_mass();
  const BodyState thrown = bodies.state(1);  // the spin that bodies of its size may have
  const glm::vec3 velocity = thrown.velocity_m_s + glm::cross(thrown.spin_rad_s, weighed.centre_m);
  for (int i = 0; i < 60; ++i) bodies.step();
  const glm::vec3 after = centre_of_mass();
  EXPECT_NEAR(after.x, before.x + velocity.x, 0.15F);
  EXPECT_NEAR(after.z, before.z + velocity.z, 0.15F) << "the volume's centre swings around it";
}

/// Friction at which a box begins to slide on a slope, as an angle in degrees.
float sliding_degrees(Material on, Material of) {
  const auto slides = [&](float degrees) {
    const float rise = std::tan(degrees * 3.14159265F / 180.0F);
    const auto height = [rise](int x, int) {
      return static_cast<int32_t>(256.0F * rise * static_cast<float>(x - 40));
    };
    TerrainSource source{TerrainKind::flat, 1, voxel_m};
    source.heights = std::make_shared<const MemoryHeights>(81, 81, 1.0F, height);
    source.rows = {on, on, on, 1.0F, 1.0F};
    MapField field(source);
    Bodies bodies(field, {});
    BodyShape shape;
    const glm::vec3 half(0.6F, 0.15F, 0.6F);
    for (int i = 0; i < 8; ++i)
      shape.hull_m.emplace_back((i & 4) != 0 ? half.x : -half.x, (i & 2) != 0 ? half.y : -half.y,
                                (i & 1) != 0 ? half.z : -half.z);
    shape.mass_kg = 8.0F * half.x * half.y * half.z * builtin_row(of).density_kg_m3;
    const glm::vec3 squares = half * half;
    const glm::vec3 sums(squares.y + squares.z, squares.x + squares.z, squares.x + squares.y);
    for (int axis = 0; axis < 3; ++axis) shape.inertia_kg_m2[axis][axis] = sums[axis] * shape.mass_kg / 3.0F;
    shape.friction = builtin_row(of).friction;
    shape.restitution = 0.0F;
    BodyState state;
    state.id = 1;
    const float angle = std::atan(rise);
    const glm::vec3 normal(-std::sin(angle), std::cos(angle), 0.0F);
    state.pose.position_m = normal * (half.y + 0.005F);
    state.pose.rotation = glm::angleAxis(angle, glm::vec3(0.0F, 0.0F, 1.0F));
    bodies.add(shape, state);
    for (int i = 0; i < 60; ++i) bodies.step();
    const glm::vec3 settled = bodies.state(1).pose.position_m;
    for (int i = 0; i < 240; ++i) bodies.step();
    return glm::length(bodies.state(1).pose.position_m - settled) > 0.05F;
  };
  float holds = 5.0F, slides_at = 60.0F;
  while (slides_at - holds > 0.25F) {
    const float middle = 0.5F * (holds + slides_at);
    (slides(middle) ? slides_at : holds) = middle;
  }
  return 0.5F * (holds + slides_at);
}

TEST(material_physics, boxes_slide_at_the_angle_of_the_friction_of_the_two_that_touch) {
  for (const auto& [on, of] : {std::pair("rock", "rock"),
                               {"rock", "ice"},
                               {"ice", "ice"},
                               {"soil", "timber"},
                               {"concrete", "brick"},
                               {"timber", "timber"},
                               {"clay", "steel"},
                               {"sand", "glass"}}) {
    const float friction = std::sqrt(builtin_row(named(on)).friction * builtin_row(named(of)).friction);
    const float wanted = std::atan(friction) * 180.0F / 3.14159265F;
    EXPECT_NEAR(sliding_degrees(named(on), named(of)), wanted, 2.0F) << of << " on " << on;
  }
}

/// Whether a block of the material that falls from that height breaks.
bool breaks(std::string_view material, float height_m) {
  World world(rock_world());
  const glm::vec3 place(0.0F, height_m + 0.5F, 0.0F);
  CarveRequest loosen;
  loosen.shape = box(place, glm::vec3(1.1F));
  loosen.seeds = 1;
  loosen.impact_m = place;
  loosen.blast_speed_m_s = 0.0F;
  const std::vector<Command> hang{{1, 1, FillRequest{box(place, glm::vec3(0.5F)), named(material)}},
                                  {1, 2, loosen}};
  const auto hung = world.step(hang);
  EXPECT_EQ(hung->spawned.size(), 1U) << hung->replies.back().refusal;
  bool broken = false;
  for (int i = 0; i < 240 && !broken; ++i) {
    const auto delta = world.step({});
    for (const AppliedOperation& applied : delta->operations)
      broken = broken || std::holds_alternative<ShatterOperation>(applied.operation);
  }
  return broken;
}

TEST(material_physics, glass_breaks_where_brick_does_not_and_brick_where_steel_does_not) {
  EXPECT_TRUE(breaks("glass", 2.0F));
  EXPECT_FALSE(breaks("brick", 2.0F));
  EXPECT_TRUE(breaks("brick", 8.0F));
  EXPECT_FALSE(breaks("steel", 8.0F));
}

TEST(material_physics, a_lintel_of_concrete_on_posts_of_brick_breaks_at_the_load_of_its_two_sections) {
  // Posts 1 m wide, the lintel spans 4 m between them, 0.75 m high and 1 m deep; a block of 2 m stands on it.
  const auto holds = [](double load_kg) {
    Palette palette = builtin_palette();
    MaterialRow block = builtin_row(named("steel"));
    block.name = "block";
    block.density_kg_m3 = static_cast<float>(load_kg / (2.0 * 2.0 * 1.0));
    palette.rows.push_back(block);
    const auto load = static_cast<Material>(palette.rows.size() - 1);
    MapField field(rock_terrain);
    PieceTable none;
    const auto fill = [&](glm::vec3 lo, glm::vec3 hi, Material material) {
      // Surfaces half-way between voxels, so that each voxel is wholly inside or outside.
      const glm::vec3 half = 0.5F * (hi - lo);
      apply(FillOperation{box(lo + half - 0.5F * voxel_m, half), material}, field, none);
    };
    fill({-3.0F, -1.0F, 0.0F}, {-2.0F, 3.0F, 1.0F}, named("brick"));
    fill({2.0F, -1.0F, 0.0F}, {3.0F, 3.0F, 1.0F}, named("brick"));
    fill({-3.0F, 3.0F, 0.0F}, {3.0F, 3.75F, 1.0F}, named("concrete"));
    fill({-1.0F, 3.75F, 0.0F}, {1.0F, 5.75F, 1.0F}, load);
    std::vector<BrickCoord> changed;
    for (const ChunkCoord chunk : field.edited_chunks())
      for (const BrickCoord brick : field.edited_bricks(chunk)) changed.push_back(brick);
    std::ranges::sort(changed);
    return find_overloads(field, palette, changed, 7).overloads.empty();
  };
  const MaterialRow& concrete = builtin_row(named("concrete"));
  const double section_m2 = 0.75 * 1.0,
               own_kg = 4.0 * section_m2 * static_cast<double>(concrete.density_kg_m3);
  const double wanted_kg =
      2.0 * section_m2 * static_cast<double>(concrete.bearing.sideways_pa) / 9.81 - own_kg;
  double holding = 0.2 * wanted_kg, breaking = 3.0 * wanted_kg;
  ASSERT_TRUE(holds(holding));
  ASSERT_FALSE(holds(breaking));
  while (breaking - holding > 0.01 * wanted_kg) {
    const double middle = 0.5 * (holding + breaking);
    (holds(middle) ? holding : breaking) = middle;
  }
  EXPECT_NEAR(holding / wanted_kg, 1.0, 0.1);
}

/// What a cube of rock is after its fall of a metre onto rock.
Material after_a_fall_of_cube(int side) {
  WorldConfig config = rock_world();
  config.methods.impacts = config.methods.dents = false;
  World world(config);
  const float half_m = 0.5F * static_cast<float>(side) * voxel_m;
  const Command hung{.body =
                         FillRequest{box({0.0F, half_m + 1.0F, 0.0F}, glm::vec3(half_m)), material::rock}};
  auto delta = world.step({&hung, 1});
  for (int tick = 0; tick < 300 && (tick < 60 || !delta->pieces.empty()); ++tick) delta = world.step({});
  EXPECT_TRUE(delta->pieces.empty());
  EXPECT_EQ(delta->ledger.error(), 0);
  return material_at(world.field(), {0.0F, 0.5F, 0.0F});
}

TEST(material_physics, stones_become_rubble_and_large_blocks_stay_rock) {
  EXPECT_EQ(after_a_fall_of_cube(6), named("rock_rubble"));
  EXPECT_EQ(after_a_fall_of_cube(14), material::rock);
}

}  // namespace
}  // namespace scree
