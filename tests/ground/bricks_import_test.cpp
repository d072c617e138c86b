// Grounds of stored bricks: what is imported is what is read, caves and materials included, from near and
// far; damaged files are refused.
#include "tools/import/bricks_import.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "shared/field/field.h"
#include "shared/field/mass.h"
#include "shared/field/material_window.h"
#include "tests/support/box_solid.h"
#include "tests/support/test_folder.h"

namespace scree {
namespace {

class StoredBricks : public ::testing::Test {
 protected:
  void SetUp() override {
    hills_ = written_ground(folder_ / "hills.ground", 60, 50, 2.0F);
    table_ = written_table(folder_ / "table.ground", hills_);
    ASSERT_NE(table_, nullptr);
  }
  TerrainSource source(float voxel_size_m = 0.25F) const {
    return {.voxel_size_m = voxel_size_m, .heights = table_};
  }
  TerrainSource bare(float voxel_size_m = 0.25F) const {
    return {.voxel_size_m = voxel_size_m, .heights = hills_};
  }

  TestFolder folder_;
  std::shared_ptr<const GroundFile> hills_;
  std::shared_ptr<const GroundFile> table_;
};

TEST_F(StoredBricks, stand_on_the_ground_with_air_below_them) {
  const int top = static_cast<int>(top_m(bare()) * 4.0F) + 8;
  MapField field(source()), hills(bare());
  const auto is_rock = [](Field& of, VoxelCoord v) {
    return of.brick(brick_of(v)).codes[static_cast<size_t>(Brick::index(v.x & 7, v.y & 7, v.z & 7))] < 0;
  };
  EXPECT_TRUE(is_rock(field, {30, top + 4, 30}));
  EXPECT_FALSE(is_rock(field, {30, top + 10, 30}));
  EXPECT_FALSE(is_rock(field, {30, top - 4, 30})) << "an overhang";
  EXPECT_TRUE(is_rock(field, {0, top - 4, 0})) << "the leg";
  EXPECT_FALSE(is_rock(hills, {0, top - 4, 0}));
  for (int y = top - 8; y > top - 400; --y)
    EXPECT_EQ(is_rock(field, {100, y, 90}), is_rock(hills, {100, y, 90}));
  EXPECT_NEAR(ground_height_m(source(), 5.0F, 5.0F), 0.25F * static_cast<float>(top + 7), 0.5F);
  EXPECT_GT(top_m(source()), top_m(bare()));
}

TEST_F(StoredBricks, have_materials_that_pieces_and_layers_are_of) {
  const float y_m = 0.25F * (static_cast<float>(static_cast<int>(top_m(bare()) * 4.0F)) + 12.0F);
  MapField field(source()), hills(bare());
  EXPECT_EQ(material_at(field, {7.0F, y_m, 7.0F}), material::soil);
  EXPECT_EQ(material_at(hills, {7.0F, y_m, 7.0F}), material::rock);
}

TEST_F(StoredBricks, are_seen_from_afar_with_a_volume_alike) {
  std::vector<double> volumes_m3;
  for (const float voxel_m : {0.25F, 0.5F, 1.0F}) {
    MapField field(source(voxel_m)), hills(bare(voxel_m));
    MassUnits mass = 0;
    const int side = static_cast<int>(32.0F / voxel_m / chunk_size);
    const int high = static_cast<int>(top_m(source()) / voxel_m / chunk_size) + 1;
    for_each_chunk({first_voxel(ChunkCoord{-side, -1, -side}), first_voxel(ChunkCoord{side, high, side})},
                   [&](ChunkCoord chunk) {
                     for (int i = 0; i < 64; ++i) {
                       const BrickCoord brick = brick_in_chunk(chunk, i);
                       mass += brick_mass(field.brick(brick)) - brick_mass(hills.brick(brick));
                     }
                   });
    const auto voxel = static_cast<double>(voxel_m);
    volumes_m3.push_back(static_cast<double>(mass) / units_per_voxel * voxel * voxel * voxel);
  }
  EXPECT_GT(volumes_m3[0], 20.0 * 20.0 * 2.0);
  EXPECT_NEAR(volumes_m3[1], volumes_m3[0], 0.03 * volumes_m3[0]);
  EXPECT_NEAR(volumes_m3[2], volumes_m3[0], 0.06 * volumes_m3[0]);
}

TEST_F(StoredBricks, chunks_away_from_them_are_those_of_the_ground_below) {
  for (const ChunkCoord chunk : {ChunkCoord{4, 1, 4}, ChunkCoord{-3, 0, 0}, ChunkCoord{0, -9, 0}})
    EXPECT_TRUE(same_bricks(generate_chunk(source(), chunk), generate_chunk(bare(), chunk)));
  EXPECT_LE(floor_m(source(), 0, 0), floor_m(bare(), 0, 0)) << "among stored bricks there may be caves";
}

TEST_F(StoredBricks, make_the_same_file_each_time_and_another_for_other_bricks) {
  const auto again = written_table(folder_ / "again.ground", hills_);
  EXPECT_EQ(name_of(again->header()), name_of(table_->header()));
  EXPECT_NE(name_of(hills_->header()), name_of(table_->header()));
  EXPECT_EQ(again->header().ground.top, hills_->header().ground.top) << "of the same elevation model";
}

TEST_F(StoredBricks, of_a_damaged_file_are_refused_wherever_it_is_damaged) {
  const std::string whole = folder_ / "table.ground", bad = folder_ / "bad.ground";
  const auto size = static_cast<std::streamoff>(std::filesystem::file_size(whole));
  for (std::streamoff at = 0; at < size; at += size / 60 + 1) {
    std::filesystem::copy_file(whole, bad, std::filesystem::copy_options::overwrite_existing);
    {
      std::fstream file(bad, std::ios::binary | std::ios::in | std::ios::out);
      file.seekg(at);
      const char was = static_cast<char>(file.get());
      file.seekp(at);
      file.put(static_cast<char>(was ^ 0x10));
    }
    const bool unused = at >= (table_->header().format == 1 ? 188 : 224) &&
                        at < static_cast<std::streamoff>(header_bytes);  // zeros of the header
    EXPECT_TRUE(unused || !GroundFile::open(bad)) << "byte " << at;
    std::filesystem::resize_file(bad, static_cast<uintmax_t>(at));
    EXPECT_FALSE(GroundFile::open(bad)) << "cut at " << at;
  }
}

TEST_F(StoredBricks, beyond_the_world_or_inside_the_ground_are_refused_in_words) {
  const auto refusal = [&](const VoxelBox& box) {
    std::vector<std::unique_ptr<Solid>> solids;
    solids.push_back(std::make_unique<BoxSolid>(box));
    const auto imported = import_bricks(solids, folder_ / "none.ground", {.on = hills_}, [](double) {});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "none.ground"));
    return imported ? std::string() : imported.error().message;
  };
  EXPECT_NE(refusal({{0, 0, 0}, {10, 4000, 10}}).find("world_half_height_m"), std::string::npos);
  EXPECT_NE(refusal({{0, -1000, 0}, {10, -990, 10}}).find("inside the rock"), std::string::npos);
  EXPECT_NE(refusal({{0, 0, 0}, {0, 0, 0}}).find("no rock"), std::string::npos);
}

}  // namespace
}  // namespace scree
