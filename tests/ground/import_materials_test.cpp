// What imported rock is of: by voxel, by name, by colour, from near and far; and the palette that a ground
// carries.
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "content/builtin_palette.h"
#include "shared/field/material_window.h"
#include "tests/support/box_solid.h"
#include "tests/support/holds.h"
#include "tests/support/materials.h"
#include "tests/support/test_folder.h"
#include "tools/export/mesh_export.h"
#include "tools/export/vdb/vdb_export.h"
#include "tools/import/colour_rows.h"
#include "tools/import/files/material_choice.h"
#include "tools/import/files/solid_files.h"
#include "tools/import/gdal/gdal_raster.h"

namespace scree {
namespace {

void no_bar(double) {}

Material named(std::string_view name) {
  return *builtin_palette().named(name);
}

/// Two blocks of 4 m that touch at x = 0, of two materials; the right one goes beyond the left by `wider_m`
/// on four sides.
std::string two_blocks(const std::string& left, const std::string& right, int wider_m = 0) {
  std::string obj = "mtllib two.mtl\n";
  int first = 1;
  for (const auto& [x, material] : {std::pair(-4, left), std::pair(0, right)}) {
    const int lo = x == 0 ? -wider_m : 0, side = 4 - 2 * lo;
    for (int i = 0; i < 8; ++i)
      obj += "v " + std::to_string(x + 4 * (i >> 2)) + " " + std::to_string(2 + lo + side * ((i >> 1) & 1)) +
             " " + std::to_string(lo + side * (i & 1)) + "\n";
    obj += "usemtl " + material + "\n";
    for (const auto& quad :
         {std::array{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}}) {
      obj += "f";
      for (const int corner : quad) obj += " " + std::to_string(first + corner);
      obj += "\n";
    }
    first += 8;
  }
  return obj;
}

class ImportMaterials : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(folder_ / "two.mtl") << "newmtl Red_Tiles\nKd 0.5 0.1 0.1\nnewmtl Moss\nKd 0.1 0.4 0.1\n"
                                          "newmtl brick\nKd 0 0 0\nnewmtl glass\nKd 0 0 0\n";
  }
  void import(const std::string& obj, SolidsImport how = {}) {
    std::ofstream(folder_ / "two.obj") << obj;
    const auto read = read_solids({folder_ / "two.obj"}, how);
    ASSERT_TRUE(read) << read.error().message;
    said_.clear();
    for (const std::string& line : read->said) said_ += line + "\n";
    make(*read, how.material);
  }
  void make(const SolidsRead& read, std::optional<Material> material = std::nullopt) {
    BricksImport how{.level_m = read.level_m.value_or(0.0),
                     .layers = read.layers,
                     .palette = read.palette,
                     .material = material,
                     .exact = read.exact};
    const auto made = import_bricks(read.solids, folder_ / "made.ground", how, no_bar);
    ASSERT_TRUE(made) << made.error().message;
    const auto file = GroundFile::open(folder_ / "made.ground");
    ASSERT_TRUE(file) << file.error().message;
    file_ = *file;
    field_ = std::make_unique<MapField>(GroundFile::source_of(file_));
  }
  std::string at(glm::vec3 p_m) const {
    return std::string(file_->palette()->name(material_at(*field_, p_m)));
  }

  TestFolder folder_;
  std::shared_ptr<const GroundFile> file_;
  std::unique_ptr<MapField> field_;
  std::string said_;
};

TEST_F(ImportMaterials, of_meshes_change_between_two_voxels_of_a_brick) {
  import(two_blocks("brick", "glass"));
  EXPECT_EQ(at({-0.5F, 4.0F, 0.25F}), "brick");
  EXPECT_EQ(at({0.5F, 4.0F, 0.25F}), "glass");
  EXPECT_EQ(at({0.0F, -0.5F, 0.0F}), "rock") << "the level ground stays what it was";
  EXPECT_EQ(file_->palette(), shared_builtin_palette());
  EXPECT_EQ(file_->header().format, 2U) << "older programs know no bricks and glass";
  EXPECT_TRUE(scree::holds(said_, "of the palette: brick, glass")) << said_;
}

TEST_F(ImportMaterials, of_meshes_that_touch_are_those_of_each_up_to_the_face_between) {
  // Faces that are the same are none; of these, each block has its own.
  import(two_blocks("brick", "glass", 1));
  for (const float off_m : {0.25F, 0.5F, 1.0F, 1.75F}) {
    EXPECT_EQ(at({-off_m, 4.0F, 2.0F}), "brick") << off_m;
    EXPECT_EQ(at({off_m, 4.0F, 2.0F}), "glass") << off_m;
  }
}

TEST_F(ImportMaterials, of_other_names_become_rows_of_their_colours) {
  import(two_blocks("Red_Tiles", "Moss"));
  EXPECT_EQ(at({-2.0F, 4.0F, 0.25F}), "red_tiles");
  EXPECT_EQ(at({2.0F, 4.0F, 0.25F}), "moss");
  EXPECT_EQ(stones_of(*file_->palette()), stones_of(builtin_palette()) + 2);
  EXPECT_NEAR(file_->palette()->row(*file_->palette()->named("moss")).look.colour[1], 0.4F, 1e-6F);
  EXPECT_TRUE(scree::holds(said_, "'Moss' as moss")) << said_;
}

TEST_F(ImportMaterials, are_chosen_by_a_map_by_one_for_all_or_by_few_colours) {
  import(two_blocks("Red_Tiles", "Moss"), {.material_map = { { "Moss", named("soil") } }});
  EXPECT_EQ(at({2.0F, 4.0F, 0.25F}), "soil");
  EXPECT_EQ(at({-2.0F, 4.0F, 0.25F}), "red_tiles");
  import(two_blocks("Red_Tiles", "Moss"), {.material = named("sand")});
  EXPECT_EQ(at({2.0F, 4.0F, 0.25F}), "sand");
  EXPECT_TRUE(scree::holds(said_, "sand (--material)")) << said_;
  EXPECT_EQ(file_->palette(), shared_builtin_palette());
  import(two_blocks("Red_Tiles", "Moss"), {.colour_rows_max = 1});
  EXPECT_EQ(at({2.0F, 4.0F, 0.25F}), at({-2.0F, 4.0F, 0.25F})) << "both are one row";
  EXPECT_EQ(stones_of(*file_->palette()), stones_of(builtin_palette()) + 1);
  import(two_blocks("Red_Tiles", "Moss"), {.colour_rows_max = 0});
  EXPECT_EQ(at({2.0F, 4.0F, 0.25F}), "rock");
}

/// A picture of two grey pixels; one block is of the left one, the other of the right one.
TEST_F(ImportMaterials, with_a_picture_have_its_colours) {
  const std::vector<uint8_t> pixels{40, 200};
  ASSERT_TRUE(write_grey_png(folder_ / "grey.png", 2, 1, pixels));
  std::ofstream(folder_ / "two.mtl") << "newmtl Wall\nKd 1 1 1\nmap_Kd grey.png\n";
  std::string obj = two_blocks("Wall", "Wall");
  obj.insert(obj.find("usemtl"), "vt 0.25 0.5\nvt 0.75 0.5\n");
  std::string textured;
  int block = 0;
  for (size_t i = 0; i < obj.size(); ++i) {
    if (obj.compare(i, 6, "usemtl") == 0) ++block;
    textured += obj[i];
    const bool is_corner = obj[i] >= '0' && obj[i] <= '9' && (obj[i + 1] == ' ' || obj[i + 1] == '\n') &&
                           obj[obj.rfind('\n', i) + 1] == 'f';
    if (is_corner) textured += "/" + std::to_string(block);
  }
  import(textured);
  EXPECT_EQ(stones_of(*file_->palette()), stones_of(builtin_palette()) + 2);
  const auto red = [&](glm::vec3 p_m) {
    return static_cast<int>(srgb_of_linear(file_->palette()->row(material_at(*field_, p_m)).look.colour[0]));
  };
  EXPECT_NEAR(red({-2.0F, 4.0F, 0.25F}), 40, 4);
  EXPECT_NEAR(red({2.0F, 4.0F, 0.25F}), 200, 4);
  std::filesystem::remove(folder_ / "grey.png");
  import(textured);
  EXPECT_TRUE(scree::holds(said_, "1 picture of materials could not be read")) << said_;
  EXPECT_EQ(red({-2.0F, 4.0F, 0.25F}), 255) << "then the material's own";
}

TEST_F(ImportMaterials, are_seen_from_afar_too) {
  import(two_blocks("brick", "glass"));
  for (const float voxel_m : {0.5F, 1.0F}) {
    TerrainSource source = GroundFile::source_of(file_);
    source.voxel_size_m = voxel_m;
    MapField coarse(source);
    EXPECT_EQ(material_at(coarse, {-2.0F, 4.0F, 2.0F}), named("brick")) << voxel_m;
    EXPECT_EQ(material_at(coarse, {2.0F, 4.0F, 2.0F}), named("glass")) << voxel_m;
  }
}

TEST_F(ImportMaterials, and_codes_are_the_same_after_an_export_as_vdb) {
  import(two_blocks("Red_Tiles", "glass"));
  const auto box = whole_of(*field_);
  ASSERT_TRUE(box);
  VoxelMaterials mixed;
  for (size_t i = 0; i < mixed.size(); ++i) mixed[i] = static_cast<VoxelMaterial>(i % 7);
  field_->set_materials(brick_of(VoxelCoord{-3, 15, 3}), BrickMaterials(mixed));
  ASSERT_TRUE(export_vdb(*field_, *file_->palette(), *box, folder_ / "two.vdb", no_bar));
  const auto before = std::move(field_);
  const auto palette = file_->palette();
  const auto read = read_solids({folder_ / "two.vdb"}, {});
  ASSERT_TRUE(read) << read.error().message;
  ASSERT_TRUE(read->exact.has_value());
  make(*read);
  EXPECT_EQ(*file_->palette(), *palette);
  for_each_chunk(box->voxels(), [&](ChunkCoord chunk) {
    for (int i = 0; i < 64; ++i) {
      const BrickCoord brick = brick_in_chunk(chunk, i);
      ASSERT_EQ(field_->brick(brick), before->brick(brick));
      ASSERT_EQ(materials_of(*field_, brick), materials_of(*before, brick));
      ASSERT_EQ(said_materials(*field_, brick), said_materials(*before, brick));
    }
  });
}

TEST_F(ImportMaterials, of_a_vdb_go_by_name_to_rows_of_another_palette) {
  import(two_blocks("Red_Tiles", "glass"));
  ASSERT_TRUE(export_vdb(*field_, *file_->palette(), *whole_of(*field_), folder_ / "two.vdb", no_bar));
  auto other = std::make_shared<Palette>(builtin_palette());
  std::swap(other->rows[*other->named("glass") == named("glass") ? row_number(named("glass")) : 0],
            other->rows[row_number(named("snow"))]);
  const auto read = read_solids({folder_ / "two.vdb"}, {.palette = other});
  ASSERT_TRUE(read) << read.error().message;
  make(*read);
  EXPECT_EQ(at({2.0F, 4.0F, 0.25F}), "glass");
  EXPECT_EQ(at({-2.0F, 4.0F, 0.25F}), "red_tiles");
  const auto mapped = read_solids({folder_ / "two.vdb"}, {.material_map = {{"red_tiles", named("clay")}}});
  ASSERT_TRUE(mapped) << mapped.error().message;
  make(*mapped);
  EXPECT_EQ(at({-2.0F, 4.0F, 0.25F}), "clay");
}

TEST_F(ImportMaterials, come_back_from_a_mesh_that_was_exported) {
  import(two_blocks("brick", "glass"));
  const ChunkBox box = chunks_of({-7.9F, 0.1F, -7.9F}, {7.9F, 7.9F, 7.9F}, 0.25F);
  for (const char* name : {"out.glb", "out.obj"}) {
    ASSERT_TRUE(export_mesh(*field_, *file_->palette(), box, folder_ / name, no_bar));
    const auto read = read_solids({folder_ / name}, {});
    ASSERT_TRUE(read) << read.error().message;
    std::string said;
    for (const std::string& line : read->said) said += line + "\n";
    EXPECT_TRUE(scree::holds(said, ", closed")) << said;
    EXPECT_TRUE(scree::holds(said, "of the palette: brick, glass")) << said;
  }
}

TEST_F(ImportMaterials, of_their_own_colours_come_back_as_equal_rows) {
  import(two_blocks("Red_Tiles", "Moss"));
  const auto own = file_->palette();
  const ChunkBox box = chunks_of({-7.9F, 0.1F, -7.9F}, {7.9F, 7.9F, 7.9F}, 0.25F);
  for (const char* name : {"out.glb", "out.obj"}) {
    ASSERT_TRUE(export_mesh(*field_, *own, box, folder_ / name, no_bar));
    const auto read = read_solids({folder_ / name}, {});
    ASSERT_TRUE(read) << read.error().message;
    for (const char* row : {"red_tiles", "moss"}) {
      const auto back = read->palette->named(row);
      ASSERT_TRUE(back) << name << " " << row;
      EXPECT_EQ(read->palette->row(*back), own->row(*own->named(row))) << name << " " << row;
    }
  }
}

TEST_F(ImportMaterials, of_the_ground_below_keep_their_rows) {
  import(two_blocks("Red_Tiles", "glass"));
  const auto below = file_;
  std::vector<std::unique_ptr<Solid>> solids;
  solids.push_back(std::make_unique<BoxSolid>(VoxelBox{{40, 0, 40}, {60, 20, 60}}, named("steel")));
  const auto made = import_bricks(solids, folder_ / "on.ground", {.on = below}, no_bar);
  ASSERT_TRUE(made) << made.error().message;
  const auto on = GroundFile::open(folder_ / "on.ground");
  ASSERT_TRUE(on) << on.error().message;
  MapField field(GroundFile::source_of(*on));
  EXPECT_EQ((*on)->palette()->name(material_at(field, {-2.0F, 4.0F, 0.25F})), "red_tiles");
  EXPECT_EQ((*on)->palette()->name(material_at(field, {12.0F, 3.0F, 12.0F})), "steel");
  const auto refused = import_bricks(solids, folder_ / "no.ground",
                                     {.on = below, .palette = shared_builtin_palette()}, no_bar);
  ASSERT_FALSE(refused) << "the built-in palette lacks a row of the ground below";
}

TEST_F(ImportMaterials, maps_are_read_and_their_faults_named) {
  const auto read = [&](const std::string& text) {
    std::ofstream(folder_ / "map") << text;
    return read_map_lines(folder_ / "map", builtin_palette());
  };
  const auto lines = read("# comment\n\n11 = snow\n\"My Oak\" = 'timber'\r\na = b = ice\n");
  ASSERT_TRUE(lines) << lines.error().message;
  const MaterialMap map = map_of(*lines);
  EXPECT_EQ(map.size(), 3U);
  EXPECT_EQ(map.at("My Oak"), named("timber"));
  EXPECT_EQ(map.at("a = b"), named("ice"));
  EXPECT_TRUE(scree::holds(read("11 snow\n").error().message, "map:1: a line is"));
  EXPECT_TRUE(scree::holds(read("1 = ice\n2 = cheese\n").error().message, "map:2: 'cheese' is no material"));
  EXPECT_TRUE(scree::holds(read("1 = ice\n1 = rock\n").error().message, "map:2: the same"));
  EXPECT_TRUE(scree::holds(read("1 = ice\n = brick\n").error().message, "map:2: there is no name before"));
  EXPECT_FALSE(read_map_lines(folder_ / "none", builtin_palette()));
}

TEST_F(ImportMaterials, lines_of_a_map_that_name_nothing_are_told) {
  std::ofstream(folder_ / "two.obj") << two_blocks("Red_Tiles", "Moss");
  std::ofstream(folder_ / "map") << "Moss = ice\nOak plank = timber\n";
  const auto lines = read_map_lines(folder_ / "map", builtin_palette());
  ASSERT_TRUE(lines) << lines.error().message;
  const auto read = read_solids({folder_ / "two.obj"}, {.material_map = map_of(*lines)});
  ASSERT_TRUE(read) << read.error().message;
  EXPECT_EQ(read->map_used, std::set<std::string>{"Moss"});
  EXPECT_EQ(words_on_unused("map", *lines, read->map_used),
            std::vector<std::string>{"map:2: 'Oak plank' names no material of the imported rock"});
}

TEST_F(ImportMaterials, without_their_file_or_of_another_case_are_told) {
  std::filesystem::remove(folder_ / "two.mtl");
  import(two_blocks("BRICK", "glass"));
  EXPECT_TRUE(scree::holds(said_, "it names 'two.mtl', which is not there")) << said_;
  EXPECT_TRUE(scree::holds(said_, "'BRICK' (did you mean brick?) as brick_2")) << said_;
}

TEST_F(ImportMaterials, rows_of_files_have_names_that_may_be_and_no_two_the_same) {
  ImportPalette palette(shared_builtin_palette());
  const auto added = [&](const std::string& name) {
    const auto row = palette.add(row_of_colour(name, {0.1F, 0.2F, 0.3F}));
    return row ? palette.palette().row(*row).name : row.error().message;
  };
  EXPECT_EQ(added("Übel & Söhne #3"), "bel_s_hne_3");
  EXPECT_EQ(added("Rock"), "rock_2");
  EXPECT_EQ(added("rock"), "rock_3");
  EXPECT_EQ(added(""), "m");
  EXPECT_EQ(added(std::string(100, 'x')), std::string(32, 'x'));
  EXPECT_EQ(added(std::string(100, 'x')), std::string(30, 'x') + "_2");
  EXPECT_TRUE(validate(*palette.result()));
  for (int i = 0; palette.palette().rows.size() < materials_max; ++i) added("more");
  EXPECT_TRUE(scree::holds(added("one more"), "more than 255"));
}

TEST_F(ImportMaterials, many_colours_become_few_rows_the_same_each_time) {
  std::vector<FileColour> colours;
  for (int i = 0; i < 100; ++i)
    colours.push_back({"c" + std::to_string(i),
                       {static_cast<float>(i % 10) / 10.0F, static_cast<float>(i / 10) / 10.0F, 0.0F},
                       static_cast<uint64_t>(i)});
  ImportPalette one(shared_builtin_palette()), other(shared_builtin_palette());
  const auto rows = rows_of_colours(colours, 8, one);
  ASSERT_TRUE(rows) << rows.error().message;
  EXPECT_EQ(one.added(), 8U);
  EXPECT_EQ((*rows)[0], ground_own) << "nothing is of it";
  EXPECT_EQ(*rows_of_colours(colours, 8, other), *rows);
  EXPECT_EQ(one.palette(), other.palette());
  for (int byte = 0; byte < 256; ++byte)
    EXPECT_EQ(srgb_of_linear(linear_of_srgb(static_cast<uint8_t>(byte))), byte);
}

}  // namespace
}  // namespace scree
