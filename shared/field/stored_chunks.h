// Ground by bricks: chunks of codes that a ground stores, caves and overhangs included. They stand on an
// elevation model, which may be level: a stored chunk takes the place of the model's, and everywhere else the
// ground is the model's, air above its surface and rock below.
//
// They are an octree: a chunk of level k has voxels 2^k times as large, and the bricks of level k + 1 show
// those of level k from afar. Above the coarsest level stands a root, which stores no bricks; each tile names
// those below it that are stored, so that the tile above tells whether there is one.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "shared/field/generated_chunk.h"
#include "shared/field/heights.h"

namespace scree {

/// Where the chunks lie that may be stored: a half-open box of chunks of level 0, whose voxels are of the
/// world's size.
struct BrickLayout {
  float voxel_size_m = 0.0F;
  ChunkCoord lo;
  ChunkCoord hi;

  bool operator==(const BrickLayout&) const = default;

  int levels() const;  ///< of chunks; the root's is the next
  TileKey root() const { return {levels(), 0, 0, 0, TileKind::bricks}; }
  bool holds(TileKey key) const;
  /// The eight places below, in order of x, y and z; those that lie outside are not held.
  std::array<TileKey, 8> children(TileKey key) const;
  TileKey parent(TileKey key) const;
  /// The box's height, metres.
  float bottom_m() const { return static_cast<float>(lo.y * chunk_size) * voxel_size_m; }
  float top_m() const { return static_cast<float>(hi.y * chunk_size) * voxel_size_m; }
};

inline TileKey key_of(int level, ChunkCoord chunk) {
  return {level, chunk.x, chunk.z, chunk.y, TileKind::bricks};
}
inline ChunkCoord chunk_of(TileKey key) {
  return {key.x, key.y, key.z};
}

/// Whether a layout from outside keeps the limits.
Result<void> validate(const BrickLayout& layout);

/// What is known of a place: whether a chunk is stored there, and if so, which one.
struct ChunkLookup {
  bool known = true;
  std::shared_ptr<const GeneratedChunk> chunk{};
};

/// An elevation model and, if there are any, stored chunks. As HeightModel, in all that it says.
class GroundModel : public HeightModel {
 public:
  explicit GroundModel(const HeightLayout& heights, const std::optional<BrickLayout>& bricks = std::nullopt)
      : HeightModel(heights), bricks_(bricks) {}

  const std::optional<BrickLayout>& bricks() const { return bricks_; }
  /// Not known while a tile that tells is not there; then it is noted as missing. `key`: one that bricks()
  /// holds.
  virtual ChunkLookup chunk(TileKey) const { return {}; }
  /// Whether there is such a tile, of either kind; of a model whose tiles are still to come: whether it has.
  virtual bool has(TileKey key) const { return layout().holds(key); }

 private:
  const std::optional<BrickLayout> bricks_;
};

/// The tile of a stored chunk, for voxels of that size, or the one that tells that it is not stored; nothing
/// where none can be. For a model that is complete.
std::optional<TileKey> stored_tile_of(const GroundModel& model, ChunkCoord chunk, float voxel_size_m);

/// The key that a chunk of voxels of that size is stored by; nothing where none can be.
std::optional<TileKey> stored_key(const GroundModel& model, ChunkCoord chunk, float voxel_size_m);

}  // namespace scree
