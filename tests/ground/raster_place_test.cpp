// How rasters lie on the map: each way of turning, lengths on the ground by kind of map, control points.
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/vrt_raster.h"

namespace scree {
namespace {

using Transform = std::array<double, 6>;

std::string transform_element(const Transform& t) {
  return fmt::format("<GeoTransform>{},{},{},{},{},{}</GeoTransform>", t[0], t[1], t[2], t[3], t[4], t[5]);
}

std::string on_map(const std::string& crs, const Transform& t) {
  return "<SRS>" + crs + "</SRS>" + transform_element(t);
}

double plane_m(double x, double y) {
  return 0.2 * x + 0.3 * y;
}

/// A raster whose stored values are plane_m() of the map at each cell's middle.
VrtRaster plane(int columns, int rows, const Transform& t, const std::string& head) {
  return {.columns = columns,
          .rows = rows,
          .stored =
              [t](int column, int row) {
                const double c = column + 0.5, r = row + 0.5;
                return plane_m(t[0] + c * t[1] + r * t[2], t[3] + c * t[4] + r * t[5]);
              },
          .head = head,
          .band = {},
          .type = "Float64"};
}

/// Each cell with a height has that of plane_m() at its place around the middle; how many cells do.
int expect_plane(const WholeRaster& whole, double tolerance_m) {
  EXPECT_EQ(whole.refusal, "");
  EXPECT_TRUE(whole.place);
  if (!whole.place || !whole.shape.cell_x_m || !whole.shape.cell_z_m) return 0;
  int count = 0;
  for (int z = 0; z < whole.shape.rows; ++z)
    for (int x = 0; x < whole.shape.columns; ++x) {
      if (std::isnan(whole.at(x, z))) continue;
      const double east = (x + 0.5 - 0.5 * whole.shape.columns) * *whole.shape.cell_x_m;
      const double south = (z + 0.5 - 0.5 * whole.shape.rows) * *whole.shape.cell_z_m;
      EXPECT_NEAR(whole.at(x, z), plane_m(whole.place->x + east, whole.place->y - south), tolerance_m)
          << x << ", " << z;
      ++count;
    }
  return count;
}

TEST(RasterPlace, all_eight_ways_to_lie_along_the_axes_give_the_same_heights) {
  const TestFolder folder;
  for (const int along : {-1, 1})
    for (const int across : {-1, 1})
      for (const bool quarter : {false, true}) {
        const double a = 10.0 * along, b = 7.0 * across;
        const Transform t =
            quarter ? Transform{500.0, 0.0, b, 800.0, a, 0.0} : Transform{500.0, a, 0.0, 800.0, 0.0, b};
        const WholeRaster whole = read_whole(write_vrt(folder, plane(9, 6, t, transform_element(t))));
        EXPECT_EQ(expect_plane(whole, 1.0e-9), 54) << along << across << quarter;
        EXPECT_EQ(whole.shape.columns, quarter ? 6 : 9);
        EXPECT_EQ(whole.shape.cell_x_m, quarter ? 7.0 : 10.0);
      }
}

TEST(RasterPlace, any_other_turn_is_resampled_with_north_up) {
  const TestFolder folder;
  for (const double degrees : {10.0, 45.0, 123.0, 250.0}) {
    const double c = 10.0 * std::cos(degrees * M_PI / 180.0), s = 10.0 * std::sin(degrees * M_PI / 180.0);
    const Transform t{5000.0, c, s, 8000.0, s, -c};
    const WholeRaster whole = read_whole(write_vrt(folder, plane(80, 60, t, transform_element(t))));
    EXPECT_TRUE(whole.says("turned and resampled")) << whole.said;
    EXPECT_NEAR(whole.shape.cell_x_m.value_or(0.0), 10.0, 1.0e-9);
    // A cell at the border has some of its heights from its neighbours within.
    const int count = expect_plane(whole, 3.0);
    EXPECT_NEAR(count, 4800, 200) << degrees;
  }
}

TEST(RasterPlace, degrees_are_metres_in_the_middle) {
  const TestFolder folder;
  const auto stored = [](int column, int) { return static_cast<double>(column); };
  const Transform t{-71.0, 0.0002, 0.0, -59.99, 0.0, -0.0002};
  const WholeRaster whole = read_whole(
      write_vrt(folder, {.columns = 100, .rows = 100, .stored = stored, .head = on_map("EPSG:4326", t)}));
  ASSERT_EQ(whole.refusal, "");
  EXPECT_NEAR(whole.shape.cell_x_m.value_or(0.0), 0.0002 * 55'800.0 * 0.9997, 0.02) << "at 60° south";
  EXPECT_NEAR(whole.shape.cell_z_m.value_or(0.0), 0.0002 * 111'412.0, 0.01);
  EXPECT_TRUE(whole.says("degrees as metres at 60.0° south")) << whole.said;
  EXPECT_EQ(whole.at(99, 0), 99.0);
}

TEST(RasterPlace, a_tile_across_the_date_line_is_like_any_other) {
  const TestFolder folder;
  const auto stored = [](int column, int) { return static_cast<double>(column); };
  const Transform geographic{179.99, 0.0002, 0.0, 10.0, 0.0, -0.0002};
  const WholeRaster degrees = read_whole(write_vrt(
      folder, {.columns = 100, .rows = 100, .stored = stored, .head = on_map("EPSG:4326", geographic)}));
  EXPECT_NEAR(degrees.shape.cell_x_m.value_or(0.0), 0.0002 * 109'640.0, 0.02);
  const Transform mercator{20'037'508.0 - 500.0, 10.0, 0.0, 0.0, 0.0, -10.0};
  const WholeRaster metres = read_whole(write_vrt(
      folder, {.columns = 100, .rows = 100, .stored = stored, .head = on_map("EPSG:3857", mercator)}));
  EXPECT_NEAR(metres.shape.cell_x_m.value_or(0.0), 10.0, 1.0e-6) << metres.said << metres.refusal;
}

TEST(RasterPlace, maps_have_units_of_their_own) {
  const TestFolder folder;
  const auto cell_of = [&](const std::string& crs, const Transform& t) {
    const WholeRaster whole = read_whole(write_vrt(
        folder,
        {.columns = 10, .rows = 10, .stored = [](int x, int) { return x * 1.0; }, .head = on_map(crs, t)}));
    EXPECT_EQ(whole.refusal, "");
    EXPECT_EQ(whole.at(9, 0), 9.0);
    return whole.shape.cell_x_m.value_or(0.0);
  };
  EXPECT_NEAR(cell_of("EPSG:2263", {990'000, 10, 0, 200'000, 0, -10}), 12'000.0 / 3937.0, 1.0e-9);
  EXPECT_NEAR(cell_of("+proj=utm +zone=33 +units=km +type=crs", {500, 0.01, 0, 5000, 0, -0.01}), 10.0,
              1.0e-9);
  EXPECT_NEAR(cell_of("EPSG:32633", {500'000, 10, 0, 5'000'000, 0, -10}), 10.0, 1.0e-9);
  // Cape / Lo29: its axes count to the west and the south, so north-up rows have these signs.
  EXPECT_NEAR(cell_of("EPSG:2053", {100'000, -10, 0, 2'900'000, 0, 10}), 10.0, 1.0e-9);
  EXPECT_NEAR(cell_of("LOCAL_CS[\"mine\",UNIT[\"foot\",0.3048]]", {0, 10, 0, 0, 0, -10}), 3.048, 1.0e-9);
}

TEST(RasterPlace, a_map_whose_axes_meet_askew_is_resampled) {
  const TestFolder folder;
  // The sinusoidal map at 60° east, 50° north: its y is the latitude alone, and it has the right areas.
  const double x = 6'371'007.181 * std::cos(50.0 * M_PI / 180.0) * 60.0 * M_PI / 180.0;
  const double y = 6'371'007.181 * 50.0 * M_PI / 180.0;
  const Transform t{x, 20.0, 0.0, y, 0.0, -20.0};
  const auto northwards = [](int, int row) { return 1000.0 - row * 5.0; };
  const WholeRaster whole =
      read_whole(write_vrt(folder, {.columns = 150,
                                    .rows = 150,
                                    .stored = northwards,
                                    .head = on_map("+proj=sinu +R=6371007.181 +type=crs", t)}));
  ASSERT_EQ(whole.refusal, "");
  const double cell_m2 = whole.shape.cell_x_m.value_or(0.0) * whole.shape.cell_z_m.value_or(0.0);
  const auto has = [](double height_m) { return !std::isnan(height_m); };
  const auto count = static_cast<double>(std::ranges::count_if(whole.heights_m, has));
  EXPECT_NEAR(count * cell_m2, 150.0 * 150.0 * 400.0, 0.03 * 9.0e6);
  for (int z = 10; z + 10 < whole.shape.rows; ++z) {
    double lowest_m = 1.0e9, highest_m = -1.0e9;
    for (int column = 0; column < whole.shape.columns; ++column)
      if (has(whole.at(column, z))) {
        lowest_m = std::min(lowest_m, whole.at(column, z));
        highest_m = std::max(highest_m, whole.at(column, z));
      }
    EXPECT_LT(highest_m - lowest_m, 6.0) << "one latitude is one height, in row " << z;
  }
}

TEST(RasterPlace, control_points_place_a_raster) {
  const TestFolder folder;
  const auto points = [](double bend) {
    std::string list = "<GCPList Projection=\"EPSG:32633\">";
    for (const auto& [pixel, line] : {std::pair{0, 0}, {60, 0}, {0, 40}, {60, 40}, {30, 20}})
      list += fmt::format("<GCP Id=\"\" Pixel=\"{}\" Line=\"{}\" X=\"{}\" Y=\"{}\"/>", pixel, line,
                          500'000.0 + 10.0 * pixel, 5'000'000.0 - 10.0 * line + (pixel == 30 ? bend : 0.0));
    return list + "</GCPList>";
  };
  const Transform t{500'000.0, 10.0, 0.0, 5'000'000.0, 0.0, -10.0};
  const WholeRaster exact = read_whole(write_vrt(folder, plane(60, 40, t, points(0.0))));
  EXPECT_EQ(expect_plane(exact, 1.0e-6), 2400) << exact.said;
  const WholeRaster bent = read_whole(write_vrt(folder, plane(60, 40, t, points(4.0))));
  ASSERT_EQ(bent.refusal, "");
  EXPECT_TRUE(bent.says("placed by ground control points")) << bent.said;
  EXPECT_NEAR(bent.shape.cell_x_m.value_or(0.0), 10.0, 0.2);
}

std::string metadata(const std::string& domain, const std::vector<std::array<std::string, 2>>& items) {
  std::string element = "<Metadata domain=\"" + domain + "\">";
  for (const auto& [key, value] : items) element += fmt::format("<MDI key=\"{}\">{}</MDI>", key, value);
  return element + "</Metadata>";
}

TEST(RasterPlace, rational_polynomials_are_of_degrees_whatever_map_the_file_names) {
  const TestFolder folder;
  const auto only = [](int at, double value) {
    std::string list;
    for (int i = 0; i < 20; ++i) list += fmt::format("{} ", i == at ? value : 0.0);
    return list;
  };
  // The line is the latitude, from 30 rows north of 47° to 30 rows south, and the sample the longitude.
  const std::string polynomials = metadata("RPC", {{"LINE_OFF", "30"},
                                                   {"SAMP_OFF", "30"},
                                                   {"LAT_OFF", "47"},
                                                   {"LONG_OFF", "15"},
                                                   {"HEIGHT_OFF", "0"},
                                                   {"LINE_SCALE", "30"},
                                                   {"SAMP_SCALE", "30"},
                                                   {"LAT_SCALE", "0.0027"},
                                                   {"LONG_SCALE", "0.0039"},
                                                   {"HEIGHT_SCALE", "500"},
                                                   {"LINE_NUM_COEFF", only(2, -1.0)},
                                                   {"LINE_DEN_COEFF", only(0, 1.0)},
                                                   {"SAMP_NUM_COEFF", only(1, 1.0)},
                                                   {"SAMP_DEN_COEFF", only(0, 1.0)}});
  for (const std::string& named : {std::string(), std::string("<SRS>EPSG:32633</SRS>")}) {
    const auto stored = [](int column, int row) { return column + 100.0 * row; };
    const WholeRaster whole = read_whole(
        write_vrt(folder, {.columns = 60, .rows = 60, .stored = stored, .head = named + polynomials}));
    ASSERT_EQ(whole.refusal, "");
    EXPECT_TRUE(whole.says("rational polynomials at height 0; map 'WGS 84'")) << whole.said;
    EXPECT_EQ(whole.shape.columns, 60);
    EXPECT_EQ(whole.shape.rows, 60);
    EXPECT_NEAR(whole.shape.cell_x_m.value_or(0.0), 9.95, 0.1) << named;
    ASSERT_TRUE(whole.place);
    EXPECT_NE(whole.place->crs.find("lat_0=47.0"), std::string::npos) << whole.place->crs;
  }
}

TEST(RasterPlace, geolocation_arrays_are_of_the_map_that_they_name_or_of_degrees) {
  const TestFolder folder;
  const auto write_array = [&](const char* name, const std::function<double(int, int)>& value) {
    std::ofstream grid(folder / name);
    grid << "ncols 60\nnrows 60\nxllcorner 0\nyllcorner 0\ncellsize 1\n";
    for (int row = 0; row < 60; ++row)
      for (int column = 0; column < 60; ++column)
        grid << fmt::format("{:.4f}{}", value(column, row), column < 59 ? ' ' : '\n');
  };
  const auto cell_of = [&](const std::string& own, const std::string& head) {
    std::vector<std::array<std::string, 2>> items = {{"X_DATASET", folder / "x.asc"},
                                                     {"X_BAND", "1"},
                                                     {"Y_DATASET", folder / "y.asc"},
                                                     {"Y_BAND", "1"},
                                                     {"PIXEL_OFFSET", "0"},
                                                     {"LINE_OFFSET", "0"},
                                                     {"PIXEL_STEP", "1"},
                                                     {"LINE_STEP", "1"}};
    if (!own.empty()) items.push_back({"SRS", own});
    const WholeRaster whole =
        read_whole(write_vrt(folder, {.columns = 60,
                                      .rows = 60,
                                      .stored = [](int column, int row) { return column + 100.0 * row; },
                                      .head = head + metadata("GEOLOCATION", items)}));
    EXPECT_EQ(whole.refusal, "");
    return whole.shape.cell_z_m.value_or(0.0);
  };
  const std::string degrees =
      "GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\",6378137,298.257223563]],"
      "PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]]";
  write_array("x.asc", [](int column, int) { return 15.0 + 0.0130 * column; });
  write_array("y.asc", [](int, int row) { return 47.0 - 0.0090 * row; });
  EXPECT_NEAR(cell_of("", ""), 990.0, 30.0) << "no map is named";
  EXPECT_NEAR(cell_of(degrees, ""), 990.0, 30.0);
  EXPECT_NEAR(cell_of(degrees, "<SRS>EPSG:32633</SRS>"), 990.0, 30.0) << "the map of the cells is another";
  write_array("x.asc", [](int column, int) { return 500'000.0 + 100.0 * column; });
  write_array("y.asc", [](int, int row) { return 5'000'000.0 - 100.0 * row; });
  EXPECT_NEAR(cell_of("EPSG:32633", ""), 100.0, 3.0);
}

TEST(RasterPlace, a_place_that_cannot_be_is_refused) {
  const TestFolder folder;
  const auto refusal = [&](const std::string& head, const RasterChoice& choice = {}) {
    return read_whole(
        write_vrt(
            folder,
            {.columns = 8, .rows = 8, .stored = [](int column, int) { return column * 1.0; }, .head = head}),
        choice);
  };
  const Transform degrees{15.0, 0.0002, 0.0, 45.0, 0.0, -0.0002};
  const Transform metres{500'000.0, 10.0, 0.0, 5'000'000.0, 0.0, -10.0};
  EXPECT_TRUE(refusal(transform_element(degrees)).refuses("look like degrees"));
  EXPECT_EQ(refusal(transform_element(degrees), {.crs = "EPSG:4326"}).refusal, "");
  EXPECT_TRUE(refusal(on_map("EPSG:4326", metres)).refuses("no longitude and latitude"));
  EXPECT_EQ(refusal(on_map("EPSG:4326", metres), {.crs = "EPSG:32633"}).refusal, "");
  EXPECT_TRUE(refusal(transform_element(metres), {.crs = "EPSG:nonsense"}).refuses("--crs"));
  EXPECT_TRUE(refusal(transform_element({0.0, 1.0, 2.0, 0.0, 1.0, 2.0})).refuses("no area"));
  const WholeRaster nowhere = refusal("");
  EXPECT_EQ(nowhere.refusal, "");
  EXPECT_FALSE(nowhere.shape.cell_x_m);
  EXPECT_TRUE(nowhere.says("without a place on a map")) << nowhere.said;
}

}  // namespace
}  // namespace scree
