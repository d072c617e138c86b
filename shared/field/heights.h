// Ground by heights: an elevation model as square tiles of integer heights, and the surface through them.
//
// Level k of the pyramid has every 2^k-th sample of the model in x (east) and z (south), smoothed; a tile is
// a square of tile_samples² of them, and the coarsest level is one tile. The surface is the uniform cubic
// B-spline with the samples as its control points. Its curvature is continuous, so that cells larger than
// voxels show neither terraces nor creases. Its weights are not negative, so that it never leaves the span of
// the samples around. It has the samples' volume. It rounds a single sharp sample off. Beyond the model the
// ground goes on as high as at its edge: no side is open, and nothing can fall off.
//
// Doubles, but only + − × ÷, so that the bits are the same everywhere. Heights are in 1/256 m.
#pragma once

#include <array>
#include <compare>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "shared/base/result.h"
#include "shared/field/coord.h"

namespace scree {

/// Soil covers ground below the one height, ice above the other (material.h).
struct MaterialHeights {
  float soil_below_m = 0.0F;
  float ice_above_m = 0.0F;

  bool operator==(const MaterialHeights&) const = default;
};

inline constexpr int tile_samples = 128;
inline constexpr size_t tile_sample_count = size_t{tile_samples} * tile_samples;
inline constexpr int32_t height_steps_per_m = 256;

/// heights: a tile of an elevation model. bricks: a stored chunk (stored_chunks.h).
enum class TileKind : uint8_t { heights, bricks };

/// One tile: its column x and its row z on a level, both from 0; or a chunk of bricks, which has a y as well.
struct TileKey {
  int32_t level = 0;
  int32_t x = 0;
  int32_t z = 0;
  int32_t y = 0;
  TileKind kind = TileKind::heights;

  auto operator<=>(const TileKey&) const = default;
};

/// Samples of a tile, x fastest: index z · tile_samples + x. Those beyond the model repeat its edge.
struct HeightTile {
  std::array<int32_t, tile_sample_count> heights;

  static constexpr size_t index(int x, int z) {
    return static_cast<size_t>(z) * tile_samples + static_cast<size_t>(x);
  }
};

/// What is known of a model without its tiles. Sample (i, j) lies at x = (i − (columns − 1) / 2) · cell_m,
/// and with j and rows so at z.
struct HeightLayout {
  int32_t columns = 0;
  int32_t rows = 0;
  float cell_m = 0.0F;
  int32_t lowest = 0;  ///< of all samples
  int32_t highest = 0;
  MaterialHeights layers;

  bool operator==(const HeightLayout&) const = default;

  int levels() const;  ///< of the pyramid
  /// Samples and tiles along an axis of `count` samples on level 0.
  static int samples_on(int level, int count) { return ((count - 1) >> level) + 1; }
  static int tiles_on(int level, int count) {
    return (samples_on(level, count) + tile_samples - 1) / tile_samples;
  }
  bool holds(TileKey key) const;
  TileKey top() const { return {levels() - 1, 0, 0}; }
  size_t tiles() const;  ///< of all levels
  /// The tiles of the next finer level that `key` covers, at most four, in order; none on level 0.
  std::vector<TileKey> children(TileKey key) const;
  float half_width_m() const { return static_cast<float>(columns - 1) * 0.5F * cell_m; }  ///< in x
  float half_depth_m() const { return static_cast<float>(rows - 1) * 0.5F * cell_m; }     ///< in z
};

/// The tile of heights above that one.
constexpr TileKey parent_of(TileKey key) {
  return {key.level + 1, key.x >> 1, key.z >> 1};
}

/// Whether a layout from outside keeps the limits (limits.height_*), which bound all that is done with it.
Result<void> validate(const HeightLayout& layout);

/// An elevation model whose tiles come when they are needed: from a file, from memory, from a server. It is
/// immutable but for tiles that are still to come. Any thread may call.
class HeightModel {
 public:
  explicit HeightModel(const HeightLayout& layout) : layout_(layout) {}  ///< a valid one
  virtual ~HeightModel() = default;
  HeightModel(const HeightModel&) = delete;
  HeightModel& operator=(const HeightModel&) = delete;

  const HeightLayout& layout() const { return layout_; }
  /// Null while the tile is not there; then it is noted as missing. `key` is one of the layout's.
  virtual std::shared_ptr<const HeightTile> tile(TileKey key) const = 0;
  /// The tile as it is stored and sent (proto/height_codec.h); empty while it is not there.
  virtual std::vector<uint8_t> packed(TileKey key) const = 0;

 private:
  const HeightLayout layout_;
};

/// The tiles that decide the heights of a chunk's columns with an apron, for voxels of that size: of the
/// coarsest level whose samples are no farther apart than the voxels. At most four.
std::vector<TileKey> tiles_of(const HeightLayout& layout, ChunkCoord chunk, float voxel_size_m);

/// Heights in metres at the columns of voxels [x, x + side) × [z, z + side), x fastest. Where a tile is
/// missing, a coarser one stands in, and `exact` is false.
struct HeightPatch {
  std::vector<double> heights_m;
  bool exact = true;
  double lowest_m = 0.0;  ///< of all samples that take part: a bound
  double highest_m = 0.0;
};
HeightPatch heights_at(const HeightModel& model, int x, int z, int side, float voxel_size_m);

/// Height of the surface at a place, as heights_at() of voxels no larger than the samples' distance. Metres.
double height_at(const HeightModel& model, double x_m, double z_m);

}  // namespace scree
