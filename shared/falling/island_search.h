// Finds islands: solid terrain that a change cut off from the ground.
//
// Solid is a code < 0; voxels connect by faces; ground.h defines the ground. An island is a component that
// touches the changed bricks, or lies against their faces, and does not reach the ground. Loose terrain
// elsewhere, as generated or poured, stays until a change touches it.
//
// Two kinds of component count as ground without reaching it: those of more parts (one a brick, as a rule)
// than a search may follow, and those that hold a whole unedited chunk below the floor.
//
// Hierarchical: deep chunks are ground as a whole, and bricks are flooded 64 voxels at a time. All floods
// start at the change and grow in turn; a flood ends when it meets the ground, and two that meet become one.
// A flood goes down first, brick by brick from its lowest one. It goes sideways or up only where bricks were
// read anyway, or where it goes no deeper. So terrain that stands on the ground is known to stand after one
// column was read. So the cost depends on the size of the loose terrain and on the depth of the ground, not
// on the world. Deterministic, also in the order of the islands. Not thread-safe.
//
// What is read counts in bricks; an unedited chunk, whose terrain may have to be generated, counts besides as
// SearchLimits::bricks_per_chunk. Whether it was generated before makes no difference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "shared/base/limits.h"
#include "shared/falling/ground.h"
#include "shared/falling/holding.h"
#include "shared/field/brick_bits.h"
#include "shared/field/field.h"

namespace scree {

/// An island, or a block of one that is longer than a piece may be.
struct Island {
  VoxelBox box;      ///< smallest that holds its solid voxels
  VoxelCoord start;  ///< the first of them, by x, y, z within the first brick
  int64_t voxels = 0;

  bool operator==(const Island&) const = default;
};

/// The largest block that falls in one piece.
struct BlockLimits {
  int side_bricks = limits::island_side_max_bricks;
  int bricks = 128;  ///< of its box: lifting takes 6 to 8 ms then
};

struct SearchLimits {
  size_t parts_max = SIZE_MAX;  ///< components of more parts count as ground
  size_t bricks_per_chunk = 0;  ///< as so many bricks counts an unedited chunk that may hold a surface
  const Holding* holding =
      nullptr;  ///< what it holds counts as ground; it outlives the search. Null: nothing
};

class IslandSearch {
 public:
  /// `changed`: bricks in any order. `field` must outlive this; none of the visited() bricks may change while
  /// the search runs.
  IslandSearch(Field& field, std::span<const BrickCoord> changed, const SearchLimits& limits = {});

  /// Reads about as much more as counts for `bricks`, and subtracts it; true when the search is finished. A
  /// step reads up to five bricks, in two chunks or three.
  bool advance(size_t& bricks);

  /// Whether the search has read this brick: if the brick changes, a new search must begin.
  bool visited(BrickCoord brick) const { return sites_.contains(brick); }
  /// After the end: whether it has searched all that a search around these bricks would begin with.
  bool knows(std::span<const BrickCoord> bricks) const;
  /// What was read since the beginning, in bricks.
  size_t read() const { return read_; }

  /// The islands of a finished search, ordered by start. An island over the limits is cut along the faces of
  /// bricks into blocks: halves along its longest side, halved again; each component of a block is one entry.
  std::vector<Island> islands(const BlockLimits& limits = {}) const;
  /// Number of components that count as ground because they have more than parts_max parts.
  size_t too_large() const;

 private:
  static constexpr uint32_t none = UINT32_MAX;
  enum class Verdict : uint8_t { open, ground, too_large, island };

  /// Solid voxels of one brick that a flood has reached.
  struct Part {
    BrickCoord brick;
    BrickBits bits;
    uint32_t flood = 0;
    uint32_t next = none;  ///< of the same brick
    uint8_t crossed = 0;   ///< bit i: face i of the brick
  };
  struct Site {
    BrickBits solid;
    uint32_t first = none;  ///< index of a Part
  };
  struct Flood {
    uint32_t parent = 0;
    Verdict verdict = Verdict::open;
    size_t parts = 0;
    /// Parts from which it did not go down yet, and those from which it did, but not yet to all sides: heaps,
    /// the lowest on top.
    std::vector<uint32_t> ahead, aside;
  };

  Site& site(BrickCoord brick);
  BrickBits claimed_bits(const Site& site) const;
  void add_floods(BrickCoord brick, BrickBits among);
  void begin(std::span<const BrickCoord> changed);
  bool is_later(uint32_t a, uint32_t b) const;
  void push(std::vector<uint32_t>& heap, uint32_t part) const;
  uint32_t pop(std::vector<uint32_t>& heap) const;
  uint32_t root(uint32_t flood) const;
  void add_part(BrickCoord brick, const BrickBits& bits, uint32_t flood);
  uint32_t unite(uint32_t a, uint32_t b);
  void grow(uint32_t flood);
  void cross(uint32_t part, size_t face);
  std::vector<uint32_t> parts_of_islands() const;

  Field& field_;
  Ground ground_;
  SearchLimits limits_;
  /// A pool for sites_: a search of 60,000 bricks that must begin again is thrown away within a tick.
  std::pmr::monotonic_buffer_resource memory_;
  std::pmr::unordered_map<BrickCoord, Site, CoordHash> sites_{&memory_};
  std::unordered_set<ChunkCoord, CoordHash> chunks_;  ///< unedited, with sites
  size_t read_ = 0;
  std::vector<Part> parts_;
  std::vector<Flood> floods_;
  std::vector<uint32_t> open_;  ///< floods; those that ended are taken out when their turn comes
  size_t turn_ = 0;
};

}  // namespace scree
