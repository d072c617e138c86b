// The field: every voxel of the world, of which only the edited bricks are stored.
//
// Reading any brick always answers: edited ones from the store, others generated and cached. Not thread-safe.
// Invariant: hash() is the sum of brick_hash over the edited bricks, with what they are painted; chunk_hash
// the same of one chunk.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "shared/field/material.h"
#include "shared/field/terrain.h"
#include "shared/field/window.h"

namespace scree {

/// As brick.h's; a brick that is painted has another hash than one that is not.
uint64_t brick_hash(BrickCoord coord, const Brick& brick, std::optional<Material> paint);

class Field {
 public:
  explicit Field(const TerrainSource& source);
  virtual ~Field() = default;
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;

  const TerrainSource& source() const { return source_; }

  /// The reference holds until the next call that is not const.
  const Brick& brick(BrickCoord coord);
  /// As generated, whether edited since or not; same lifetime.
  const Brick& generated_brick(BrickCoord coord);
  /// Bit i of `edited`: brick i of the chunk is. The same lifetime as brick()'s.
  struct ChunkBricks {
    const GeneratedChunk& generated;
    uint64_t edited;
  };
  ChunkBricks chunk_bricks(ChunkCoord chunk);
  bool is_edited(BrickCoord coord) const { return find_edited(coord) != nullptr; }
  /// Whether any brick of the chunk is edited.
  bool has_edits(ChunkCoord chunk) const { return edited_.contains(chunk); }
  /// Marks the brick as edited, even when the codes are those generated.
  void set_brick(BrickCoord coord, const Brick& brick);
  /// What the brick is painted, if anything.
  std::optional<Material> painted(BrickCoord coord) const;
  /// Paints the brick, or takes its paint off; marks it as edited. Its codes stay.
  void paint_brick(BrickCoord coord, std::optional<Material> paint);
  /// Forgets the edits of a chunk: it reads as generated again.
  void forget_chunk(ChunkCoord chunk);

  uint64_t hash() const { return hash_; }
  uint64_t chunk_hash(ChunkCoord chunk) const;
  /// Edited chunks, in order; and one's edited bricks, in order.
  std::vector<ChunkCoord> edited_chunks() const;
  std::vector<BrickCoord> edited_bricks(ChunkCoord chunk) const;

  /// Hands over a chunk that another thread generated, so that brick() need not.
  void adopt_generated(ChunkCoord chunk, GeneratedChunk generated);
  bool has_generated(ChunkCoord chunk) const { return generated_.contains(chunk); }
  /// How many it keeps; it drops them all at limits::generated_chunks_max.
  size_t generated_chunks() const { return generated_.size(); }

 protected:
  virtual const Brick* find_edited(BrickCoord coord) const = 0;
  virtual void store_edited(BrickCoord coord, const Brick& brick) = 0;
  virtual void erase_edited(BrickCoord coord) = 0;

 private:
  struct EditedChunk {
    uint64_t hash = 0;
    uint64_t bricks = 0;            ///< bit i: brick i of the chunk is edited
    std::map<int, Material> paint;  ///< by index in the chunk
  };
  /// The chunk that was asked for last: most questions in a row are about the same one.
  struct LastChunk {
    ChunkCoord coord;
    uint64_t edited;  ///< as EditedChunk::bricks
    const GeneratedChunk* generated;
  };
  const GeneratedChunk& generated_chunk(ChunkCoord chunk);
  void forget_generated();
  LastChunk& last_chunk(ChunkCoord chunk);

  TerrainSource source_;
  std::unordered_map<ChunkCoord, GeneratedChunk, CoordHash> generated_;
  std::unordered_map<ChunkCoord, EditedChunk, CoordHash> edited_;
  std::optional<LastChunk> last_;
  uint64_t hash_ = 0;
};

/// A field whose edited bricks lie in a hash map: the client's, and the tests'.
class MapField final : public Field {
 public:
  using Field::Field;

 protected:
  const Brick* find_edited(BrickCoord coord) const override;
  void store_edited(BrickCoord coord, const Brick& brick) override;
  void erase_edited(BrickCoord coord) override;

 private:
  struct Slot {
    const Brick* brick;
    std::unique_ptr<Brick> own;  ///< null when `brick` is one of the shared uniform ones
  };
  std::unordered_map<BrickCoord, Slot, CoordHash> slots_;
};

/// Copies a box of voxels out of the field.
Window gather(Field& field, const VoxelBox& box);

/// Writes a window back; bricks whose codes do not change are left alone. Returns the changed ones, in order.
std::vector<BrickCoord> scatter(Field& field, const Window& window);

/// Trilinear distance and gradient at a point (voxels); gradient is not normalised, zero where the codes
/// saturate.
struct FieldSample {
  float distance_voxels;
  glm::vec3 gradient;
};
FieldSample sample(Field& field, glm::vec3 p_voxels);

/// Sphere traces from `from` (voxels) along unit `direction`; the distance to the surface in voxels, or
/// nothing within `reach_voxels`. Starts inside rock: 0.
std::optional<float> trace(Field& field, glm::vec3 from_voxels, glm::vec3 direction, float reach_voxels);

}  // namespace scree
