// The bricks around the camera on one level of detail: for each brick of a box that moves with the camera,
// its slot of the atlas, or the distance to the nearest brick that is not empty. No GL.
//
// Storage is toroidal: a brick's entry lies at its coordinate modulo the box, so that a move rewrites only
// the entries that enter. Invariant after settle(): every empty brick's distance is the exact Chebyshev
// distance, in bricks, to the nearest brick of the box that is not empty, capped at empty_distance_max.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "client/render/levels/atlas_brick.h"
#include "shared/field/coord.h"

namespace scree {

/// Largest stored distance: one more than the bricks that a ray can skip at once.
inline constexpr int empty_distance_max = 16;

/// As the shaders read it (client/shaders/bricks.glsl).
struct ClipEntry {
  enum Kind : uint32_t { unloaded = 0, stored = 254, solid = 255 };  ///< between: empty, the distance

  uint32_t field = 0;   ///< kind << 24 | slot z << 16 | y << 8 | x
  uint32_t before = 0;  ///< the generated field: kind << 24, and the slot of a mixed brick
  /// How all of a stored brick looks, shown | bare << 8; or looks_mixed << 24 and a slot of the looks'
  /// atlas.
  uint32_t looks = 0;
  /// Where faces meet, edge_eighths() << 24 and a slot of the planes' atlas; else 0.
  uint32_t planes = 0;

  static constexpr uint32_t looks_mixed = 1;

  /// The kind of `before`: nothing was edited, so it is the field itself; or all air, or all rock, or a
  /// brick.
  enum BeforeKind : uint32_t { same = 0, mixed = 1, air = 2, rock = 3 };

  uint32_t kind() const { return field >> 24U; }
  bool has_before_slot() const { return before >> 24U == mixed; }
  bool has_looks_slot() const { return looks >> 24U == looks_mixed; }
  bool has_planes_slot() const { return planes != 0; }
  /// Edited, or of looks of its own.
  bool is_touched() const { return before != 0 || looks != 0; }
  bool is_empty() const { return kind() != unloaded && kind() < stored; }
  static uint32_t packed(uint32_t kind, AtlasSlot slot) {
    return kind << 24U | static_cast<uint32_t>(slot.z) << 16U | static_cast<uint32_t>(slot.y) << 8U | slot.x;
  }
  static AtlasSlot slot_of(uint32_t packed) {
    return {static_cast<uint8_t>(packed), static_cast<uint8_t>(packed >> 8U),
            static_cast<uint8_t>(packed >> 16U)};
  }
  bool operator==(const ClipEntry&) const = default;
};

/// An empty brick whose distance settle() finds.
inline constexpr uint32_t clip_empty = 1U << 24U;

class ClipWindow {
 public:
  /// Bricks along x and z: a power of two, 8 … 64; half as many along y.
  explicit ClipWindow(int side);

  int side() const { return side_; }
  int height() const { return side_ / 2; }
  BrickCoord origin() const { return origin_; }
  bool holds(BrickCoord brick) const;

  /// Moves the box; `left` is called for the entries that fall out, which are unloaded from then on. The
  /// first call only places it.
  void move_to(BrickCoord origin, const std::function<void(const ClipEntry&)>& left);

  /// The brick must be held.
  const ClipEntry& at(BrickCoord brick) const { return entries_[index(brick)]; }
  void set(BrickCoord brick, ClipEntry entry);

  /// Updates the distances around the entries changed since the last call, up to empty_distance_max away.
  void settle();

  /// Entries of one step along x, as they are uploaded: z fastest, then y; toroidal. Calls f(x, entries) for
  /// those changed since the last time.
  template <typename F>
  void drain_changed_slabs(F&& f) {
    for (int x = 0; x < side_; ++x) {
      if (!changed_[static_cast<size_t>(x)]) continue;
      changed_[static_cast<size_t>(x)] = false;
      f(x, &entries_[static_cast<size_t>(x) * slab()]);
    }
  }
  /// How many entries are.
  size_t touched() const { return touched_; }
  size_t bytes() const { return entries_.size() * sizeof(ClipEntry) + occupied_.size() * sizeof(uint64_t); }

 private:
  /// A range of columns, relative to the origin; hi outside.
  struct Columns {
    int lo_x, lo_y, hi_x, hi_y;
  };

  size_t slab() const { return static_cast<size_t>(side_) * static_cast<size_t>(height()); }
  size_t index(BrickCoord brick) const;
  uint64_t& row(int x, int y) { return occupied_[static_cast<size_t>(x * height() + y)]; }
  void write(size_t at, ClipEntry entry);
  void note(int x, int y);
  std::vector<uint64_t> dilated(const std::vector<uint64_t>& rows, const Columns& within) const;
  void write_distances(uint64_t bits, int x, int y, uint32_t distance);

  int side_;
  BrickCoord origin_;
  bool placed_ = false;
  std::vector<ClipEntry> entries_;
  std::vector<uint64_t> occupied_;  ///< a row of bits along z for each (x, y); relative to the origin
  size_t touched_ = 0;
  Columns dirty_{};
  bool anything_dirty_ = false;
  std::vector<bool> changed_;  ///< slabs
};

}  // namespace scree
