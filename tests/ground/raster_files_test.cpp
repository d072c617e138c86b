// Rasters of other programs, each of a kind that once came in wrong: the right heights, or a refusal that
// names the kind and the way out.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>

#include "ground/ground_file.h"
#include "tests/support/holds.h"
#include "tests/support/test_folder.h"
#include "tests/support/vrt_raster.h"
#include "tools/import/gdal/raster_reader.h"
#include "tools/import/heights_import.h"

namespace scree {
namespace {

const std::string rasters = SCREE_SOURCE_DIR "/tests/data/rasters/";

/// One hill, 101 × 101 samples 10 m apart: north at 150 m, south at 100 m, and a summit of 180 m.
void expect_hill(const WholeRaster& hill, double cell_m) {
  ASSERT_EQ(hill.refusal, "");
  ASSERT_EQ(hill.shape.columns, 101);
  ASSERT_EQ(hill.shape.rows, 101);
  EXPECT_NEAR(hill.shape.cell_x_m.value_or(0.0), cell_m, 1.0e-9);
  EXPECT_NEAR(hill.shape.cell_z_m.value_or(0.0), cell_m, 1.0e-9);
  double highest_m = 0.0;
  int summit_x = 0, summit_z = 0;
  for (int z = 0; z < 101; ++z)
    for (int x = 0; x < 101; ++x)
      if (hill.at(x, z) > highest_m) {
        highest_m = hill.at(x, z);
        summit_x = x;
        summit_z = z;
      }
  EXPECT_NEAR(highest_m, 180.0, 1.0e-4);
  EXPECT_NEAR(hill.at(0, 0), 150.0, 1.0e-4);
  EXPECT_NEAR(hill.at(100, 100), 100.0, 1.0e-4);
  EXPECT_NEAR(hill.at(0, 60), 120.0, 1.0e-4) << "half a metre a row";
  EXPECT_EQ(summit_x, 20) << "the summit lies in the west";
  EXPECT_EQ(summit_z, 20) << "and in the north";
}

TEST(RasterFiles, a_raster_from_south_to_north_is_turned_over) {
  const WholeRaster hill = read_whole(rasters + "south_up.tif");
  expect_hill(hill, 10.0);
  EXPECT_TRUE(hill.says("its rows begin in the south")) << hill.said;
}

TEST(RasterFiles, a_raster_turned_by_a_quarter_is_turned_back) {
  const WholeRaster hill = read_whole(rasters + "rot90.tif");
  expect_hill(hill, 10.0);
  EXPECT_TRUE(hill.says("turned by a quarter")) << hill.said;
}

TEST(RasterFiles, heights_in_feet_become_metres) {
  const WholeRaster hill = read_whole(rasters + "feet_band.tif");
  expect_hill(hill, 10.0);
  EXPECT_TRUE(hill.says("heights in feet")) << hill.said;
}

TEST(RasterFiles, web_mercator_has_the_length_that_it_has_at_its_latitude) {
  const WholeRaster hill = read_whole(rasters + "webmercator_60N.tif");
  // At 59.995° north: cos φ × N / a along the parallel, cos φ × M / a along the meridian, and their mean.
  const double latitude = 59.99546 * M_PI / 180.0, e2 = 0.00669437999014;
  const double root = std::sqrt(1.0 - e2 * std::sin(latitude) * std::sin(latitude));
  const double mean = std::cos(latitude) * std::sqrt((1.0 / root) * (1.0 - e2) / (root * root * root));
  expect_hill(hill, hill.shape.cell_x_m.value_or(0.0));
  EXPECT_NEAR(hill.shape.cell_x_m.value_or(0.0), 20.0 * mean, 0.001);
  EXPECT_TRUE(hill.says("0.5009 × 0.5009 of the map's length at 60.0° north")) << hill.said;
}

TEST(RasterFiles, cells_that_alpha_hides_have_no_height) {
  const WholeRaster hill = read_whole(rasters + "alpha.tif");
  ASSERT_EQ(hill.refusal, "");
  EXPECT_EQ(std::ranges::count_if(hill.heights_m, [](double m) { return std::isnan(m); }), 400);
  EXPECT_TRUE(std::isnan(hill.at(40, 40)) && std::isnan(hill.at(59, 59)));
  EXPECT_EQ(hill.at(0, 0), 150.0);
  EXPECT_TRUE(hill.says("nodata by alpha")) << hill.said;
}

TEST(RasterFiles, nodata_is_compared_in_the_type_of_the_file) {
  const WholeRaster hill = read_whole(rasters + "e2.bil");
  ASSERT_EQ(hill.refusal, "");
  EXPECT_EQ(std::ranges::count_if(hill.heights_m, [](double m) { return std::isnan(m); }), 400);
  EXPECT_TRUE(hill.says("nodata -9999.9")) << hill.said;
}

TEST(RasterFiles, a_palette_is_refused_by_its_name) {
  const WholeRaster picture = read_whole(rasters + "palette.png");
  EXPECT_TRUE(picture.refuses("palette of colours")) << picture.refusal;
  EXPECT_TRUE(picture.refuses("--band 1")) << picture.refusal;
  const WholeRaster forced = read_whole(rasters + "palette.png", {.band = 1});
  EXPECT_EQ(forced.refusal, "");
  EXPECT_EQ(forced.at(0, 0), 105.0);
}

TEST(RasterFiles, points_that_begin_in_the_south_are_turned_over) {
  const WholeRaster grid = read_whole(rasters + "south_first.xyz");
  ASSERT_EQ(grid.refusal, "");
  EXPECT_EQ(grid.at(0, 4), 5.0) << "the south-west";
  EXPECT_EQ(grid.at(1, 4), 0.0);
  EXPECT_EQ(grid.at(0, 0), 45.0) << "the north-west";
}

TEST(RasterFiles, an_ascii_grid_with_a_word_that_is_no_number_or_too_few_heights_is_refused) {
  const TestFolder folder;
  const std::string path = folder / "grid.asc";
  const auto read = [&](const std::string& heights) {
    std::ofstream(path) << "ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\nNODATA_value -9999\n"
                        << heights;
    return read_whole(path);
  };
  const auto refusal = [&](const std::string& heights) { return read(heights).refusal; };
  EXPECT_TRUE(holds(refusal("1 2 3\n4 abc 6\n"), "'abc' is no height: row 2, column 2"));
  EXPECT_TRUE(holds(refusal("1O0 2 3\n4 5 6\n"), "'1O0' is no height: row 1, column 1"));
  EXPECT_TRUE(holds(refusal("1 2 3\n4 5\n"), "it has 5 heights, and its header says 3 × 2"));
  EXPECT_TRUE(holds(refusal("1 2 3\n4 5 6 7\n"), "it has 7 heights"));
  const WholeRaster whole = read("1.5 +2 3e0\n-4 5. -9999\n");
  ASSERT_EQ(whole.refusal, "");
  EXPECT_EQ(whole.at(0, 0), 1.5);
  EXPECT_EQ(whole.at(0, 1), -4.0);
}

TEST(RasterFiles, a_file_with_several_rasters_lists_them) {
  const WholeRaster all = read_whole(rasters + "two_variables.nc");
  EXPECT_TRUE(all.refuses("it holds 2 rasters; --layer NAME")) << all.refusal;
  EXPECT_TRUE(all.refuses("1 'height1'")) << all.refusal;
  EXPECT_TRUE(all.refuses("2 'uncertainty2'")) << all.refusal;
  for (const char* const layer : {"height1", "1"}) {
    const WholeRaster chosen = read_whole(rasters + "two_variables.nc", {.layer = layer});
    ASSERT_EQ(chosen.refusal, "");
    EXPECT_EQ(chosen.at(0, 0), 100.0);
    EXPECT_EQ(chosen.at(5, 4), 129.0);
  }
  EXPECT_TRUE(read_whole(rasters + "two_variables.nc", {.layer = "depth"}).refuses("no raster 'depth'"));
}

TEST(RasterFiles, an_archive_gives_its_only_raster_or_lists_its_files) {
  const WholeRaster one = read_whole(rasters + "one_grid.zip");
  ASSERT_EQ(one.refusal, "");
  EXPECT_EQ(one.at(5, 4), 129.0);
  EXPECT_TRUE(one.says("'grid/height.asc'")) << one.said;
  const WholeRaster two = read_whole(rasters + "two_grids.zip");
  EXPECT_TRUE(two.refuses("it holds 2 files; --layer NAME")) << two.refusal;
  EXPECT_TRUE(two.refuses("'uncertainty.asc'")) << two.refusal;
  EXPECT_EQ(read_whole(rasters + "two_grids.zip", {.layer = "height.asc"}).at(5, 4), 129.0);
  const WholeRaster none = read_whole(rasters + "no_grid.zip");
  EXPECT_TRUE(none.refuses("an archive without a raster")) << none.refusal;
  EXPECT_TRUE(none.refuses("'house.obj'")) << none.refusal;
}

/// Their library maps files, and within an archive it would do so in a way that the reader's walls refuse.
TEST(RasterFiles, netcdf_in_an_archive_is_unpacked_and_leaves_nothing) {
  const TestFolder folder;
  ASSERT_EQ(::setenv("TMPDIR", (folder / "").c_str(), 1), 0);
  const auto read = [](const std::string& file, const std::string& layer) {
    const auto raster = open_raster_apart(rasters + file, {.layer = layer}, {});
    if (raster) return read_whole(**raster);
    WholeRaster none;
    none.refusal = raster.error().message;
    return none;
  };
  for (const auto& [file, layer] :
       {std::pair("netcdf.zip", "four.nc"), {"four.nc.gz", ""}, {"netcdf.zip", "two_variables.nc:height1"}}) {
    const WholeRaster slope = read(file, layer);
    ASSERT_EQ(slope.refusal, "") << file << " " << layer;
    EXPECT_EQ(slope.at(0, 0), 100.0);
    EXPECT_EQ(slope.at(5, 4), 129.0);
  }
  EXPECT_TRUE(read("netcdf.zip", "four.nc").says("its file 'four.nc' was read"));
  EXPECT_TRUE(read("netcdf.zip", "").refuses("it holds 2 files; --layer NAME"));
  const WholeRaster two = read("netcdf.zip", "two_variables.nc");
  EXPECT_TRUE(two.refuses("it holds 2 rasters; --layer NAME")) << two.refusal;
  EXPECT_TRUE(std::filesystem::is_empty(folder / ""));
  ::unsetenv("TMPDIR");
}

TEST(RasterFiles, a_form_that_is_not_read_is_refused_with_the_way_out) {
  const TestFolder folder;
  std::ofstream(folder / "a.grd") << "[general]\ncreator=R package 'raster'\n";
  const WholeRaster grid = read_whole(folder / "a.grd");
  EXPECT_TRUE(grid.refuses("gdal_translate FILE out.tif")) << grid.refusal;
}

TEST(RasterFiles, a_reader_process_gives_the_same_as_this_one) {
  for (const char* const name : {"rot90.tif", "alpha.tif", "south_first.xyz"}) {
    const WholeRaster here = read_whole(rasters + name);
    const auto apart = open_raster_apart(rasters + name, {}, {});
    ASSERT_TRUE(apart) << apart.error().message;
    const WholeRaster there = read_whole(**apart);
    EXPECT_EQ(there.said, here.said);
    EXPECT_EQ(there.place.value_or(Raster::Place{}).x, here.place.value_or(Raster::Place{}).x);
    const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
    EXPECT_TRUE(std::ranges::equal(there.heights_m, here.heights_m, same)) << name;
  }
  const auto refused = open_raster_apart(rasters + "palette.png", {}, {});
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().message.starts_with(rasters + "palette.png: its one band"))
      << refused.error().message;
}

TEST(RasterFiles, the_same_hill_in_four_forms_is_one_ground) {
  const TestFolder folder;
  const auto name_of_ground = [&](const std::string& file) {
    const auto raster = open_raster(rasters + file);
    EXPECT_TRUE(raster);
    const auto imported = import_heights(**raster, folder / "a.ground", {}, [](double) {});
    return imported ? hex_of(name_of(imported->header)) : imported.error().message;
  };
  const std::string ground = name_of_ground("south_up.tif");
  EXPECT_EQ(ground.size(), 64U) << ground;
  EXPECT_EQ(name_of_ground("rot90.tif"), ground);
  EXPECT_EQ(name_of_ground("south_up.tif"), ground) << "the same world each time";
}

TEST(RasterFiles, a_missing_part_is_named) {
  const TestFolder folder;
  write_vrt(folder, {.columns = 4, .rows = 4, .stored = [](int, int) { return 1.0; }});
  std::filesystem::remove(folder / "cells.asc");
  const WholeRaster broken = read_whole(folder / "raster.vrt");
  EXPECT_TRUE(broken.refuses("cells.asc")) << broken.refusal;
}

TEST(RasterFiles, warnings_of_gdal_are_said) {
  const TestFolder folder;
  std::ifstream file(rasters + "rot90.tif", std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(file)), {});
  const auto at = [&](size_t i) { return static_cast<size_t>(static_cast<unsigned char>(bytes.at(i))); };
  const size_t directory = at(4) | at(5) << 8U | at(6) << 16U | at(7) << 24U;
  // The first two entries, of 12 bytes each, change places: tags have to be in order.
  std::swap_ranges(&bytes.at(directory + 2), &bytes.at(directory + 2) + 12, &bytes.at(directory + 14));
  std::ofstream(folder / "a.tif", std::ios::binary) << bytes;
  const WholeRaster warned = read_whole(folder / "a.tif");
  EXPECT_EQ(warned.refusal, "");
  EXPECT_TRUE(warned.says("GDAL warns: ")) << warned.said;
}

}  // namespace
}  // namespace scree
