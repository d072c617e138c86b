// Imports of elevation models: the demo ground's volume, resampling, holes, and what is refused in words.
#include "tools/import/heights_import.h"

#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

#include "ground/ground_file.h"
#include "shared/field/terrain.h"
#include "tests/support/test_folder.h"
#include "tests/support/text_raster.h"
#include "tools/import/gdal/gdal_raster.h"

namespace scree {
namespace {

void no_progress(double) {}

std::shared_ptr<const GroundFile> import_and_open(Raster& raster, const std::string& path,
                                                  const HeightsImport& how = {}) {
  const auto imported = import_heights(raster, path, how, no_progress);
  EXPECT_TRUE(imported) << imported.error().message;
  const auto file = GroundFile::open(path);
  EXPECT_TRUE(file) << file.error().message;
  return *file;
}

std::string refusal_of_import(Raster&& raster, const HeightsImport& how = {}) {
  const TestFolder folder;
  const auto imported = import_heights(raster, folder / "a.ground", how, no_progress);
  EXPECT_TRUE(std::filesystem::is_empty(folder / "")) << "nothing is left behind";
  return imported ? std::string() : imported.error().message;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

const std::string maunga_whau = SCREE_SOURCE_DIR "/data/maunga_whau.asc";

TEST(HeightsImport, rock_of_the_demo_ground_has_the_volume_of_the_model) {
  const TestFolder folder;
  const auto raster = open_raster(maunga_whau);
  ASSERT_TRUE(raster) << raster.error().message;
  const auto model = import_and_open(**raster, folder / "m.ground");
  FunctionRaster grid = read_grid(maunga_whau);
  ASSERT_EQ(grid.shape().columns, 87);
  std::vector<double> row(87);
  // The integral by trapezoids over the rectangle between the outermost samples but five.
  double integral_m3 = 0.0;
  for (int z = 5; z <= 55; ++z) {
    ASSERT_TRUE(grid.read_row(z, row));
    for (int x = 5; x <= 81; ++x)
      integral_m3 += (row[static_cast<size_t>(x)] - 94.0) * 100.0 * (x == 5 || x == 81 ? 0.5 : 1.0) *
                     (z == 5 || z == 55 ? 0.5 : 1.0);
  }
  // Columns of voxels of 2 m, by their codes: each is as high as its crossing says.
  const TerrainSource ground{TerrainKind::flat, 1, 2.0F, model};
  MapField field(ground);
  double volume_m3 = 0.0;
  for (int z = -125; z < 125; ++z)
    for (int x = -190; x < 190; ++x) {
      int y = static_cast<int>(ground_height_m(ground, x * 2.0F, z * 2.0F) / 2.0F) - 3;
      const auto code = [&](int at) {
        const VoxelCoord v{x, at, z};
        return static_cast<double>(
            field.brick(brick_of(v)).codes[static_cast<size_t>(Brick::index(v.x & 7, v.y & 7, v.z & 7))]);
      };
      while (code(y + 1) < 0.0) ++y;
      volume_m3 += 4.0 * 2.0 * (y + code(y) / (code(y) - code(y + 1)));
    }
  EXPECT_NEAR(volume_m3 / integral_m3, 1.0, 0.005);
}

TEST(HeightsImport, finer_samples_lie_on_the_surface_of_the_coarse_ones) {
  const TestFolder folder;
  FunctionRaster grid = read_grid(maunga_whau);
  const auto coarse = import_and_open(grid, folder / "c.ground");
  const auto fine = import_and_open(grid, folder / "f.ground", {.sample_m = 1.0});
  EXPECT_EQ(fine->layout().columns, 861);
  EXPECT_EQ(fine->layout().rows, 601);
  double worst_m = 0.0;
  for (double z_m = -290.0; z_m < 290.0; z_m += 3.7)
    for (double x_m = -420.0; x_m < 420.0; x_m += 3.7)
      worst_m = std::max(worst_m, std::abs(height_at(*fine, x_m, z_m) - height_at(*coarse, x_m, z_m)));
  EXPECT_LT(worst_m, 0.05);
}

TEST(HeightsImport, coarser_samples_are_means_of_all_cells_around) {
  const TestFolder folder;
  // Stripes as far apart as the samples: each sample alone would meet the same side of all of them.
  FunctionRaster stripes(161, 161, 1.0, [](int x, int) { return x % 4 < 2 ? 0.0 : 20.0; });
  const auto ground = import_and_open(stripes, folder / "a.ground", {.sample_m = 4.0});
  ASSERT_EQ(ground->layout().columns, 41);
  for (double x_m = -60.0; x_m <= 60.0; x_m += 4.0)
    EXPECT_NEAR(height_at(*ground, x_m, 0.0), 10.0, 0.1) << x_m;
}

TEST(HeightsImport, cells_without_data_are_filled_and_counted) {
  const TestFolder folder;
  FunctionRaster holes(20, 20, 5.0, [](int x, int z) { return x == 3 && z > 4 ? NAN : 100.0 + x; });
  const auto imported = import_heights(holes, folder / "a.ground", {}, no_progress);
  ASSERT_TRUE(imported);
  EXPECT_EQ(imported->nodata, 15U);
  EXPECT_EQ(imported->header.ground.layout.lowest, 0) << "the lowest height is y = 0";
  const auto filled = import_and_open(holes, folder / "b.ground", {.zero_m = 0.0, .fill_m = 50.0});
  EXPECT_EQ(filled->layout().lowest, 50 * height_steps_per_m);
}

TEST(HeightsImport, cells_that_are_no_squares_keep_the_size_of_a_small_raster) {
  const TestFolder folder;
  FunctionRaster narrow(13, 12, 50.6, [](int x, int) { return 1.0 * x; });
  narrow.deepen(49.4);
  const auto ground = import_and_open(narrow, folder / "a.ground");
  const HeightLayout& layout = ground->layout();
  EXPECT_NEAR(static_cast<double>(layout.cell_m) * (layout.columns - 1), 12 * 50.6, 0.005 * 12 * 50.6);
  EXPECT_NEAR(static_cast<double>(layout.cell_m) * (layout.rows - 1), 11 * 49.4, 0.005 * 11 * 49.4);
  FunctionRaster level(13, 12, 50.6, [](int, int) { return 7.0; });
  level.deepen(49.4);
  const auto slab = import_heights(level, folder / "c.ground", {.zero_m = 0.0}, no_progress);
  ASSERT_TRUE(slab);
  EXPECT_NEAR(slab->volume_m3 / (7.0 * 13 * 50.6 * 12 * 49.4), 1.0, 0.006)
      << "the halves of the outer cells too";
  const auto scaled = import_heights(narrow, folder / "b.ground", {.cell_m = 4.94}, no_progress);
  ASSERT_TRUE(scaled);
  const HeightLayout& small = scaled->header.ground.layout;
  EXPECT_NEAR(static_cast<double>(small.cell_m) * (small.columns - 1), 12 * 5.06, 0.005 * 12 * 5.06)
      << "--cell is the distance of rows, and columns keep their proportion";
  EXPECT_NE(scaled->said.front().find("0.1 times as large, with cells of 5.06 × 4.94 m"), std::string::npos)
      << scaled->said.front();
}

/// 10 m a cell to the east, and 20 m to the south.
double slope_m(double x_m, double z_m) {
  return 100.0 + 0.5 * x_m + 0.25 * z_m;
}

TEST(HeightsImport, the_ground_has_the_scale_of_the_raster_whatever_the_samples) {
  struct Case {
    int columns, rows;
    double cell_x_m, cell_z_m, sample_m;
    int ground_columns, ground_rows;
  };
  const TestFolder folder;
  for (const Case& one : {Case{10, 10, 5.0, 5.0, 30.0, 3, 3}, Case{21, 31, 1.0, 1.0, 7.0, 4, 6},
                          Case{41, 61, 1.0, 1.0, 7.0, 7, 10}, Case{41, 81, 4.0, 4.0, 5.0, 33, 65},
                          Case{51, 51, 10.0, 10.7, 10.0, 51, 55}}) {
    const double cell_x_m = one.cell_x_m, cell_z_m = one.cell_z_m;
    const double middle_x_m = 0.5 * (one.columns - 1) * cell_x_m,
                 middle_z_m = 0.5 * (one.rows - 1) * cell_z_m;
    FunctionRaster slope(one.columns, one.rows, cell_x_m, [&](int x, int z) {
      return slope_m(x * cell_x_m - middle_x_m, z * cell_z_m - middle_z_m);
    });
    slope.deepen(cell_z_m);
    const auto ground =
        import_and_open(slope, folder / "a.ground", {.sample_m = one.sample_m, .zero_m = 0.0});
    EXPECT_EQ(ground->layout().columns, one.ground_columns);
    EXPECT_EQ(ground->layout().rows, one.ground_rows);
    if (one.columns < 40) continue;  // the spline meets the edge everywhere
    for (const double part : {-0.3, 0.0, 0.25}) {
      const double x_m = part * middle_x_m, z_m = part * middle_z_m;
      EXPECT_NEAR(height_at(*ground, x_m, z_m), slope_m(x_m, z_m), 0.15) << one.sample_m << " at " << part;
    }
  }
}

TEST(HeightsImport, samples_beyond_the_model_and_a_stretch_are_said) {
  const TestFolder folder;
  const auto said = [&](FunctionRaster&& raster, const HeightsImport& how) {
    const auto imported = import_heights(raster, folder / "a.ground", how, no_progress);
    EXPECT_TRUE(imported) << imported.error().message;
    std::string words;
    for (const std::string& line : imported->said) words += line + "\n";
    return words;
  };
  const auto level = [](int, int) { return 7.0; };
  const std::string far = said(FunctionRaster(10, 10, 5.0, level), {.sample_m = 30.0});
  EXPECT_TRUE(has(far,
                  "it is 45 m deep, and the ground 60 m, in samples 30 m apart: the heights at its edges "
                  "continue for 7.5 m"))
      << far;
  FunctionRaster tiny(2, 2, 47.34, level);
  tiny.deepen(50.0);
  const std::string two = said(std::move(tiny), {});
  EXPECT_TRUE(has(two, "it is 50 m deep, and the ground 53.2575 m")) << two;
  FunctionRaster near(101, 101, 10.0, level);
  near.deepen(10.03);
  const std::string stretched = said(std::move(near), {});
  EXPECT_TRUE(has(stretched, "the ground is 0.3 % shorter there")) << stretched;
  EXPECT_EQ(said(FunctionRaster(101, 101, 10.0, level), {.sample_m = 5.0}), "");
}

TEST(HeightsImport, models_that_cannot_be_a_ground_are_refused_with_the_way_out) {
  const auto level = [](int, int) { return 1.0; };
  EXPECT_TRUE(has(refusal_of_import(FunctionRaster(1, 1, 1.0, level)), "at least 2 × 2"));
  EXPECT_TRUE(has(refusal_of_import(FunctionRaster(8, 8, std::nullopt, level)), "--cell"));
  EXPECT_TRUE(has(refusal_of_import(FunctionRaster(4096, 8, 30.0, level)), "limits.world_half_width_m"));
  EXPECT_TRUE(has(refusal_of_import(FunctionRaster(1 << 18, 8, 0.1, level)), "limits.raster_side_max"));
  EXPECT_TRUE(has(refusal_of_import(FunctionRaster(8, 8, 1.0, level), {.sample_m = 1.0e-4}),
                  "limits.height_samples_max"));
  EXPECT_TRUE(
      has(refusal_of_import(FunctionRaster(8, 8, 1.0, [](int, int) { return NAN; })), "no cell has data"));
  EXPECT_TRUE(
      has(refusal_of_import(FunctionRaster(8, 8, 1.0, [](int, int) { return 1.0e9; })), "--vertical-scale"));
  EXPECT_TRUE(has(refusal_of_import(FunctionRaster(8, 8, 1.0, [](int x, int) { return x * 400.0; })),
                  "limits.height_max_m"));
  EXPECT_TRUE(has(refusal_of_import(FunctionRaster(8, 8, 0.1, level)), "--sample chooses their distance"));
  FunctionRaster broken(8, 8, 1.0, level);
  broken.fails_at = 5;
  EXPECT_TRUE(has(refusal_of_import(std::move(broken)), "the disk is gone"));
}

TEST(HeightsImport, files_that_are_no_rasters_are_named) {
  const TestFolder folder;
  const auto refusal = [&](const std::string& text) {
    const std::string path = folder / "a.asc";
    std::ofstream(path) << text;
    auto raster = open_raster(path);
    if (!raster) return raster.error().message;
    const auto imported = import_heights(**raster, folder / "a.ground", {}, no_progress);
    return imported ? std::string() : imported.error().message;
  };
  EXPECT_TRUE(has(refusal(""), "a.asc"));
  EXPECT_TRUE(has(refusal("hello"), "a.asc"));
  EXPECT_FALSE(refusal("ncols 1\nnrows 1\nxllcorner 0\nyllcorner 0\ncellsize 10\n7\n").empty());
  EXPECT_FALSE(refusal("ncols 4\nnrows 4\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2 3 4\n5 6").empty())
      << "cut short";
  EXPECT_TRUE(refusal("ncols 2\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 10\n1 2 3 4\n").empty());
  EXPECT_FALSE(open_raster(folder / "none.tif"));
}

TEST(HeightsImport, a_preview_shades_slopes) {
  const TestFolder folder;
  FunctionRaster ridge(64, 40, 1.0, [](int x, int) { return 20.0 - std::abs(x - 32.0); });
  const auto imported = import_heights(ridge, folder / "a.ground", {}, no_progress);
  ASSERT_TRUE(imported);
  const std::vector<uint8_t> pixels = shaded_relief(*imported);
  ASSERT_EQ(pixels.size(), 64U * 40U);
  EXPECT_GT(pixels[20 * 64 + 10], pixels[20 * 64 + 50]) << "the west side is lit";
  ASSERT_TRUE(write_grey_png(folder / "a.png", 64, 40, pixels));
  EXPECT_GT(std::filesystem::file_size(folder / "a.png"), 100U);
}

}  // namespace
}  // namespace scree
