#include "tools/import/gdal/north_up.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <string_view>

#include "tools/import/gdal/gdal_library.h"
#include "tools/import/gdal/ground_metric.h"
#include "tools/import/gdal/warp.h"

namespace scree {

namespace {

/// Lengths on the ground that differ less from those of the map are the map's: surveys keep within it.
constexpr double scale_error_max = 0.005;
/// A map whose north is farther from the true one is said to be so, degrees.
constexpr double convergence_said_min = 1.0;
/// A raster whose corners have another scale than its middle, by more than that part, is said to have it.
constexpr double corner_error_said_min = 0.01;
/// Cells below this size, without a map, lie in degrees: no survey has cells of a few centimetres.
constexpr double degrees_cell_max = 0.05;

/// Ways to place a raster, as GDAL names them.
constexpr const char* control_points = "GCP_POLYNOMIAL";
constexpr const char* rational_polynomials = "RPC";
constexpr const char* geolocation_arrays = "GEOLOC_ARRAY";

std::string name_of(const OGRSpatialReference& crs) {
  const std::string name = shown(crs.GetName());
  return name.empty() ? "without a name" : "'" + name + "'";
}

std::string code_of(const OGRSpatialReference& crs) {
  const char* const authority = crs.GetAuthorityName(nullptr);
  const char* const code = crs.GetAuthorityCode(nullptr);
  if (authority == nullptr || code == nullptr) return shown(crs.GetName());
  return shown(authority) + ":" + shown(code);
}

/// Whether numbers without a map can only be degrees.
bool looks_like_degrees(const MapTransform& transform, int columns, int rows) {
  const auto from = transform.at(0, 0), to = transform.at(columns, rows);
  const auto within = [&](size_t axis, double most) {
    return std::abs(from[axis]) <= most && std::abs(to[axis]) <= most;
  };
  if (!within(0, 360.001) || !within(1, 90.001)) return false;
  const double cell =
      std::max(std::hypot(transform.t[1], transform.t[4]), std::hypot(transform.t[2], transform.t[5]));
  return cell < degrees_cell_max || std::abs(std::abs(to[0] - from[0]) - 360.0) < 0.5 * cell;
}

/// How long the map is on the ground at a place.
struct MapScale {
  GroundMetric metric;
  double x_m = 1.0;  ///< of a unit
  double y_m = 1.0;
  bool turned_over = false;  ///< its axes point to the west and the south
  std::vector<std::string> words{};
};

std::string degrees_word(double degrees) {
  return fmt::format("{:.1f}° {}", std::abs(degrees), degrees < 0.0 ? "south" : "north");
}

/// Almost equal scales become one, and almost the map's own unit becomes that.
void even_out(MapScale& scale, double unit_m) {
  if (!(std::abs(scale.x_m / scale.y_m - 1.0) < scale_error_max)) return;
  const double mean_m = std::sqrt(scale.x_m * scale.y_m);
  scale.x_m = scale.y_m = std::abs(mean_m / unit_m - 1.0) < scale_error_max ? unit_m : mean_m;
}

void add_scale_words(MapScale& scale, const OGRSpatialReference& crs, double unit_m) {
  const double latitude = scale.metric.latitude_deg.value_or(0.0);
  if (crs.IsGeographic() != 0) {
    scale.words.push_back("degrees as metres at " + degrees_word(latitude));
    return;
  }
  if (unit_m != 1.0) scale.words.push_back(fmt::format("map units of {:.9g} m", unit_m));
  if (scale.x_m != unit_m || scale.y_m != unit_m)
    scale.words.push_back(fmt::format("{:.4g} × {:.4g} of the map's length at {}", scale.x_m / unit_m,
                                      scale.y_m / unit_m, degrees_word(latitude)));
  const double convergence = scale.metric.convergence_deg() - (scale.turned_over ? 180.0 : 0.0);
  const double off = std::remainder(convergence, 360.0);
  if (std::abs(off) > convergence_said_min)
    scale.words.push_back(fmt::format("the map's north is {:.1f}° {} of the true north", std::abs(off),
                                      off > 0.0 ? "east" : "west"));
}

bool points_west_or_south(const OGRSpatialReference& crs) {
  OGRAxisOrientation towards = OAO_Other;
  return crs.GetAxis(nullptr, 0, &towards) != nullptr && (towards == OAO_West || towards == OAO_South);
}

Result<MapScale> scale_at(const OGRSpatialReference& crs, double x, double y) {
  MapScale scale;
  const bool geographic = crs.IsGeographic() != 0;
  const double unit_m = geographic ? 1.0 : crs.GetLinearUnits();
  const auto metric = ground_metric(crs, x, y);
  scale.words.push_back("map " + name_of(crs));
  if (!metric && geographic)
    return fail(
        fmt::format("its middle, {:.6g}, {:.6g}, is no longitude and latitude of its map {}: --crs "
                    "names another map",
                    x, y, name_of(crs)));
  if (!metric) {
    scale.x_m = scale.y_m = unit_m;
    scale.words.push_back(
        fmt::format("its middle, {:.6g}, {:.6g}, lies outside of that map, so its scale "
                    "there is not known",
                    x, y));
    return scale;
  }
  scale.metric = *metric;
  scale.x_m = metric->scale_x();
  scale.y_m = metric->scale_y();
  scale.turned_over = std::abs(metric->convergence_deg()) > 135.0 && points_west_or_south(crs);
  if (!geographic) even_out(scale, unit_m);
  add_scale_words(scale, crs, unit_m);
  return scale;
}

std::string cells_words(const Raster::Shape& shape) {
  return fmt::format("{} × {} cells of {:.6g} × {:.6g} m", shape.columns, shape.rows,
                     shape.cell_x_m.value_or(0.0), shape.cell_z_m.value_or(0.0));
}

std::string direction_words(bool rows, bool columns) {
  if (rows && columns) return "turned by 180°: its rows begin in the south and its columns in the east";
  if (rows) return "turned over: its rows begin in the south";
  return columns ? "turned over: its columns begin in the east" : "north is up";
}

/// How much longer or shorter the map's cells are on the ground at a corner than in the middle, at most, as a
/// part; 0 where a corner is on no map.
double error_at_corners(const OGRSpatialReference& crs, const MapTransform& transform, int columns, int rows,
                        const GroundMetric& middle) {
  double most = 0.0;
  for (const auto& [column, row] : {std::pair{0, 0}, {columns, 0}, {0, rows}, {columns, rows}}) {
    const auto [x, y] = transform.at(column, row);
    const auto corner = ground_metric(crs, x, y);
    if (!corner) {
      if (crs.IsGeographic() != 0) return 1.0;  // beyond a pole
      continue;
    }
    most = std::max({most, std::abs(corner->scale_x() / middle.scale_x() - 1.0),
                     std::abs(corner->scale_y() / middle.scale_y() - 1.0)});
  }
  return most;
}

/// Reads rows and columns backwards where they run against north and east.
void straighten(const MapTransform& transform, const MapScale& scale, NorthUp& placed) {
  placed.flips_rows = (transform.t[5] > 0.0) != scale.turned_over;
  placed.flips_columns = (transform.t[1] < 0.0) != scale.turned_over;
  placed.shape.cell_x_m = std::abs(transform.t[1]) * scale.x_m;
  placed.shape.cell_z_m = std::abs(transform.t[5]) * scale.y_m;
  placed.words.push_back(direction_words(placed.flips_rows, placed.flips_columns));
}

/// The grid around a raster that lies askew, with north up and the same middle.
WarpGrid grid_around(const MapTransform& transform, int columns, int rows, double cell_x, double cell_y) {
  const auto middle = transform.at(0.5 * columns, 0.5 * rows);
  const double width = std::abs(transform.t[1]) * columns + std::abs(transform.t[2]) * rows;
  const double height = std::abs(transform.t[4]) * columns + std::abs(transform.t[5]) * rows;
  WarpGrid grid;
  grid.columns = static_cast<int>(std::min(std::max(std::round(width / cell_x), 1.0), 1.0e9));
  grid.rows = static_cast<int>(std::min(std::max(std::round(height / cell_y), 1.0), 1.0e9));
  grid.transform.t = {middle[0] - 0.5 * cell_x * grid.columns, cell_x, 0.0,
                      middle[1] + 0.5 * cell_y * grid.rows,    0.0,    -cell_y};
  return grid;
}

Result<void> turn(GDALDataset& heights, const MapTransform& transform, const MapScale& scale,
                  NorthUp& placed) {
  const auto& t = transform.t;
  const int columns = heights.GetRasterXSize(), rows = heights.GetRasterYSize();
  const bool quarter = transform.is_quarter_turned(columns, rows);
  double cell_x = std::abs(t[2]), cell_y = std::abs(t[4]);
  if (!quarter) {
    const double cell_m = std::min(std::hypot(t[1] * scale.x_m, t[4] * scale.y_m),
                                   std::hypot(t[2] * scale.x_m, t[5] * scale.y_m));
    cell_x = cell_m / scale.x_m;
    cell_y = cell_m / scale.y_m;
  }
  const WarpGrid grid = grid_around(transform, columns, rows, cell_x, cell_y);
  placed.warped = TRY(warp_to_grid(heights, grid, quarter));
  placed.flips_rows = placed.flips_columns = scale.turned_over;
  placed.shape = {grid.columns, grid.rows, cell_x * scale.x_m, cell_y * scale.y_m};
  placed.words.push_back(quarter ? "turned by a quarter, so that north is up"
                                 : "turned and resampled, so that north is up");
  return {};
}

/// Into a map of its own, with the true north up: GDAL finds the place of each cell.
Result<NorthUp> on_local_map(GDALDataset& heights, const OGRSpatialReference& crs, const GroundMetric& metric,
                             const char* method, std::vector<std::string> words) {
  NorthUp placed;
  const double longitude = metric.longitude_deg.value_or(0.0), latitude = metric.latitude_deg.value_or(0.0);
  const OGRSpatialReference map = local_map(crs, longitude, latitude);
  const bool may_name_none = std::string_view(method) == geolocation_arrays;
  placed.warped = TRY(warp_to_map(heights, may_name_none ? &crs : nullptr, &map, method));
  const auto transform = map_transform_of(*placed.warped);
  placed.shape = {placed.warped->GetRasterXSize(), placed.warped->GetRasterYSize(), {}, {}};
  if (transform) {
    placed.shape.cell_x_m = std::abs(transform->t[1]);
    placed.shape.cell_z_m = std::abs(transform->t[5]);
    const auto [x, y] = transform->at(0.5 * placed.shape.columns, 0.5 * placed.shape.rows);
    placed.place = {fmt::format("+proj=tmerc +lat_0={:.6f} +lon_0={:.6f}", latitude, longitude), x, y};
  }
  placed.words = std::move(words);
  placed.words.push_back(cells_words(placed.shape));
  placed.words.push_back("resampled, so that the true north is up");
  return placed;
}

/// The map on which the method places cells. Rational polynomials know WGS 84 alone, whatever map the file
/// names. Geolocation arrays name one themselves; without one they hold degrees. Nothing: control points of
/// no map.
std::optional<OGRSpatialReference> map_of_points(GDALDataset& heights, const OGRSpatialReference* crs,
                                                 std::string_view method) {
  const char* const own = heights.GetMetadataItem("SRS", "GEOLOCATION");
  if (OGRSpatialReference named;
      method == geolocation_arrays && own != nullptr &&
      named.SetFromUserInput(own, OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) ==
          OGRERR_NONE) {
    named.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    return named;
  }
  if (method != rational_polynomials && crs != nullptr) return *crs;
  if (method == control_points) return std::nullopt;
  OGRSpatialReference degrees;
  degrees.SetWellKnownGeogCS("WGS84");
  degrees.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return degrees;
}

/// By ground control points, rational polynomials or geolocation arrays.
Result<NorthUp> by_points(GDALDataset& heights, const OGRSpatialReference* crs, const char* method,
                          std::string words) {
  const auto [x, y] = TRY(middle_on_map(heights, method));
  const auto map = map_of_points(heights, crs, method);
  if (!map) {
    NorthUp placed;
    placed.warped = TRY(warp_to_map(heights, nullptr, nullptr, method));
    const auto transform = map_transform_of(*placed.warped);
    placed.shape = {placed.warped->GetRasterXSize(), placed.warped->GetRasterYSize(), {}, {}};
    if (transform) placed.shape.cell_x_m = placed.shape.cell_z_m = std::abs(transform->t[1]);
    placed.words = {std::move(words), "no map is named, metres are assumed", cells_words(placed.shape)};
    return placed;
  }
  const auto scale = TRY(scale_at(*map, x, y));
  if (!scale.metric.latitude_deg) return fail("its middle lies on no map of the Earth");
  return on_local_map(heights, *map, scale.metric, method, {std::move(words), "map " + name_of(*map)});
}

Result<NorthUp> by_transform(GDALDataset& heights, const OGRSpatialReference* crs,
                             const MapTransform& transform) {
  const int columns = heights.GetRasterXSize(), rows = heights.GetRasterYSize();
  if (!transform.is_finite() || !transform.has_area())
    return fail("its georeference gives its cells no area on the map");
  const auto [x, y] = transform.at(0.5 * columns, 0.5 * rows);
  if (crs == nullptr && looks_like_degrees(transform, columns, rows))
    return fail(
        fmt::format("it names no map, and its cells of {:.4g} around {:.6g}, {:.6g} look like degrees: "
                    "--crs EPSG:4326 says so, --cell METRES gives them a length",
                    std::hypot(transform.t[1], transform.t[4]), x, y));
  MapScale scale;
  scale.words = {"no map is named, metres are assumed"};
  if (crs != nullptr) {
    scale = TRY(scale_at(*crs, x, y));
    const double error = error_at_corners(*crs, transform, columns, rows, scale.metric);
    if (error > corner_error_said_min)
      scale.words.push_back(fmt::format("lengths at its corners are up to {:.0f} % off", 100.0 * error));
  }
  if (!scale.metric.is_right_angled())
    return on_local_map(heights, *crs, scale.metric, "GEOTRANSFORM", std::move(scale.words));
  NorthUp placed;
  placed.words = scale.words;
  placed.place = {crs == nullptr ? std::string() : code_of(*crs), x, y};
  placed.shape = {columns, rows, {}, {}};
  if (transform.is_straight(columns, rows))
    straighten(transform, scale, placed);
  else
    TRY(turn(heights, transform, scale, placed));
  placed.words.insert(placed.words.end() - 1, cells_words(placed.shape));
  return placed;
}

bool has_points(GDALDataset& heights) {
  return heights.GetGCPCount() > 0 || heights.GetMetadata("RPC") != nullptr ||
         heights.GetMetadata("GEOLOCATION") != nullptr;
}

/// Whether the transform only counts cells of the picture, whose place on a map something else says, or
/// nothing.
bool is_of_the_picture(GDALDataset& heights, const OGRSpatialReference* crs, const MapTransform& transform) {
  const bool counts_cells = transform.t == MapTransform{}.t;
  if (has_points(heights)) return counts_cells || crs == nullptr;
  return counts_cells && crs != nullptr && crs->IsGeographic() != 0;
}

}  // namespace

Result<NorthUp> place_north_up(GDALDataset& heights) {
  const OGRSpatialReference* const crs = heights.GetSpatialRef();
  const auto transform = map_transform_of(heights);
  if (transform && !is_of_the_picture(heights, crs, *transform))
    return by_transform(heights, crs, *transform);
  if (heights.GetGCPCount() > 0)
    return by_points(heights, crs, control_points, "placed by ground control points");
  if (heights.GetMetadata("RPC") != nullptr)
    return by_points(heights, crs, rational_polynomials, "placed by rational polynomials at height 0");
  if (heights.GetMetadata("GEOLOCATION") != nullptr)
    return by_points(heights, crs, geolocation_arrays, "placed by geolocation arrays");
  NorthUp placed;
  placed.shape = {heights.GetRasterXSize(), heights.GetRasterYSize(), {}, {}};
  placed.words = {
      fmt::format("{} × {} cells without a place on a map", placed.shape.columns, placed.shape.rows),
      "north is assumed to be up"};
  return placed;
}

}  // namespace scree
