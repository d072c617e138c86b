// MagicaVoxel files: each voxel is one of the world with the material of its colour, models lie where their
// nodes put them, and what is exported comes back the same.
#include <fstream>
#include <gtest/gtest.h>
#include <set>

#include "content/builtin_palette.h"
#include "shared/field/material_window.h"
#include "tests/support/holds.h"
#include "tests/support/materials.h"
#include "tests/support/test_folder.h"
#include "tests/support/vox_bytes.h"
#include "tools/export/vox_export.h"
#include "tools/import/files/solid_files.h"
#include "tools/import/vox/vox_bricks.h"

namespace scree {
namespace {

void unseen(double) {}

using Colours = std::map<VoxelCoord, uint8_t>;

Colours colours_in(const std::string& file) {
  const auto scene = parse_vox({reinterpret_cast<const uint8_t*>(file.data()), file.size()});
  EXPECT_TRUE(scene) << scene.error().message;
  const auto placed = placed_voxels(*scene);
  EXPECT_TRUE(placed) << placed.error().message;
  Colours colours;
  for (const auto& [at, brick] : placed->bricks)
    for (int i = 0; i < brick_voxels; ++i)
      if (const uint8_t colour = brick[static_cast<size_t>(i)]; colour != 0)
        colours[first_voxel(at) + VoxelCoord{i >> 6, (i >> 3) & 7, i & 7}] = colour;
  return colours;
}

class VoxImportTest : public ::testing::Test {
 protected:
  /// The file as ground that stands far above level rock.
  MapField& imported(const std::string& file, SolidsImport how = {}) {
    const std::string path = folder_ / "made.vox", ground = folder_ / "made.ground";
    std::ofstream(path, std::ios::binary) << file;
    const auto read = read_solids({path}, how);
    EXPECT_TRUE(read) << read.error().message;
    said_ = read->said.front();
    const auto made = import_bricks(
        read->solids, ground, {.level_m = -200.0, .voxel_size_m = how.voxel_size_m, .palette = read->palette},
        unseen);
    EXPECT_TRUE(made) << made.error().message;
    const auto opened = GroundFile::open(ground);
    EXPECT_TRUE(opened) << opened.error().message;
    file_ = *opened;
    field_ = std::make_unique<MapField>(GroundFile::source_of(file_));
    return *field_;
  }
  std::string material(VoxelCoord at) const {
    const Brick& brick = field_->brick(brick_of(at));
    const size_t index = static_cast<size_t>(Brick::index(at.x & 7, at.y & 7, at.z & 7));
    if (brick.codes[index] >= 0) return "air";
    return std::string(file_->palette()->name(materials_of(*field_, brick_of(at))[index]));
  }

  TestFolder folder_;
  std::shared_ptr<const GroundFile> file_;
  std::unique_ptr<MapField> field_;
  std::string said_;
};

TEST_F(VoxImportTest, a_voxel_is_a_voxel_and_its_colour_a_row_of_the_palette) {
  VoxBytes vox;
  vox.model({3, 2, 4}, {{0, 0, 0, 1}, {2, 1, 3, 2}, {1, 0, 3, 216}});
  imported(vox.file());
  EXPECT_EQ(material({0, 0, -1}), "vox_1");
  EXPECT_EQ(material({2, 3, -2}), "vox_2") << "z is up in the file";
  EXPECT_EQ(material({1, 3, -1}), "vox_216");
  EXPECT_EQ(material({1, 0, -1}), "air");
  EXPECT_EQ(material({0, 1, -1}), "air");
  EXPECT_EQ(file_->header().format, 2U);
  ASSERT_EQ(stones_of(*file_->palette()), stones_of(builtin_palette()) + 3);
  EXPECT_EQ(file_->palette()->row(*file_->palette()->named("vox_1")).look.colour,
            (std::array{1.0F, 1.0F, 1.0F}))
      << "colour 1 is white";
  EXPECT_NEAR(file_->palette()->row(*file_->palette()->named("vox_2")).look.colour[2], 0.604F, 0.001F)
      << "0.8 of sRGB";
  EXPECT_TRUE(scree::holds(said_, "3 became rows of the palette: vox_1, vox_2, vox_216")) << said_;
}

TEST_F(VoxImportTest, nodes_turn_move_and_hide_models) {
  VoxBytes vox;
  vox.model({3, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 1}, {2, 0, 0, 2}});
  vox.transform(0, 1, {});
  vox.group(1, {2, 4, 6, 8});
  vox.transform(2, 3, {{"_t", "10 0 0"}});
  vox.shape(3, 0);
  vox.transform(4, 5,
                {{"_t", "0 20 0"}, {"_r", "17"}});  // x becomes y, y becomes −x: rows 1, 0 and the signs
  vox.shape(5, 0);
  vox.transform(6, 7, {{"_t", "50 0 0"}}, {{"_hidden", "1"}});
  vox.shape(7, 0);
  vox.transform(8, 9, {{"_t", "60 0 0"}}, {}, 3);
  vox.shape(9, 0);
  vox.chunk("LAYR", VoxBytes::number(3) + VoxBytes::attributes({{"_hidden", "1"}}) + VoxBytes::number(-1));
  imported(vox.file());
  EXPECT_EQ(material({9, 0, -1}), "vox_1");
  EXPECT_EQ(material({11, 0, -1}), "vox_2");
  EXPECT_EQ(material({12, 0, -1}), "air");
  const Colours colours = colours_in(vox.file());
  EXPECT_EQ(colours.size(), 6U) << "hidden ones are left out";
  EXPECT_EQ(colours.at({-1, 0, -20}), 1) << "turned about its middle voxel";
  EXPECT_EQ(colours.at({-1, 0, -22}), 2);
  EXPECT_TRUE(scree::holds(said_, "2 hidden parts left out")) << said_;
}

TEST_F(VoxImportTest, names_and_maps_choose_rows_of_the_palette) {
  VoxBytes vox;
  vox.model({4, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 2}, {2, 0, 0, 9}, {3, 0, 0, 20}});
  vox.chunk("NOTE", VoxBytes::number(2) + VoxBytes::number(5) + "brick" + VoxBytes::number(6) + "My Oak");
  SolidsImport how;
  how.material_map = {{"2", *builtin_palette().named("steel")},
                      {"My Oak", *builtin_palette().named("timber")}};
  imported(vox.file(), how);
  EXPECT_EQ(material({0, 0, -1}), "brick");
  EXPECT_EQ(material({1, 0, -1}), "steel") << "a number goes before a name";
  EXPECT_EQ(material({2, 0, -1}), "timber");
  EXPECT_EQ(material({3, 0, -1}), "vox_20");
  how.material = material::ice;
  imported(vox.file(), how);
  EXPECT_EQ(material({3, 0, -1}), "ice") << "one for all others";
  EXPECT_EQ(file_->palette(), shared_builtin_palette()) << "then there are no rows of the file";
}

TEST_F(VoxImportTest, more_colours_than_rows_share_them_by_median_cut) {
  VoxBytes vox;
  std::vector<std::array<int, 4>> voxels;
  for (int i = 1; i < 256; ++i) voxels.push_back({i, 0, 0, i});
  vox.model({256, 1, 1}, voxels);
  std::ofstream(folder_ / "all.vox", std::ios::binary) << vox.file();
  const auto refused = read_solids({folder_ / "all.vox"}, {});
  ASSERT_FALSE(refused) << "255 colours and the built-in rows";
  EXPECT_TRUE(scree::holds(refused.error().message, "--palette makes fewer"));
  imported(vox.file(), {.colour_rows_max = 100});
  EXPECT_EQ(stones_of(*file_->palette()), stones_of(builtin_palette()) + 100);
  EXPECT_TRUE(scree::holds(said_, "255 became 100 rows of the palette (--palette)")) << said_;
  imported(vox.file(), {.colour_rows_max = 0});
  EXPECT_EQ(file_->palette(), shared_builtin_palette());
}

TEST_F(VoxImportTest, a_scale_makes_voxels_larger_and_a_place_moves_them) {
  VoxBytes vox;
  vox.model({2, 1, 1}, {{0, 0, 0, 1}, {1, 0, 0, 2}});
  SolidsImport how;
  how.has_scale = true;
  how.place.scale = 1.0;
  how.place.at_m = {10.0, 2.0, 0.0};
  imported(vox.file(), how);
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(material({40 + i, 8 + i, -1 - i}), "vox_1");
    EXPECT_EQ(material({44 + i, 8 + i, -1 - i}), "vox_2");
  }
  EXPECT_EQ(material({39, 8, -1}), "air");
  EXPECT_EQ(material({48, 8, -1}), "air");
  EXPECT_EQ(material({40, 12, -1}), "air");
}

TEST_F(VoxImportTest, an_export_comes_back_with_equal_voxels_and_colours) {
  VoxBytes vox;
  std::vector<std::array<int, 4>> voxels;
  for (int x = 0; x < 40; ++x)
    for (int y = 0; y < 30; ++y)
      for (int z = 0; z < 20; ++z)
        if ((x * 7 + y * 5 + z * 3) % 4 != 0) voxels.push_back({x, y, z, 1 + (x / 3 + y / 5 + z) % 60});
  vox.model({40, 30, 20}, voxels);
  MapField& field = imported(vox.file());
  const ChunkBox box = chunks_of({-64.0F, -2.0F, -64.0F}, {64.0F, 20.0F, 64.0F}, 0.25F);
  const auto exported = export_vox(field, *file_->palette(), box, folder_ / "out.vox", unseen);
  ASSERT_TRUE(exported) << exported.error().message;
  EXPECT_EQ(exported->voxels, voxels.size());
  std::set<int> used;
  for (const auto& voxel : voxels) used.insert(voxel[3]);
  EXPECT_EQ(exported->materials, used.size());
  std::ifstream in(folder_ / "out.vox", std::ios::binary);
  const std::string back((std::istreambuf_iterator<char>(in)), {});
  const Colours before = colours_in(vox.file()), after = colours_in(back);
  ASSERT_EQ(after.size(), before.size());
  const auto was = parse_vox({reinterpret_cast<const uint8_t*>(vox.file().data()), vox.file().size()});
  const auto is = parse_vox({reinterpret_cast<const uint8_t*>(back.data()), back.size()});
  for (const auto& [at, colour] : before) {
    const auto found = after.find(at);
    ASSERT_NE(found, after.end()) << at.x << " " << at.y << " " << at.z;
    ASSERT_EQ(is->colours[found->second], was->colours[colour]);
    ASSERT_EQ(is->names.at(found->second), "vox_" + std::to_string(colour));
  }
}

TEST_F(VoxImportTest, a_wide_export_has_models_of_256_voxels) {
  VoxBytes vox;
  vox.model({200, 1, 1}, {{0, 0, 0, 1}, {199, 0, 0, 2}});
  vox.transform(0, 1, {});
  vox.group(1, {2, 4});
  vox.transform(2, 3, {{"_t", "0 0 0"}});
  vox.shape(3, 0);
  vox.transform(4, 5, {{"_t", "500 0 10"}});
  vox.shape(5, 0);
  MapField& field = imported(vox.file());
  const ChunkBox box = chunks_of({-40.0F, -8.0F, -8.0F}, {180.0F, 8.0F, 8.0F}, 0.25F);
  const auto exported = export_vox(field, *file_->palette(), box, folder_ / "out.vox", unseen);
  ASSERT_TRUE(exported) << exported.error().message;
  EXPECT_EQ(exported->voxels, 4U);
  EXPECT_GE(exported->models, 3U);
  std::ifstream in(folder_ / "out.vox", std::ios::binary);
  const Colours before = colours_in(vox.file()),
                after = colours_in(std::string((std::istreambuf_iterator<char>(in)), {}));
  for (const auto& [at, colour] : before) EXPECT_TRUE(after.contains(at)) << at.x;
}

}  // namespace
}  // namespace scree
