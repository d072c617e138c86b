#include "shared/field/heights.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "shared/base/check.h"
#include "shared/base/limits.h"

namespace scree {

namespace {

/// Voxels around a chunk whose heights take part in its codes (terrain.cpp, apron).
constexpr int chunk_apron = 4;

/// Beyond this many samples from the model's middle, all are those of its edge.
constexpr double sample_far = 1.0e6;

int whole_below(double value) {
  const int whole = static_cast<int>(value);
  return value < static_cast<double>(whole) ? whole - 1 : whole;
}

/// Where a coordinate lies among a level's samples along one axis.
struct Place {
  int first;         ///< the first of four samples; may lie outside
  double weight[4];  /// of each
};

Place place_of(double metres, float cell_m, int count, int level) {
  const double at = metres / static_cast<double>(cell_m) + static_cast<double>(count - 1) * 0.5;
  const double u = std::clamp(at / static_cast<double>(1 << level), -sample_far, sample_far);
  const int whole = whole_below(u);
  const double t = u - static_cast<double>(whole), s = 1.0 - t;
  constexpr double sixth = 1.0 / 6.0;
  return {whole - 1,
          {s * s * s * sixth, (3.0 * t * t * t - 6.0 * t * t + 4.0) * sixth,
           (3.0 * s * s * s - 6.0 * s * s + 4.0) * sixth, t * t * t * sixth}};
}

/// The samples that voxels [first, first + count) read along one axis, clamped to the model: lo to hi.
struct Span {
  int lo;
  int hi;
  std::vector<Place> places;
};

Span span_of(int first, int count, float voxel_size_m, float cell_m, int samples, int level) {
  Span span{0, 0, {}};
  const int last = HeightLayout::samples_on(level, samples) - 1;
  for (int i = 0; i < count; ++i)
    span.places.push_back(
        place_of(static_cast<double>(first + i) * static_cast<double>(voxel_size_m), cell_m, samples, level));
  span.lo = std::clamp(span.places.front().first, 0, last);
  span.hi = std::clamp(span.places.back().first + 3, 0, last);
  return span;
}

/// The coarsest level whose samples are no farther apart than that.
int level_for(const HeightLayout& layout, float voxel_size_m) {
  int level = 0;
  while (level + 1 < layout.levels() && layout.cell_m * static_cast<float>(2 << level) <= voxel_size_m)
    ++level;
  return level;
}

/// A level's samples in a rectangle, read tile by tile.
class Samples {
 public:
  Samples(const HeightModel& model, int level, const Span& x, const Span& z)
      : x_(x.lo),
        z_(z.lo),
        width_(x.hi - x.lo + 1),
        values_(static_cast<size_t>(width_ * (z.hi - z.lo + 1))) {
    for (int tz = z.lo / tile_samples; tz <= z.hi / tile_samples; ++tz)
      for (int tx = x.lo / tile_samples; tx <= x.hi / tile_samples; ++tx) {
        const std::shared_ptr<const HeightTile> tile = model.tile({level, tx, tz});
        if (tile == nullptr) {
          complete_ = false;
          continue;
        }
        const int x0 = std::max(x.lo, tx * tile_samples),
                  x1 = std::min(x.hi, tx * tile_samples + tile_samples - 1);
        const int z0 = std::max(z.lo, tz * tile_samples),
                  z1 = std::min(z.hi, tz * tile_samples + tile_samples - 1);
        for (int j = z0; j <= z1; ++j)
          for (int i = x0; i <= x1; ++i)
            at(i, j) = tile->heights[HeightTile::index(i - tx * tile_samples, j - tz * tile_samples)];
      }
  }

  bool complete() const { return complete_; }
  const std::vector<int32_t>& values() const { return values_; }
  int rows() const { return static_cast<int>(values_.size()) / width_; }
  /// Places outside read the nearest one.
  double value(int i, int row) const {
    return static_cast<double>(
        values_[static_cast<size_t>(row * width_ + std::clamp(i - x_, 0, width_ - 1))]);
  }
  int row_of(int j) const { return std::clamp(j - z_, 0, rows() - 1); }

 private:
  int32_t& at(int i, int j) { return values_[static_cast<size_t>((j - z_) * width_ + (i - x_))]; }

  int x_;
  int z_;
  int width_;
  std::vector<int32_t> values_;
  bool complete_ = true;
};

/// Along x for every row of samples, then along z.
HeightPatch interpolate(const Samples& samples, const Span& x, const Span& z) {
  constexpr double metres = 1.0 / height_steps_per_m;
  const size_t width = x.places.size();
  std::vector<double> along_x(width * static_cast<size_t>(samples.rows()));
  for (int row = 0; row < samples.rows(); ++row)
    for (size_t i = 0; i < width; ++i) {
      const Place& at = x.places[i];
      double sum = 0.0;
      for (int k = 0; k < 4; ++k) sum += at.weight[k] * samples.value(at.first + k, row);
      along_x[static_cast<size_t>(row) * width + i] = sum * metres;
    }
  HeightPatch patch;
  patch.heights_m.reserve(width * z.places.size());
  for (const Place& at : z.places) {
    size_t row[4];
    for (int k = 0; k < 4; ++k) row[k] = static_cast<size_t>(samples.row_of(at.first + k)) * width;
    for (size_t i = 0; i < width; ++i)
      patch.heights_m.push_back(at.weight[0] * along_x[row[0] + i] + at.weight[1] * along_x[row[1] + i] +
                                at.weight[2] * along_x[row[2] + i] + at.weight[3] * along_x[row[3] + i]);
  }
  const auto [least, most] = std::ranges::minmax(samples.values());
  patch.lowest_m = static_cast<double>(least) * metres;
  patch.highest_m = static_cast<double>(most) * metres;
  return patch;
}

/// Nothing when a tile is missing.
std::optional<HeightPatch> patch_of(const HeightModel& model, int level, const Span& x, const Span& z) {
  const Samples samples(model, level, x, z);
  if (!samples.complete()) return std::nullopt;
  return interpolate(samples, x, z);
}

}  // namespace

int HeightLayout::levels() const {
  int levels = 1;
  while (samples_on(levels - 1, std::max(columns, rows)) > tile_samples) ++levels;
  return levels;
}

bool HeightLayout::holds(TileKey key) const {
  return key.kind == TileKind::heights && key.y == 0 && key.level >= 0 && key.level < levels() &&
         key.x >= 0 && key.z >= 0 && key.x < tiles_on(key.level, columns) &&
         key.z < tiles_on(key.level, rows);
}

size_t HeightLayout::tiles() const {
  size_t sum = 0;
  for (int level = 0; level < levels(); ++level)
    sum += static_cast<size_t>(tiles_on(level, columns)) * static_cast<size_t>(tiles_on(level, rows));
  return sum;
}

std::vector<TileKey> HeightLayout::children(TileKey key) const {
  std::vector<TileKey> children;
  for (int i = 0; i < 4 && key.level > 0; ++i) {
    const TileKey child{key.level - 1, key.x * 2 + (i & 1), key.z * 2 + (i >> 1)};
    if (holds(child)) children.push_back(child);
  }
  return children;
}

Result<void> validate(const HeightLayout& layout) {
  const auto side = [](int count) { return count >= 2 && count <= limits::height_samples_max; };
  if (!side(layout.columns) || !side(layout.rows))
    return fail("an elevation model of " + std::to_string(layout.columns) + " × " +
                std::to_string(layout.rows) + " samples: 2 to " + std::to_string(limits::height_samples_max) +
                " a side are possible (limits.height_samples_max)");
  if (!(layout.cell_m >= limits::height_cell_min_m && layout.cell_m <= limits::height_cell_max_m))
    return fail("cells of the elevation model must be " + std::to_string(limits::height_cell_min_m) + " to " +
                std::to_string(limits::height_cell_max_m) +
                " m wide (limits.height_cell_min_m, height_cell_max_m)");
  if (layout.half_width_m() > limits::world_half_width_m ||
      layout.half_depth_m() > limits::world_half_width_m)
    return fail("the elevation model is wider than a world, " +
                std::to_string(static_cast<int>(2.0F * limits::world_half_width_m)) +
                " m (limits.world_half_width_m)");
  constexpr auto most = static_cast<int32_t>(limits::height_max_m) * height_steps_per_m;
  if (layout.lowest > layout.highest || layout.lowest < -most || layout.highest > most)
    return fail("heights must lie within ± " + std::to_string(static_cast<int>(limits::height_max_m)) +
                " m (limits.height_max_m)");
  if (!std::isfinite(layout.layers.soil_below_m) || !std::isfinite(layout.layers.ice_above_m))
    return fail("the heights of soil and ice must be numbers");
  return {};
}

std::vector<TileKey> tiles_of(const HeightLayout& layout, ChunkCoord chunk, float voxel_size_m) {
  const int level = level_for(layout, voxel_size_m);
  const VoxelCoord first = first_voxel(chunk);
  const auto span = [&](int voxel, int samples) {
    const auto at = [&](int v) {
      return place_of(static_cast<double>(v) * static_cast<double>(voxel_size_m), layout.cell_m, samples,
                      level)
          .first;
    };
    const int last = HeightLayout::samples_on(level, samples) - 1;
    return std::pair(std::clamp(at(voxel - chunk_apron), 0, last) / tile_samples,
                     std::clamp(at(voxel + chunk_size + chunk_apron) + 3, 0, last) / tile_samples);
  };
  const auto [x0, x1] = span(first.x, layout.columns);
  const auto [z0, z1] = span(first.z, layout.rows);
  std::vector<TileKey> keys;
  for (int z = z0; z <= z1; ++z)
    for (int x = x0; x <= x1; ++x) keys.push_back({level, x, z});
  return keys;
}

HeightPatch heights_at(const HeightModel& model, int x, int z, int side, float voxel_size_m) {
  const HeightLayout& layout = model.layout();
  const int wanted = level_for(layout, voxel_size_m);
  for (int level = wanted; level < layout.levels(); ++level) {
    const Span along_x = span_of(x, side, voxel_size_m, layout.cell_m, layout.columns, level);
    const Span along_z = span_of(z, side, voxel_size_m, layout.cell_m, layout.rows, level);
    if (std::optional<HeightPatch> patch = patch_of(model, level, along_x, along_z)) {
      patch->exact = level == wanted;
      return *std::move(patch);
    }
  }
  // Nothing has come yet: level ground, as low as any.
  const double low_m = static_cast<double>(layout.lowest) / height_steps_per_m;
  const auto count = static_cast<size_t>(side) * static_cast<size_t>(side);
  return {std::vector<double>(count, low_m), false, low_m, low_m};
}

double height_at(const HeightModel& model, double x_m, double z_m) {
  const HeightLayout& layout = model.layout();
  for (int level = 0; level < layout.levels(); ++level) {
    const auto span = [&](double metres, int samples) {
      const int last = HeightLayout::samples_on(level, samples) - 1;
      const Place place = place_of(metres, layout.cell_m, samples, level);
      return Span{std::clamp(place.first, 0, last), std::clamp(place.first + 3, 0, last), {place}};
    };
    if (const auto patch = patch_of(model, level, span(x_m, layout.columns), span(z_m, layout.rows)))
      return patch->heights_m.front();
  }
  return static_cast<double>(layout.lowest) / height_steps_per_m;
}

}  // namespace scree
