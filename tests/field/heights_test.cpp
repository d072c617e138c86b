// Ground by heights: smooth, within the samples, of their volume, without sides, and exact only with its
// tiles.
#include "shared/field/heights.h"

#include <cmath>
#include <gtest/gtest.h>

#include "shared/base/limits.h"
#include "shared/field/field.h"
#include "shared/field/mass.h"
#include "shared/field/terrain.h"
#include "tests/support/memory_heights.h"

namespace scree {
namespace {

TerrainSource on(std::shared_ptr<const GroundModel> heights, float voxel_m = 0.25F) {
  return {TerrainKind::flat, 1, voxel_m, std::move(heights)};
}

TEST(Heights, layouts_say_how_many_tiles_cover_them) {
  const HeightLayout layout{129, 128, 1.0F, 0, 0, {}};
  EXPECT_EQ(layout.levels(), 2);
  EXPECT_EQ(layout.tiles(), 3U);
  EXPECT_EQ(layout.children({1, 0, 0}), (std::vector<TileKey>{{0, 0, 0}, {0, 1, 0}}));
  EXPECT_TRUE(layout.holds({0, 1, 0}));
  for (const TileKey none : {TileKey{0, 2, 0}, {0, 0, 1}, {2, 0, 0}, {0, -1, 0}, {-1, 0, 0}})
    EXPECT_FALSE(layout.holds(none));
}

TEST(Heights, layouts_beyond_the_limits_are_refused_by_name) {
  const HeightLayout good{87, 61, 10.0F, 0, 25600, {}};
  EXPECT_TRUE(validate(good));
  const auto refusal = [&](auto&& change) {
    HeightLayout bad = good;
    change(bad);
    const Result<void> valid = validate(bad);
    return valid ? std::string() : valid.error().message;
  };
  const auto names = [](const std::string& text, const char* limit) {
    return text.find(limit) != std::string::npos;
  };
  EXPECT_TRUE(names(refusal([](HeightLayout& l) { l.columns = 1; }), "height_samples_max"));
  EXPECT_TRUE(
      names(refusal([](HeightLayout& l) { l.rows = limits::height_samples_max + 1; }), "height_samples_max"));
  EXPECT_TRUE(names(refusal([](HeightLayout& l) { l.cell_m = NAN; }), "height_cell_min_m"));
  EXPECT_TRUE(names(refusal([](HeightLayout& l) { l.cell_m = 100.0F; }), "world_half_width_m"));
  EXPECT_TRUE(names(refusal([](HeightLayout& l) { l.highest = 481 * 256; }), "height_max_m"));
  EXPECT_TRUE(names(refusal([](HeightLayout& l) { l.lowest = l.highest + 1; }), "height_max_m"));
  EXPECT_FALSE(refusal([](HeightLayout& l) { l.layers.soil_below_m = INFINITY; }).empty());
}

TEST(Heights, a_plane_is_met_exactly_and_goes_on_level_beyond_its_edge) {
  const MemoryHeights plane(64, 64, 4.0F, [](int x, int) { return x * 256; });
  for (const double x_m : {-60.0, -31.3, 0.0, 7.77, 90.0})
    EXPECT_NEAR(height_at(plane, x_m, 5.0), x_m / 4.0 + 31.5, 1e-9);
  EXPECT_NEAR(height_at(plane, 1.0e30, 0.0), 63.0, 1e-9);
  EXPECT_NEAR(height_at(plane, 1.0e5, 0.0), 63.0, 1e-9);
  EXPECT_NEAR(height_at(plane, -1.0e5, 1.0e5), 0.0, 1e-9);
}

TEST(Heights, steps_of_whole_metres_between_wide_cells_make_neither_terraces_nor_creases) {
  // A slope of 1 in 20 in samples of whole metres: 0 0 1 1 2 2 ...
  const MemoryHeights stairs(64, 4, 10.0F, [](int x, int) { return x / 2 * 256; });
  double least = 1.0, most_bend = 0.0;
  for (double x_m = -200.0; x_m < 200.0; x_m += 0.25) {
    const double before = height_at(stairs, x_m - 0.25, 0.0), here = height_at(stairs, x_m, 0.0),
                 after = height_at(stairs, x_m + 0.25, 0.0);
    least = std::min(least, (after - before) / 0.5);
    most_bend = std::max(most_bend, std::abs(after - 2.0 * here + before) / (0.25 * 0.25));
  }
  EXPECT_GT(least, 0.02) << "it rises everywhere";
  EXPECT_LT(most_bend, 0.011)
      << "and bends by no more than the samples' second differences, 1 m in 10 m squared";
}

TEST(Heights, the_surface_stays_within_the_samples_and_has_their_volume) {
  const MemoryHeights model(96, 80, 2.0F, rough_height);
  double sum = 0.0, samples = 0.0;
  size_t count = 0;
  for (double z_m = -60.0; z_m < 60.0; z_m += 0.5)
    for (double x_m = -80.0; x_m < 80.0; x_m += 0.5, ++count) {
      const double height = height_at(model, x_m, z_m);
      EXPECT_GE(height * 256.0, model.layout().lowest);
      EXPECT_LE(height * 256.0, model.layout().highest);
      sum += height;
      const auto column = static_cast<int>(std::lround((x_m + 0.25) / 2.0 + 47.5)),
                 row = static_cast<int>(std::lround((z_m + 0.25) / 2.0 + 39.5));
      samples += rough_height(column, row) / 256.0;
    }
  EXPECT_NEAR(sum / samples, 1.0, 0.002);
}

TEST(Heights, chunks_are_the_same_each_time_and_agree_with_the_surface) {
  const TerrainSource ground = on(std::make_shared<MemoryHeights>(96, 80, 2.0F, rough_height));
  for (const ChunkCoord chunk : {ChunkCoord{0, 1, 0}, {-3, 1, 2}, {2, 2, -1}, {1, 3, 1}}) {
    const GeneratedChunk one = generate_chunk(ground, chunk), other = generate_chunk(ground, chunk);
    EXPECT_TRUE(one.exact);
    for (size_t i = 0; i < one.bricks.size(); ++i) {
      EXPECT_EQ(*one.bricks[i], *other.bricks[i]);
      const VoxelCoord first = first_voxel(brick_in_chunk(chunk, static_cast<int>(i)));
      for (int v = 0; v < brick_voxels; ++v) {
        const glm::vec3 p =
            glm::vec3(first.x + (v >> 6), first.y + ((v >> 3) & 7), first.z + (v & 7)) * 0.25F;
        const Code code = one.bricks[i]->codes[static_cast<size_t>(v)];
        if (const float density = ground_density(ground, p); std::abs(density) > 0.02F) {
          EXPECT_EQ(density < 0.0F, code < 0);
        }
      }
    }
  }
}

TEST(Heights, one_voxel_steps_change_the_distance_by_one_voxel_at_most_also_on_a_cliff) {
  MapField field(
      on(std::make_shared<MemoryHeights>(96, 80, 1.0F, [](int x, int) { return x < 48 ? 0 : 30 * 256; })));
  const VoxelBox box{{-16, -8, 0}, {32, 130, 4}};
  const Window window = gather(field, box);
  constexpr float most = codes_per_voxel + 1.0F;
  for (int x = box.lo.x; x + 1 < box.hi.x; ++x)
    for (int y = box.lo.y; y + 1 < box.hi.y; ++y)
      for (int z = box.lo.z; z + 1 < box.hi.z; ++z) {
        const int here = window.at(x, y, z);
        EXPECT_LE(std::abs(here - window.at(x + 1, y, z)), most);
        EXPECT_LE(std::abs(here - window.at(x, y + 1, z)), most);
        EXPECT_LE(std::abs(here - window.at(x, y, z + 1)), most);
      }
}

TEST(Heights, a_coarser_level_of_detail_is_decided_by_few_tiles_of_a_coarser_level) {
  const MemoryHeights model(4096, 4096, 1.0F, [](int x, int z) { return (x & 7) + (z & 7); });
  for (const float voxel_m : {0.25F, 1.0F, 4.0F, 32.0F, 500.0F})
    for (const ChunkCoord chunk : {ChunkCoord{0, 0, 0}, {3, 0, -4}, {-200, 0, 200}}) {
      const std::vector<TileKey> keys = tiles_of(model.layout(), chunk, voxel_m);
      EXPECT_GE(keys.size(), 1U);
      EXPECT_LE(keys.size(), 4U);
      for (const TileKey key : keys) EXPECT_TRUE(model.layout().holds(key));
    }
  EXPECT_EQ(tiles_of(model.layout(), {0, 0, 0}, 1.0F).front().level, 0);
  EXPECT_EQ(tiles_of(model.layout(), {0, 0, 0}, 4.0F).front().level, 2);
  EXPECT_EQ(tiles_of(model.layout(), {0, 0, 0}, 500.0F).front().level, model.layout().levels() - 1);
}

TEST(Heights, without_its_tile_a_chunk_is_not_exact_and_the_field_makes_it_anew_when_the_tile_has_come) {
  const auto model = std::make_shared<MemoryHeights>(300, 300, 1.0F, rough_height);
  const TerrainSource ground = on(model);
  const ChunkCoord chunk = chunk_of(VoxelCoord{0, static_cast<int>(ground_height_m(ground, 0, 0) * 4.0F), 0});
  MapField whole(ground);
  for (const TileKey key : tiles_of(model->layout(), chunk, 0.25F)) model->withhold(key);
  EXPECT_FALSE(is_here(ground, chunk));
  EXPECT_TRUE(is_here(ground, {chunk.x, 1000, chunk.z})) << "only air, whatever the tiles say";
  MapField field(ground);
  static_cast<void>(field.brick(first_brick(chunk)));
  EXPECT_FALSE(field.has_generated(chunk));
  field.adopt_generated(chunk, generate_chunk(ground, chunk));
  EXPECT_FALSE(field.has_generated(chunk)) << "what is not exact is not kept";
  for (const TileKey key : tiles_of(model->layout(), chunk, 0.25F)) model->give(key);
  for (int i = 0; i < 64; ++i)
    EXPECT_EQ(field.brick(brick_in_chunk(chunk, i)), whole.brick(brick_in_chunk(chunk, i)));
  EXPECT_TRUE(field.has_generated(chunk));
}

TEST(Heights, the_floor_of_a_column_is_no_higher_than_its_surface) {
  const TerrainSource ground = on(std::make_shared<MemoryHeights>(96, 80, 2.0F, rough_height));
  for (int x = -6; x < 6; ++x)
    for (int z = -6; z < 6; ++z) {
      const float floor = floor_m(ground, x, z);
      EXPECT_GE(floor, floor_m(ground));
      for (int i = 0; i <= chunk_size; i += 4)
        EXPECT_LE(floor, ground_height_m(ground, (x * chunk_size + i) * 0.25F, (z * chunk_size + i) * 0.25F));
    }
}

}  // namespace
}  // namespace scree
