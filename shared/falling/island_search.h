// Finds islands: solid terrain that a change cut off from the ground.
//
// Solid is a code < 0; voxels connect by faces; ground is what ground.h says. An island is a component that
// touches the changed bricks, or lies against their faces, and does not reach the ground. What hangs in the
// air elsewhere, as generated or poured, stays until a change touches it.
//
// Two things count as ground without reaching it: components of more parts, one for each brick as a rule,
// than a search is told to follow, and those that hold a whole unedited chunk below the floor.
//
// Hierarchical: deep chunks are ground as a whole, bricks flood 64 voxels at a time, only faces meet. All
// floods start at the change and grow at once, each from its lowest brick; a flood ends when it meets the
// ground or another, so the cost depends on what hangs loose and on how deep the ground lies, not on the
// world. Deterministic; the order of the islands too. Not thread-safe.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "shared/base/limits.h"
#include "shared/falling/ground.h"
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

/// What may fall in one piece.
struct BlockLimits {
  int side_bricks = limits::island_side_max_bricks;
  int bricks = 256;  ///< of its box: lifting takes 13 ms then
};

class IslandSearch {
 public:
  /// `changed`: bricks in any order. `field` must outlive this, and hold still while it runs: see visited().
  /// Components of more than `parts_max` parts count as ground.
  IslandSearch(Field& field, std::span<const BrickCoord> changed, size_t parts_max = SIZE_MAX);

  /// Looks at up to `bricks` more bricks; true when the search is finished. What it took is subtracted.
  bool advance(size_t& bricks);

  /// Whether the search has read this brick: if it changes, the search must start afresh.
  bool visited(BrickCoord brick) const { return sites_.contains(brick); }
  size_t bricks_visited() const { return sites_.size(); }

  /// Of a finished search, ordered by start. An island over the limits comes in blocks: halves along its
  /// longest side, halved again, cut along the faces of bricks; what connects within a block is one entry.
  std::vector<Island> islands(const BlockLimits& limits = {}) const;
  /// Components that count as ground because there is too much of them.
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
  };
  struct Site {
    BrickBits solid;
    uint32_t first = none;  ///< index of a Part
  };
  struct Flood {
    uint32_t parent = 0;
    Verdict verdict = Verdict::open;
    size_t parts = 0;
    std::vector<uint32_t> ahead;  ///< parts to go on from: a heap, the lowest on top
  };

  Site& site(BrickCoord brick);
  BrickBits taken(const Site& site) const;
  void add_floods(BrickCoord brick, BrickBits among);
  void begin(std::span<const BrickCoord> changed);
  bool is_later(uint32_t a, uint32_t b) const;
  uint32_t root(uint32_t flood) const;
  void add_part(BrickCoord brick, const BrickBits& bits, uint32_t flood);
  uint32_t unite(uint32_t a, uint32_t b);
  void grow(uint32_t flood);
  void cross(uint32_t part, size_t face);
  std::vector<uint32_t> parts_of_islands() const;

  Field& field_;
  Ground ground_;
  size_t parts_max_;
  std::unordered_map<BrickCoord, Site, CoordHash> sites_;
  std::vector<Part> parts_;
  std::vector<Flood> floods_;
  std::vector<uint32_t> open_;  ///< floods; those that ended are taken out when their turn comes
  size_t turn_ = 0;
};

}  // namespace scree
