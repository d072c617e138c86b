// The numbers of a raster as heights: units, scales, types, nodata that is declared and nodata that is not,
// and bands that hold no heights.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "tests/support/vrt_raster.h"

namespace scree {
namespace {

const std::string place_10_m = "<GeoTransform>1000,10,0,2000,0,-10</GeoTransform>";

/// 12 × 10 cells of 100 to 209, but `odd` in four of them.
WholeRaster read_band(const std::string& band, const std::string& type = "Float32",
                      const RasterChoice& choice = {}, std::optional<double> odd = {},
                      const std::string& head = place_10_m, const std::string& more = {}) {
  const TestFolder folder;
  const auto stored = [&](int column, int row) {
    return odd && column < 2 && row < 2 ? *odd : 100.0 + column + 10.0 * row;
  };
  return read_whole(write_vrt(folder, {12, 10, stored, head, band, type, more}), choice);
}

/// The height of the cell with the number 150.
double height_by(const std::string& band, const RasterChoice& choice = {},
                 const std::string& head = place_10_m) {
  const WholeRaster whole = read_band(band, "Float32", choice, {}, head);
  EXPECT_EQ(whole.refusal, "") << band;
  return whole.refusal.empty() ? whole.at(0, 5) : 0.0;
}

int holes(const WholeRaster& whole) {
  EXPECT_EQ(whole.refusal, "");
  return static_cast<int>(std::ranges::count_if(whole.heights_m, [](double m) { return std::isnan(m); }));
}

TEST(RasterValues, units_are_those_of_the_band_or_of_the_map) {
  EXPECT_NEAR(height_by(""), 150.0, 1.0e-9);
  EXPECT_NEAR(height_by("<UnitType>m</UnitType>"), 150.0, 1.0e-9);
  EXPECT_NEAR(height_by("<UnitType>unknown</UnitType>"), 150.0, 1.0e-9);
  EXPECT_NEAR(height_by("<UnitType>Feet</UnitType>"), 45.72, 1.0e-9);
  EXPECT_NEAR(height_by("<UnitType>US survey foot</UnitType>"), 150.0 * 1200.0 / 3937.0, 1.0e-9);
  EXPECT_NEAR(height_by("<UnitType>[gpm]</UnitType>"), 150.0, 1.0e-9);
  EXPECT_NEAR(height_by("<UnitType>cm</UnitType>"), 1.5, 1.0e-9);
  EXPECT_NEAR(height_by("<UnitType>metres above sea level</UnitType>"), 150.0, 1.0e-9);
  EXPECT_NEAR(height_by("<UnitType>m</UnitType>", {.vertical_unit = "ft"}), 45.72, 1.0e-9);
  const std::string place = "<GeoTransform>500000,10,0,5000000,0,-10</GeoTransform>";
  EXPECT_NEAR(height_by("", {}, "<SRS>EPSG:32618+6360</SRS>" + place), 150.0 * 1200.0 / 3937.0, 1.0e-9)
      << "NAVD88 in US survey feet";
  EXPECT_NEAR(height_by("", {}, "<SRS>EPSG:32618+5703</SRS>" + place), 150.0, 1.0e-9);
  EXPECT_NEAR(height_by("", {}, "<SRS>EPSG:32618+5715</SRS>" + place), -150.0, 1.0e-9) << "a depth";
  EXPECT_NEAR(height_by("<Metadata><MDI key=\"positive\">down</MDI></Metadata>"), -150.0, 1.0e-9);
}

TEST(RasterValues, a_unit_that_is_no_length_is_refused) {
  const WholeRaster kelvin = read_band("<UnitType>K</UnitType>");
  EXPECT_TRUE(kelvin.refuses("'K', which is no length")) << kelvin.refusal;
  EXPECT_TRUE(kelvin.refuses("--vertical-unit")) << kelvin.refusal;
  EXPECT_TRUE(read_band("<UnitType>m/s</UnitType>").refuses("'m/s'"));
  EXPECT_EQ(read_band("<UnitType>K</UnitType>", "Float32", {.vertical_unit = "m"}).refusal, "");
  EXPECT_TRUE(read_band("", "Float32", {.vertical_unit = "furlong"}).refuses("'furlong'"));
}

TEST(RasterValues, a_map_in_feet_without_a_vertical_unit_is_said) {
  const WholeRaster whole = read_band(
      "", "Float32", {}, {}, "<SRS>EPSG:2263</SRS><GeoTransform>990000,10,0,200000,0,-10</GeoTransform>");
  EXPECT_EQ(whole.at(0, 5), 150.0);
  EXPECT_TRUE(whole.says("assumed: the file says no vertical unit, but its map is in US survey feet"))
      << whole.said;
}

TEST(RasterValues, scale_and_offset_are_applied_and_said) {
  const WholeRaster whole = read_band("<Offset>7</Offset><Scale>0.5</Scale><NoDataValue>150</NoDataValue>");
  EXPECT_EQ(holes(whole), 2) << "nodata is a stored number";
  EXPECT_EQ(whole.at(0, 4), 77.0);
  EXPECT_TRUE(whole.says("its values × 0.5 + 7")) << whole.said;
  EXPECT_TRUE(read_band("<Offset>7</Offset><Scale>0</Scale>").refuses("values × 0 + 7"));
}

TEST(RasterValues, declared_nodata_is_found_in_each_type) {
  EXPECT_EQ(holes(read_band("<NoDataValue>-9999.9</NoDataValue>", "Float32", {}, -9999.9)), 4);
  EXPECT_EQ(
      holes(read_band("<NoDataValue>-3.40282e+38</NoDataValue>", "Float32", {}, -3.4028234663852886e38)), 4);
  EXPECT_EQ(holes(read_band("<NoDataValue>-32768</NoDataValue>", "Int16", {}, -32768.0)), 4);
  EXPECT_EQ(holes(read_band("<NoDataValue>65535</NoDataValue>", "UInt16", {}, 65535.0)), 4);
  EXPECT_EQ(holes(read_band("<NoDataValue>-9999.900390625</NoDataValue>", "Float64", {}, -9999.9)), 4);
  const WholeRaster signed_bytes = read_band(
      "<NoDataValue>-128</NoDataValue><Metadata domain=\"IMAGE_STRUCTURE\"><MDI "
      "key=\"PIXELTYPE\">SIGNEDBYTE</MDI></Metadata>",
      "Byte", {}, 128.0);
  EXPECT_EQ(holes(signed_bytes), 5) << "another cell holds 128 by itself";
  EXPECT_EQ(signed_bytes.at(0, 9), 190.0 - 256.0) << "a byte with a sign";
}

TEST(RasterValues, nodata_that_the_type_cannot_hold_is_said) {
  const WholeRaster whole = read_band("<NoDataValue>-9999</NoDataValue>", "UInt16");
  EXPECT_EQ(holes(whole), 0);
  EXPECT_TRUE(whole.says("no cell can hold the nodata -9999")) << whole.said;
  EXPECT_TRUE(read_band("<NoDataValue>-9999</NoDataValue>", "UInt16", {}, 55537.0).refuses("--nodata 55537"));
  const WholeRaster chosen = read_band("", "UInt16", {.nodata = {-9999.0}});
  EXPECT_TRUE(chosen.says("no cell can hold the nodata -9999")) << chosen.said;
}

TEST(RasterValues, undeclared_nodata_is_refused_until_the_command_line_decides) {
  struct Case {
    double odd;
    const char* type;
    const char* named;
  };
  for (const auto& [odd, type, named] :
       {Case{-9999.0, "Float32", "--nodata -9999 "}, Case{-32768.0, "Int16", "--nodata -32768 "},
        Case{-3.4028234663852886e38, "Float32", "--nodata -3.4028235e+38 "},
        Case{65535.0, "UInt16", "--nodata 65535 "}, Case{1.0e20, "Float64", "--nodata 1e+20 "},
        Case{-99999.0, "Int32", "--nodata -99999 "}}) {
    const WholeRaster asked = read_band("", type, {}, odd);
    EXPECT_TRUE(asked.refuses("4 cells hold ")) << asked.refusal << asked.said;
    EXPECT_TRUE(asked.refuses(named)) << asked.refusal;
    EXPECT_TRUE(asked.refuses("does not declare")) << asked.refusal;
    const WholeRaster told = read_band("", type, {.nodata = {odd}}, odd);
    EXPECT_EQ(holes(told), 4) << odd;
    EXPECT_EQ(holes(read_band("", type, {.no_nodata = true}, odd)), 0);
  }
  const WholeRaster sea = read_band("", "Float32", {}, 30.0);
  EXPECT_EQ(holes(sea), 0);
  EXPECT_FALSE(sea.says("4 cells hold 30")) << "no farther from the others than they are";
  const WholeRaster hole = read_band("", "Float32", {}, -300.0);
  EXPECT_EQ(holes(hole), 0);
  EXPECT_TRUE(hole.says("4 cells hold -300, 402 m from the next height; it was taken as a height"))
      << hole.said;
}

TEST(RasterValues, values_that_are_all_too_high_are_no_nodata) {
  const TestFolder folder;
  const std::string path = write_vrt(folder, {.columns = 10, .rows = 10, .stored = [](int x, int z) {
                                                return 1.0e8 + 1.0e5 * (10 * z + x);
                                              }});
  const WholeRaster high = read_whole(path);
  EXPECT_EQ(high.refusal, "") << "the import says how high they are";
}

TEST(RasterValues, the_command_line_may_say_that_declared_nodata_are_heights) {
  EXPECT_EQ(holes(read_band("<NoDataValue>150</NoDataValue>", "Float32", {.no_nodata = true})), 0);
  EXPECT_EQ(holes(read_band("<NoDataValue>150</NoDataValue>", "Float32", {.nodata = {151.0}})), 4)
      << "both, each in two cells";
}

TEST(RasterValues, a_mask_says_which_cells_have_heights) {
  const std::string mask =
      "<MaskBand><VRTRasterBand dataType=\"Byte\"><SimpleSource><SourceFilename "
      "relativeToVRT=\"1\">cells.asc</SourceFilename><SourceBand>1</SourceBand></SimpleSource></"
      "VRTRasterBand>"
      "</MaskBand>";
  const WholeRaster whole = read_band("", "Float32", {}, 0.0, place_10_m, mask);
  EXPECT_EQ(holes(whole), 4);
  EXPECT_TRUE(whole.says("nodata by a mask")) << whole.said;
}

TEST(RasterValues, bands_that_are_no_heights_are_refused_by_name) {
  EXPECT_TRUE(read_band("<ColorInterp>Red</ColorInterp>", "Byte").refuses("the colour 'Red' of a picture"));
  EXPECT_TRUE(
      read_band("<CategoryNames><Category>water</Category><Category>wood</Category></CategoryNames>", "Byte")
          .refuses("2 classes such as 'water'"));
  EXPECT_TRUE(read_band("", "CFloat32").refuses("complex"));
  EXPECT_TRUE(read_band("", "CFloat32", {.band = 1}).refuses("complex"));
  EXPECT_EQ(read_band("<ColorInterp>Red</ColorInterp>", "Byte", {.band = 1}).at(0, 5), 150.0);
  const auto further = [](int number, const char* type) {
    return "<VRTRasterBand dataType=\"" + std::string(type) + "\" band=\"" + std::to_string(number) +
           "\"><Description>more</Description></VRTRasterBand>";
  };
  const std::string bytes = further(2, "Byte") + further(3, "Byte");
  EXPECT_TRUE(read_band("", "Byte", {}, {}, place_10_m, bytes).refuses("the first of 3 bands of 8 bits"));
  const WholeRaster two = read_band("", "Float32", {}, {}, place_10_m, further(2, "Float32"));
  EXPECT_EQ(two.at(0, 5), 150.0);
  EXPECT_TRUE(two.says("it also has band 2, 'more': --band chooses")) << two.said;
  EXPECT_EQ(read_band("", "Float32", {.band = 2}, {}, place_10_m, further(2, "Float32")).at(0, 5), 0.0);
  EXPECT_TRUE(read_band("", "Float32", {.band = 3}).refuses("no band 3 (--band): its bands are 1 to 1"));
}

}  // namespace
}  // namespace scree
