// The bodies of a search for spans (spans.h): the thin terrain that connects to a change, as far as it goes
// until it meets what holds it. Parts are the components inside each brick; parts that lie on each other are
// one body as long as it is no higher than a beam, so that a beam's section is never divided.
//
// What holds: ground (ground.h), and massive rock, which is part of a cube of 2³ full bricks and hangs
// together with many such bricks or with ground. So does a part that lies on it and carries nothing wider.
// Lengths in voxels. Not thread-safe.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

#include "shared/falling/ground.h"
#include "shared/falling/holding.h"
#include "shared/field/brick_bits.h"
#include "shared/material/palette.h"

namespace scree {

struct SpanPart {
  static constexpr uint32_t none = UINT32_MAX;

  BrickCoord brick;
  BrickBits bits;
  const Brick* codes = nullptr;
  int voxels = 0;
  double density_kg_m3 = 0.0;  ///< mean over its voxels, as the bending that they bear
  double bending_pa = 0.0;
  uint32_t next = none;  ///< next part of the same brick
  uint32_t body = none;  ///< none: not reached
  bool holds = false;
};

struct SpanBody {
  std::vector<uint32_t> parts;
  bool holds = false;
  bool is_massive = false;  ///< full bricks that hold: no section in them is looked at
  glm::dvec3 centre{0.0};
  int64_t voxels = 0;
};

/// Two parts that touch, `upper` beyond the + face of `lower` along the axis.
struct SpanContact {
  uint32_t lower = 0, upper = 0;
  int axis = 0;
};

class SpanBodies {
 public:
  /// What connects to the changed bricks, or to bricks beside them. Parts beyond `parts_max` hold.
  /// `field` and `palette` must outlive this. `holding`: what it holds holds, too; null: nothing.
  SpanBodies(const Field& field, const Palette& palette, std::span<const BrickCoord> changed,
             size_t parts_max, const Holding* holding = nullptr);

  const std::vector<SpanPart>& parts() const { return parts_; }
  const std::vector<SpanBody>& bodies() const { return bodies_; }
  /// Between different bodies, of which one at least does not hold.
  const std::vector<SpanContact>& contacts() const { return contacts_; }
  /// Those of any brick; valid as long as this.
  const Brick& codes(BrickCoord brick) { return *entry(brick).codes; }
  /// Bricks that were read: a measure of the cost.
  size_t bricks_read() const { return bricks_.size(); }

 private:
  enum class Known : uint8_t { unknown, no, yes };
  struct Entry {
    Brick own;
    const Brick* codes = nullptr;
    BrickBits solid;
    bool is_full = false;
    Known ground = Known::unknown, massive = Known::unknown, holds = Known::unknown;
    bool divided = false;
    uint32_t first = SpanPart::none;
  };

  Entry& entry(BrickCoord brick);
  bool is_ground(BrickCoord brick);
  bool is_massive(BrickCoord brick);
  bool brick_holds(BrickCoord brick);
  uint32_t first_part(BrickCoord brick);
  void read_materials(SpanPart& part) const;
  bool lies_on_what_holds(uint32_t part);
  void reach(uint32_t part);
  void expand(uint32_t part);
  void connect(uint32_t part);
  void stack();
  void make_bodies();

  const Field& field_;
  const Palette& palette_;
  Ground ground_;
  size_t parts_max_;
  const Holding* holding_;
  std::unordered_map<BrickCoord, Entry, CoordHash> bricks_;  ///< looked up, never walked through
  std::map<ChunkCoord, bool> ground_chunks_;
  std::vector<SpanPart> parts_;
  std::vector<uint32_t> free_;   ///< parts, in the order in which they were reached
  std::vector<uint32_t> stack_;  ///< by part: the first part of its stack
  std::vector<SpanBody> bodies_;
  std::vector<SpanContact> contacts_;
};

}  // namespace scree
