#include "tools/import/heights_import.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <map>

#include "ground/ground_writer.h"
#include "shared/base/limits.h"
#include "tools/import/limits.h"

namespace scree {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// What the first reading finds.
struct Survey {
  double lowest_m = std::numeric_limits<double>::infinity();
  double highest_m = -std::numeric_limits<double>::infinity();
  uint64_t nodata = 0;
};

Result<Survey> survey(Raster& raster, const HeightsImport& how, const std::function<void(double)>& progress) {
  const Raster::Shape shape = raster.shape();
  Survey found;
  std::vector<double> row(static_cast<size_t>(shape.columns));
  for (int z = 0; z < shape.rows; ++z) {
    TRY(raster.read_row(z, row));
    for (const double height : row) {
      if (!std::isfinite(height)) {
        ++found.nodata;
        continue;
      }
      found.lowest_m = std::min(found.lowest_m, height * how.vertical_scale);
      found.highest_m = std::max(found.highest_m, height * how.vertical_scale);
    }
    progress(0.2 + 0.2 * (z + 1) / shape.rows);
  }
  if (found.lowest_m > found.highest_m) return fail("the raster has no heights: no cell has data");
  if (std::max(-found.lowest_m, found.highest_m) > limits::raster_height_max_m)
    return fail(
        fmt::format("heights of {:.4g} to {:.4g} m are too large (limits.raster_height_max_m); if they are "
                    "in another unit, convert it by --vertical-scale",
                    found.lowest_m, found.highest_m));
  return found;
}

/// The cells of a raster that make a sample of the ground, along one axis, and their parts in it.
struct Taps {
  int first = 0;
  std::vector<double> weights;
};

/// The cubic B-spline at a distance.
double spline(double distance) {
  const double u = std::abs(distance);
  if (u < 1.0) return (3.0 * u * u * u - 6.0 * u * u + 4.0) / 6.0;
  return u < 2.0 ? (2.0 - u) * (2.0 - u) * (2.0 - u) / 6.0 : 0.0;
}

/// The samples of the ground along one axis, in the raster. The middles of both lie at one place.
struct Axis {
  int count = 0;      ///< samples
  int cells = 0;      ///< of the raster
  double step = 1.0;  ///< from sample to sample, cells
  bool fits = true;   ///< the outermost samples are the outermost cells
  bool is_taken() const { return fits && count == cells; }

  double place(int sample) const {
    if (fits) return static_cast<double>(sample) * static_cast<double>(cells - 1) / (count - 1);
    return 0.5 * (cells - 1) + (sample - 0.5 * (count - 1)) * step;
  }
};

/// Lengths that differ by less, relative, are equal: cells of degrees and of 32-bit floats are rounded.
constexpr double rounding = 1.0e-6;

Axis axis_of(int count, int cells, double cell_m, double sample_m) {
  const double exact = static_cast<double>(cells - 1) / static_cast<double>(count - 1);
  const double step = sample_m / cell_m;
  const double error = std::abs(step / exact - 1.0);
  const bool fits = error < rounding || (count == cells && error <= limits::extent_error_max);
  return {count, cells, fits ? exact : step, fits};
}

/// Samples farther apart than cells have a wider spline, so that no cell is left out.
Taps taps_of(const Axis& axis, int sample) {
  if (axis.is_taken()) return {sample, {1.0}};
  const double at = axis.place(sample);
  const double width = std::max(1.0, axis.step);
  Taps taps;
  taps.first = static_cast<int>(std::floor(at - 2.0 * width)) + 1;
  double sum = 0.0;
  for (int cell = taps.first; static_cast<double>(cell) < at + 2.0 * width; ++cell) {
    taps.weights.push_back(spline((cell - at) / width));
    sum += taps.weights.back();
  }
  for (double& weight : taps.weights) weight /= sum;
  return taps;
}

struct Axes {
  Axis x;
  Axis z;
};

/// A raster's rows in the ground's samples. Where these lie between cells, by the cubic B-spline, as the
/// ground's own surface (shared/field/heights.h): heights in whole metres make no terraces. Rows are asked
/// for from the north.
class Resampled {
 public:
  Resampled(Raster& raster, const Axes& axes, double scale, double fill_m)
      : raster_(raster), shape_(raster.shape()), axis_z_(axes.z), scale_(scale), fill_m_(fill_m) {
    for (int x = 0; x < axes.x.count; ++x) columns_.push_back(taps_of(axes.x, x));
  }

  Result<void> row(int z, std::span<double> heights_m) {
    const Taps taps = taps_of(axis_z_, z);
    std::ranges::fill(heights_m, 0.0);
    for (size_t k = 0; k < taps.weights.size(); ++k) {
      const auto* const row = TRY(source(std::clamp(taps.first + static_cast<int>(k), 0, shape_.rows - 1)));
      for (size_t i = 0; i < heights_m.size(); ++i) heights_m[i] += taps.weights[k] * (*row)[i];
    }
    rows_.erase(rows_.begin(), rows_.lower_bound(std::clamp(taps.first, 0, shape_.rows - 1)));
    return {};
  }

 private:
  /// A row of the raster, in the ground's columns.
  Result<const std::vector<double>*> source(int z) {
    const auto found = rows_.find(z);
    if (found != rows_.end()) return &found->second;
    std::vector<double> cells(static_cast<size_t>(shape_.columns));
    TRY(raster_.read_row(z, cells));
    for (double& height : cells) height = std::isfinite(height) ? height * scale_ : fill_m_;
    std::vector<double> row;
    row.reserve(columns_.size());
    for (const Taps& taps : columns_) {
      double sum = 0.0;
      for (size_t k = 0; k < taps.weights.size(); ++k)
        sum +=
            taps.weights[k] *
            cells[static_cast<size_t>(std::clamp(taps.first + static_cast<int>(k), 0, shape_.columns - 1))];
      row.push_back(sum);
    }
    return &rows_.emplace(z, std::move(row)).first->second;
  }

  Raster& raster_;
  const Raster::Shape shape_;
  const Axis axis_z_;
  double scale_;
  double fill_m_;
  std::vector<Taps> columns_;
  std::map<int, std::vector<double>> rows_;
};

struct Cells {
  double x_m;
  double z_m;
};

Cells cells_of(const Raster::Shape& shape, const HeightsImport& how) {
  const double x_m = shape.cell_x_m.value_or(none), z_m = shape.cell_z_m.value_or(none);
  if (!how.cell_m) return {x_m, z_m};
  const bool known = std::isfinite(x_m) && std::isfinite(z_m);
  return {known ? *how.cell_m * x_m / z_m : *how.cell_m, *how.cell_m};
}

/// Samples less one along a raster's side: as far as it, or farther where that would be short.
double steps_of(double length_m, double sample_m) {
  const double nearest = std::round(length_m / sample_m);
  const bool fits = std::abs(nearest * sample_m / length_m - 1.0) <= limits::extent_error_max;
  return fits ? nearest : std::ceil(length_m / sample_m);
}

/// Distance of the ground's samples: that of the closest cells, or the part of it whose multiples come as
/// near the width and the depth of a small raster as they have to, or can.
double sample_of(const Raster::Shape& shape, const Cells& cells) {
  const double closest_m = std::min(cells.x_m, cells.z_m);
  const auto miss = [](double length_m, double sample_m) {
    return std::abs(steps_of(length_m, sample_m) * sample_m / length_m - 1.0);
  };
  double best_m = closest_m, least = std::numeric_limits<double>::infinity();
  for (int parts = 1; parts <= limits::sample_parts_max; ++parts) {
    const double sample_m = closest_m / parts;
    if (sample_m < static_cast<double>(limits::height_cell_min_m)) break;
    const double worse = std::max(miss(cells.x_m * (shape.columns - 1), sample_m),
                                  miss(cells.z_m * (shape.rows - 1), sample_m));
    if (worse <= limits::extent_error_max) return sample_m;
    if (worse >= least) continue;
    least = worse;
    best_m = sample_m;
  }
  return best_m;
}

Result<HeightLayout> layout_of(const Raster::Shape& shape, const HeightsImport& how) {
  if (shape.columns < 2 || shape.rows < 2)
    return fail(
        fmt::format("{} × {} cells are too few: a surface needs at least 2 × 2", shape.columns, shape.rows));
  if (shape.columns > limits::raster_side_max || shape.rows > limits::raster_side_max)
    return fail(fmt::format("{} × {} cells: at most {} a side can be imported (limits.raster_side_max)",
                            shape.columns, shape.rows, limits::raster_side_max));
  const Cells cells = cells_of(shape, how);
  const auto [cell_x_m, cell_z_m] = cells;
  if (!std::isfinite(cell_x_m) || !std::isfinite(cell_z_m))
    return fail("the file does not say how wide its cells are: use --cell METRES");
  const double sample_m = how.sample_m.value_or(sample_of(shape, cells));
  const double width = steps_of(cell_x_m * (shape.columns - 1), sample_m);
  const double depth = steps_of(cell_z_m * (shape.rows - 1), sample_m);
  if (width * sample_m > 2.0 * static_cast<double>(limits::world_half_width_m) ||
      depth * sample_m > 2.0 * static_cast<double>(limits::world_half_width_m))
    return fail(fmt::format(
        "{:.0f} × {:.0f} m are wider than a world, {:.0f} m (limits.world_half_width_m); cut the "
        "raster (gdal_translate -srcwin), or say --cell for a smaller scale",
        width * sample_m, depth * sample_m, 2.0 * static_cast<double>(limits::world_half_width_m)));
  if (!(width + 1.0 <= limits::height_samples_max && depth + 1.0 <= limits::height_samples_max))
    return fail(fmt::format("samples every {} m are more than {} a side (limits.height_samples_max)",
                            sample_m, limits::height_samples_max));
  constexpr auto min_m = static_cast<double>(limits::height_cell_min_m);
  constexpr auto max_m = static_cast<double>(limits::height_cell_max_m);
  if (!(sample_m >= min_m && sample_m <= max_m))
    return fail(fmt::format(
        "the ground's samples would lie {:.4g} m apart, and {:.4g} to {:.4g} m are possible "
        "(limits.height_cell_min_m, height_cell_max_m): --sample chooses their distance, and --cell another "
        "scale of the map",
        sample_m, min_m, max_m));
  HeightLayout layout;
  layout.columns = static_cast<int32_t>(width) + 1;
  layout.rows = static_cast<int32_t>(depth) + 1;
  layout.cell_m = static_cast<float>(sample_m);
  return layout;
}

/// The height that becomes y = 0; the error says how the model can be made to fit.
Result<double> zero_of(const Survey& found, const HeightsImport& how) {
  const double relief_m = found.highest_m - found.lowest_m;
  const bool low = relief_m <= limits::relief_at_zero_max_m;
  const double ground_m = low ? found.lowest_m : 0.5 * (found.lowest_m + found.highest_m);
  const double zero_m = how.zero_m.value_or(std::floor(ground_m + 0.5 / height_steps_per_m));
  const auto max_m = static_cast<double>(limits::height_max_m);
  if (found.lowest_m - zero_m < -max_m || found.highest_m - zero_m > max_m)
    return fail(
        fmt::format("heights of {:.1f} to {:.1f} m do not fit into ± {:.0f} m around {:.1f} m "
                    "(limits.height_max_m); --vertical-scale below {:.2f} makes them fit",
                    found.lowest_m, found.highest_m, max_m, zero_m,
                    how.vertical_scale * 2.0 * max_m / std::max(relief_m, 1.0)));
  return zero_m;
}

int32_t quantised(double height_m) {
  const auto max_m =
      static_cast<double>(limits::height_max_m);  // what fills cells without data may go beyond
  return static_cast<int32_t>(std::lround(std::clamp(height_m, -max_m, max_m) * height_steps_per_m));
}

/// What an outermost sample stands for, metres: up to the raster's edge, half a cell beyond its last one.
double edge_of(const Axis& axis, double cell_m, double sample_m) {
  const double beyond_m = axis.fits ? 0.0 : -axis.place(0) * cell_m;
  return 0.5 * (sample_m + cell_m) - beyond_m;
}

void note(HeightsImported& imported, const HeightLayout& layout, const Cells& cells, const Axes& axes, int z,
          std::span<const int32_t> heights) {
  const double sample_m = static_cast<double>(layout.cell_m);
  const double edge_x_m = edge_of(axes.x, cells.x_m, sample_m);
  const double edge_z_m = edge_of(axes.z, cells.z_m, sample_m);
  double sum = 0.0;
  for (const int32_t height : heights) sum += static_cast<double>(height);
  const double ends = static_cast<double>(heights.front()) + static_cast<double>(heights.back());
  const double depth_m = z == 0 || z == layout.rows - 1 ? edge_z_m : sample_m;
  imported.volume_m3 += ((sum - ends) * sample_m + ends * edge_x_m) / height_steps_per_m * depth_m;
  const int side = std::max(layout.columns, layout.rows);
  const int step = (side + limits::preview_side_max - 1) / limits::preview_side_max;
  if (z % step != 0) return;
  imported.preview_columns = (layout.columns + step - 1) / step;
  imported.preview_cell_m = layout.cell_m * static_cast<float>(step);
  for (int x = 0; x < layout.columns; x += step)
    imported.preview_m.push_back(static_cast<float>(heights[static_cast<size_t>(x)]) / height_steps_per_m);
}

void say_cells(const Raster::Shape& shape, const HeightsImport& how, HeightsImported& imported) {
  if (!how.cell_m || !shape.cell_z_m) return;
  const Cells cells = cells_of(shape, how);
  const double factor = *how.cell_m / *shape.cell_z_m;
  std::string words =
      fmt::format("--cell makes the map {:.4g} times as large, with cells of {:.6g} × {:.6g} m", factor,
                  cells.x_m, cells.z_m);
  if (how.vertical_scale == 1.0) words += "; --vertical-scale does so to heights, which stay as they are";
  imported.said.push_back(std::move(words));
}

/// `length`: "wide" or "deep".
void say_extent(const Axis& axis, double cell_m, double sample_m, const char* length,
                HeightsImported& imported) {
  const double own_m = cell_m * (axis.cells - 1), ground_m = sample_m * (axis.count - 1);
  const double beyond_m = 0.5 * (ground_m - own_m);
  if (std::abs(ground_m / own_m - 1.0) < rounding) return;
  if (axis.fits)
    imported.said.push_back(
        fmt::format("it is {:.6g} m {}, and its cells, as samples {:.6g} m apart, {:.6g} m: the ground is "
                    "{:.2g} % {} there",
                    own_m, length, sample_m, ground_m, 100.0 * std::abs(ground_m / own_m - 1.0),
                    ground_m > own_m ? "longer" : "shorter"));
  else if (beyond_m > 0.0)
    imported.said.push_back(
        fmt::format("it is {:.6g} m {}, and the ground {:.6g} m, in samples {:.6g} m apart: the heights at "
                    "its edges continue for {:.3g} m (--sample)",
                    own_m, length, ground_m, sample_m, beyond_m));
  else
    imported.said.push_back(
        fmt::format("it is {:.6g} m {}, and the ground {:.6g} m, in samples {:.6g} m apart: {:.3g} m at its "
                    "edges are left out (--sample)",
                    own_m, length, ground_m, sample_m, -beyond_m));
}

void say_fill(const Raster::Shape& shape, const HeightsImport& how, double fill_m,
              HeightsImported& imported) {
  if (imported.nodata == 0) return;
  const uint64_t all = static_cast<uint64_t>(shape.columns) * static_cast<uint64_t>(shape.rows);
  imported.said.push_back(fmt::format("{} of {} cells have no height; they became {:.6g} m high, {}",
                                      imported.nodata, all, fill_m,
                                      how.fill_m ? "as --fill says" : "as the lowest (--fill METRES)"));
}

}  // namespace

Result<HeightsImported> import_heights(Raster& raster, const std::string& path, const HeightsImport& how,
                                       const std::function<void(double)>& progress) {
  auto layout = TRY(layout_of(raster.shape(), how));
  TRY(raster.check_values([&](double part) { progress(0.2 * part); }));
  const auto found = TRY(survey(raster, how, progress));
  const auto zero_m = zero_of(found, how);
  TRY(zero_m);
  layout.layers.soil_below_m = static_cast<float>(how.soil_below_m.value_or(limits::world_half_height_m));
  layout.layers.ice_above_m = static_cast<float>(how.ice_above_m.value_or(limits::world_half_height_m));
  TRY(validate(layout));
  auto writer = TRY(GroundWriter::create(path, layout, static_cast<float>(*zero_m),
                                         how.palette != nullptr ? *how.palette : builtin_palette()));
  HeightsImported imported;
  const double fill_m = how.fill_m.value_or(found.lowest_m);
  const Cells cells = cells_of(raster.shape(), how);
  const auto sample_m = static_cast<double>(layout.cell_m);
  const Axes axes{axis_of(layout.columns, raster.shape().columns, cells.x_m, sample_m),
                  axis_of(layout.rows, raster.shape().rows, cells.z_m, sample_m)};
  Resampled resampled(raster, axes, how.vertical_scale, fill_m);
  std::vector<double> row(static_cast<size_t>(layout.columns));
  std::vector<int32_t> heights(row.size());
  for (int z = 0; z < layout.rows; ++z) {
    TRY(resampled.row(z, row));
    std::ranges::transform(row, heights.begin(),
                           [&](double height_m) { return quantised(height_m - *zero_m); });
    writer->add_row(heights);
    note(imported, layout, cells, axes, z, heights);
    progress(0.4 + 0.6 * (z + 1) / layout.rows);
  }
  const auto header = TRY(writer->finish());
  imported.header = header;
  imported.bytes = writer->bytes();
  imported.nodata = found.nodata;
  imported.lowest_m = found.lowest_m;
  imported.highest_m = found.highest_m;
  say_cells(raster.shape(), how, imported);
  say_extent(axes.x, cells.x_m, sample_m, "wide", imported);
  say_extent(axes.z, cells.z_m, sample_m, "deep", imported);
  say_fill(raster.shape(), how, fill_m, imported);
  return imported;
}

std::vector<uint8_t> shaded_relief(const HeightsImported& imported) {
  const int columns = imported.preview_columns;
  const int rows = static_cast<int>(imported.preview_m.size()) / columns;
  const auto at = [&](int x, int z) {
    return imported
        .preview_m[static_cast<size_t>(std::clamp(z, 0, rows - 1) * columns + std::clamp(x, 0, columns - 1))];
  };
  std::vector<uint8_t> pixels;
  pixels.reserve(imported.preview_m.size());
  for (int z = 0; z < rows; ++z)
    for (int x = 0; x < columns; ++x) {
      const float east = (at(x + 1, z) - at(x - 1, z)) / (2.0F * imported.preview_cell_m);
      const float south = (at(x, z + 1) - at(x, z - 1)) / (2.0F * imported.preview_cell_m);
      const float light = (east + south + 1.4142F) / (2.0F * std::sqrt(east * east + south * south + 1.0F));
      pixels.push_back(static_cast<uint8_t>(255.0F * std::clamp(light, 0.0F, 1.0F)));
    }
  return pixels;
}

}  // namespace scree
