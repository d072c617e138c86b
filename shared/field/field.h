// The field: every voxel of the world, of which only the edited bricks are stored.
//
// Any brick can be read: edited ones come from the store, others are generated and cached. A field may be a
// layer over another one: what was edited in the layer is the layer's, all else reads as the one below does,
// as that stands at the time. A field that is no layer, and has none over it, may leave chunks out of memory
// (paging.h).
// A const function changes no code and no material. It may still generate ground, keep it, and bring chunks
// in, so a field is not thread-safe, not even for reading. Its parts: GeneratedCache (unedited chunks that
// are kept), GroundMaterialCache (their materials) and ChunkResidence (which edited chunks are in memory).
// The field itself has the edits: their bits, materials and hashes. Invariants: hash() is the sum of
// brick_hash over the edited bricks with their materials, chunk_hash() the same sum over one chunk; bricks
// whose materials were changed are edited ones.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "shared/field/brick_patch.h"
#include "shared/field/chunk_residence.h"
#include "shared/field/generated_cache.h"
#include "shared/field/ground_layers.h"
#include "shared/field/ground_materials.h"
#include "shared/field/paging.h"
#include "shared/field/terrain.h"
#include "shared/field/window.h"
#include "shared/material/rubble.h"

namespace scree {

class Field {
 public:
  explicit Field(const TerrainSource& source);
  /// A layer over that field, which must outlive it; not null. Chunks are generated, and kept, below.
  explicit Field(const Field* below);
  virtual ~Field() = default;
  Field(const Field&) = delete;
  Field& operator=(const Field&) = delete;

  const TerrainSource& source() const { return source_; }

  const RubbleRows& rubble() const { return *source_.rubble; }

  /// The codes of a brick. The reference stays valid until the next brick is read, or the field changes.
  const Brick& brick(BrickCoord coord) const;
  /// The codes as generated, whether the brick was edited since or not; same lifetime.
  const Brick& generated_brick(BrickCoord coord) const;
  /// A chunk as generated, and which of its bricks are edited: bit i of `edited` for brick i. Same lifetime.
  struct ChunkBricks {
    const GeneratedChunk& generated;
    uint64_t edited;
  };
  ChunkBricks chunk_bricks(ChunkCoord chunk) const;
  bool is_edited(BrickCoord coord) const {
    return ((edited_bits(chunk_of(coord)) >> index_in_chunk(coord)) & 1U) != 0;
  }
  /// Whether any brick of the chunk is edited.
  bool has_edits(ChunkCoord chunk) const { return edited_bits(chunk) != 0; }
  /// Marks the brick as edited, even when the codes are those generated.
  void set_brick(BrickCoord coord, const Brick& brick) { write_brick(coord, brick, nullptr); }
  /// The same, and changes what its voxels say.
  void set_brick(BrickCoord coord, const Brick& brick, const BrickMaterials& materials) {
    write_brick(coord, brick, &materials);
  }
  /// From now on bricks are noted there as they were before they are written; null: no more.
  void note_replaced(std::vector<BrickPatch>* to) { replaced_ = to; }
  /// What the brick's voxels say of their materials; ground_own of all where nobody changed any.
  BrickMaterials materials(BrickCoord coord) const;
  /// Changes what they say, and marks the brick as edited. Its codes stay.
  void set_materials(BrickCoord coord, const BrickMaterials& materials);
  /// The ground's own materials there (ground_materials.h): no voxel says ground_own. The reference stays
  /// valid until the next call, or the field changes: copy what is kept.
  const BrickMaterials& ground_materials(BrickCoord coord) const;
  /// What decides the materials of a chunk's bricks, for those who read many: what bricks say, by their index
  /// (null: none says anything), and what the ground has (null: its bulk alone). Nothing where it takes more
  /// than that to tell. Same lifetime as brick().
  struct ChunkRock {
    const std::map<int, BrickMaterials>* said = nullptr;
    const PackedChunkMaterials* ground = nullptr;

    bool is_bulk() const { return said == nullptr && ground == nullptr; }
  };
  std::optional<ChunkRock> chunk_rock(ChunkCoord chunk) const;
  /// Forgets the edits of a chunk: it reads as generated again. Not of a layer.
  void forget_chunk(ChunkCoord chunk);

  /// A layer's are right as long as the bricks beneath its own stand as they were.
  uint64_t hash() const { return below_ == nullptr ? hash_ : below_->hash() + hash_; }
  uint64_t chunk_hash(ChunkCoord chunk) const;
  /// The chunks with edited bricks, and the edited bricks of one chunk, both in order.
  std::vector<ChunkCoord> edited_chunks() const;
  std::vector<BrickCoord> edited_bricks(ChunkCoord chunk) const;

  /// Takes a chunk that another thread generated, so that brick() need not generate it. One that is not exact
  /// is as none, and brick() makes it anew once it can be (is_here).
  void adopt_generated(ChunkCoord chunk, GeneratedChunk generated) const;
  bool has_generated(ChunkCoord chunk) const;
  /// The same, and it counts as used.
  bool touch_generated(ChunkCoord chunk) const;
  /// Generated chunks that are kept, and what they take in memory. Those that were not used while half of
  /// generated_bytes_max() was filled are dropped.
  size_t generated_chunks() const;
  size_t generated_bytes() const;
  size_t generated_bytes_max() const { return generated_owner().generated_.bytes_max(); }
  /// `bytes` is positive, and at most limits::generated_bytes_max, which holds at first.
  void bound_generated(size_t bytes);
  size_t edited_brick_count() const {
    return below_ == nullptr ? edited_bricks_ : below_->edited_brick_count() + edited_bricks_;
  }

  /// From now on edited chunks may be out; `read` gives their bricks. A read or write of a chunk that is out
  /// waits for `read`. It throws ChunkUnreadable when that fails, or gives other bricks than were dropped.
  void page_by(ReadChunk read);
  bool pages() const { return residence_.pages(); }
  /// Drops the codes and materials of an edited chunk that is in.
  void page_out(ChunkCoord chunk);
  /// Puts back what was read of a chunk that is out. False, and nothing changes, when it is something else.
  [[nodiscard]] bool page_in(ChunkCoord chunk, std::span<const BrickPatch> bricks);
  /// Enters a chunk without edits as one that is out.
  void add_out(ChunkCoord chunk, const PagedChunk& left);
  bool is_out(ChunkCoord chunk) const;
  /// What is left of a chunk; nothing when it is in, or not edited.
  std::optional<PagedChunk> paged(ChunkCoord chunk) const;
  /// A turn is a tick: begins the next, so that idle_chunks() knows which chunks nobody asked for lately.
  void begin_turn();
  /// Chunks that are in, and that nobody read or wrote for at least so many turns, the longest idle first.
  std::vector<ChunkCoord> idle_chunks(uint64_t turns) const;
  bool is_idle(ChunkCoord chunk, uint64_t turns) const;
  /// As if somebody had asked for a chunk that is in now: it is not idle.
  void touch(ChunkCoord chunk);
  /// In a field that pages: the edited chunks in memory, in any order, and the number of their edited bricks.
  const ChunkResidence::Chunks& chunks_in() const { return residence_.chunks(); }
  size_t bricks_in() const { return residence_.bricks(); }
  size_t chunks_out() const { return edited_.size() - residence_.chunks().size(); }
  /// Times that somebody waited for a chunk that was out.
  uint64_t page_waits() const { return residence_.waits(); }

 protected:
  /// As find_edited() of the field below; null when there is none.
  const Brick* find_below(BrickCoord coord) const {
    return below_ == nullptr ? nullptr : below_->find_edited(coord);
  }
  virtual const Brick* find_edited(BrickCoord coord) const = 0;
  virtual void store_edited(BrickCoord coord, const Brick& brick) = 0;
  virtual void erase_edited(BrickCoord coord) = 0;
  /// Says what is edited of a chunk, where a derived field keeps the bricks elsewhere and never writes: bit i
  /// for brick i, Σ brick_hash of these, and what they say of their materials. Not of a layer.
  void mark_chunk(ChunkCoord chunk, uint64_t bricks, uint64_t hash, std::map<int, BrickMaterials> materials);
  /// No brick of the chunk is stored any more.
  virtual void chunk_left(ChunkCoord /*chunk*/) {}

 private:
  struct EditedChunk {
    uint64_t hash = 0;
    uint64_t bricks = 0;                      ///< bit i: brick i of the chunk is edited
    std::map<int, BrickMaterials> materials;  ///< by index in the chunk; none is all of the ground
    bool out = false;
    MassUnits mass = 0;         ///< of a chunk that is out
    mutable uint64_t used = 0;  ///< turn in which somebody asked for it last
  };
  /// The chunk of the last call: most calls in a row are about the same one.
  struct LastChunk {
    ChunkCoord coord;
    uint64_t edited;  ///< as EditedChunk::bricks
    const GeneratedChunk* generated;
  };
  /// The field that keeps the generated chunks.
  const Field& generated_owner() const { return below_ == nullptr ? *this : below_->generated_owner(); }
  uint64_t edited_bits(ChunkCoord chunk) const;
  bool may_be_layered(ChunkCoord chunk) const;
  const GeneratedChunk& generated_chunk(ChunkCoord chunk) const;
  /// Forgets the last call's chunk if the cache has dropped chunks since.
  void heed_drops() const;
  LastChunk& last_chunk(ChunkCoord chunk) const;
  /// Null materials: what its voxels say stays.
  void write_brick(BrickCoord coord, const Brick& brick, const BrickMaterials* materials);
  /// Notes that somebody asks for the chunk, and brings it in if it is out.
  void use(ChunkCoord chunk, const EditedChunk& edited) const;
  void bring_in(ChunkCoord chunk, const ReadChunk& read);
  void enter(ChunkCoord chunk, EditedChunk& edited, std::span<const BrickPatch> bricks);

  TerrainSource source_;
  const Field* below_ = nullptr;                  ///< of a layer
  mutable GeneratedCache generated_;              ///< of a layer empty: the field below keeps them
  mutable GroundMaterialCache ground_materials_;  ///< likewise
  GroundLayers layers_{source_};
  BrickMaterials bulk_ = layers_.bulk();
  mutable uint64_t drops_heeded_ = 0;  ///< of generated_
  std::unordered_map<ChunkCoord, EditedChunk, CoordHash> edited_;
  mutable std::optional<LastChunk> last_;  ///< none in a layer: the field below changes without its knowledge
  size_t edited_bricks_ = 0;
  uint64_t hash_ = 0;
  ChunkResidence residence_;
  std::vector<BrickPatch>* replaced_ = nullptr;  ///< not owned
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
Window gather(const Field& field, const VoxelBox& box);

/// Writes a window back. Returns the bricks whose codes changed, in order; the others are left alone.
std::vector<BrickCoord> scatter(Field& field, const Window& window);
/// The same, and changes what bricks' voxels say to what `said` returns for them, where it returns something:
/// another thing than they say.
std::vector<BrickCoord> scatter(Field& field, const Window& window,
                                const std::function<const BrickMaterials*(BrickCoord)>& said);

/// Trilinear distance and gradient at a point (voxels); gradient is not normalised, zero where the codes
/// saturate.
struct FieldSample {
  float distance_voxels;
  glm::vec3 gradient;
};
FieldSample sample(const Field& field, glm::vec3 p_voxels);

/// Distance in voxels from a point (voxels) along a direction of unit length to the surface, by sphere
/// tracing (Hart 1996); nothing when the ray meets none within `distance_max_voxels`; 0 when it starts inside
/// rock.
std::optional<float> trace(const Field& field, glm::vec3 from_voxels, glm::vec3 direction,
                           float distance_max_voxels);

}  // namespace scree
