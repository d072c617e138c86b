// Land cover: classes of a raster become the material of the ground's uppermost metre, near and far, and a
// cover of another place is refused.
#include <cmath>
#include <fstream>
#include <gtest/gtest.h>

#include "content/builtin_palette.h"
#include "shared/field/material_window.h"
#include "tests/support/test_folder.h"
#include "tools/import/files/cover_files.h"
#include "tools/import/gdal/gdal_raster.h"

namespace scree {
namespace {

class CoverImportTest : public ::testing::Test {
 protected:
  /// `value(column, row)`, rows from the north.
  template <typename F>
  std::string grid(const std::string& name, int side, double cell_m, F&& value) const {
    std::ofstream out(folder_ / name);
    out << "ncols " << side << "\nnrows " << side << "\nxllcorner 0\nyllcorner 0\ncellsize " << cell_m
        << "\nNODATA_value -7\n";
    for (int row = 0; row < side; ++row)
      for (int column = 0; column < side; ++column)
        out << value(column, row) << (column + 1 == side ? "\n" : " ");
    return folder_ / name;
  }
  Result<HeightsImported> import(const std::string& cover, const std::string& classes) {
    std::ofstream(folder_ / "classes") << classes;
    const std::string model = grid(
        "model.asc", 24, 2.0, [](int x, int z) { return std::round(30.0 + 3.0 * std::sin(0.4 * (x + z))); });
    auto raster = open_raster(model);
    if (!raster) return tl::unexpected(raster.error());
    HeightsImport how{.vertical_scale = 1.0, .zero_m = 30.0, .palette = shared_builtin_palette()};
    said_.clear();
    return import_covered_heights(**raster, folder_ / "made.ground", how,
                                  {.raster = cover, .map = folder_ / "classes"}, {}, said_, [](double) {});
  }

  TestFolder folder_;
  std::vector<std::string> said_;
};

TEST_F(CoverImportTest, classes_are_the_uppermost_metre_at_their_places) {
  const std::string cover =
      grid("cover.asc", 12, 4.0, [](int x, int z) { return z < 6 ? (x < 6 ? 11 : 12) : (x < 6 ? 99 : -7); });
  const auto made = import(cover, "11 = snow\n12 = sand\n");
  ASSERT_TRUE(made) << made.error().message;
  EXPECT_EQ(said_.size(), 2U) << "cells without a class, and what was stored";
  const auto file = GroundFile::open(folder_ / "made.ground");
  ASSERT_TRUE(file) << file.error().message;
  EXPECT_EQ(made->header.ground, (*file)->header().ground);
  for (const float voxel_m : {0.25F, 0.5F, 2.0F}) {
    TerrainSource source = GroundFile::source_of(*file);
    source.voxel_size_m = voxel_m;
    MapField field(source);
    const auto at = [&](float x_m, float z_m, float below_m) {
      const auto y_m =
          static_cast<float>(height_at(**file, static_cast<double>(x_m), static_cast<double>(z_m)));
      return builtin_palette().name(material_at(field, {x_m, y_m - below_m, z_m}));
    };
    const float skin_m = 0.5F * voxel_m;
    EXPECT_EQ(at(-10.0F, -10.0F, skin_m), "snow") << voxel_m << ": north is −z";
    EXPECT_EQ(at(10.0F, -10.0F, skin_m), "sand") << voxel_m;
    EXPECT_EQ(at(-10.0F, 10.0F, skin_m), "soil") << "a class without a material: the layers stay";
    if (voxel_m < 1.0F) {
      EXPECT_EQ(at(-10.0F, -10.0F, 1.6F), "rock");
    }
  }
}

TEST_F(CoverImportTest, of_another_place_or_without_classes_is_refused_in_words) {
  const auto refusal = [&](const std::string& cover, const std::string& classes) {
    const auto made = import(cover, classes);
    return made ? std::string() : made.error().message;
  };
  const auto one = [](int, int) { return 1; };
  EXPECT_NE(refusal(grid("small.asc", 12, 2.0, one), "1 = snow\n").find("the same place"), std::string::npos);
  EXPECT_NE(refusal(grid("other.asc", 12, 4.0, one), "2 = snow\n").find("no cell of the cover"),
            std::string::npos);
  EXPECT_NE(refusal(grid("half.asc", 12, 4.0, [](int x, int) { return 0.5 * x; }), "1 = snow\n")
                .find("whole numbers"),
            std::string::npos);
  EXPECT_NE(refusal(grid("bad.asc", 12, 4.0, one), "1 = cheese\n").find("cheese"), std::string::npos);
  for (const char* name : {"forest", "99999999999999999999", "1.5"})
    EXPECT_NE(refusal(grid("one.asc", 12, 4.0, one), "1 = snow\n" + std::string(name) + " = snow\n")
                  .find("classes:2: '" + std::string(name) + "' is no class of a raster"),
              std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "made.ground"));
}

/// A raster of one row, as no file of the test holds such numbers.
class OneRow final : public Raster {
 public:
  explicit OneRow(std::vector<double> cells) : cells_(std::move(cells)) {}
  Shape shape() const override { return {static_cast<int>(cells_.size()), 1, 1.0, 1.0}; }
  Result<void> read_row(int, std::span<double> to) override {
    std::ranges::copy(cells_, to.begin());
    return {};
  }

 private:
  std::vector<double> cells_;
};

TEST_F(CoverImportTest, classes_beyond_whole_numbers_are_refused) {
  const MaterialMap classes{{"-9223372036854775808", material::ice}, {"9007199254740991", material::ice}};
  for (const double value : {1e300, -1e300, 9223372036854775808.0, 9007199254740993.0}) {
    OneRow raster({0.0, value});
    const auto refused = read_cover(raster, classes);
    ASSERT_FALSE(refused) << value;
    EXPECT_NE(refused.error().message.find("classes are whole numbers"), std::string::npos)
        << refused.error().message;
  }
  OneRow raster({9007199254740991.0, -9007199254740991.0});
  const auto cover = read_cover(raster, classes);
  ASSERT_TRUE(cover) << cover.error().message;
  EXPECT_EQ(cover->without, 1U);
}

}  // namespace
}  // namespace scree
