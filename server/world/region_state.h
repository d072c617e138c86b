// The regions of a world (shared/region/region.h), and what hangs on those that forbid falls.
//
// Terrain that a region touches counts as standing on the ground for every search, so that it does not fall,
// nor break off by its weight. Which chunks such terrain was found in is remembered: when the region is over,
// they are searched again, some in each tick (release_terrain in region_requests.h).
//
// Invariants: ids ascend, and names differ. Not thread-safe. Metres.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "server/formats/world_value.h"
#include "server/provenance/region_zones.h"
#include "shared/falling/holding.h"
#include "shared/region/region.h"

namespace scree {

/// Says of terrain whether a region that forbids falls touches it, and notes where one did.
class RegionHolding final : public Holding {
 public:
  explicit RegionHolding(float voxel_size_m) : voxel_size_m_(voxel_size_m) {}

  bool holds(BrickCoord brick, const BrickBits& bits) const override;

  /// Changes the regions, all of which forbid falls.
  void set(std::vector<Region> regions) {
    regions_ = std::move(regions);
    near_.clear();
  }
  bool empty() const { return regions_.empty(); }
  /// The bricks that were held since it was asked last, and by which region.
  std::vector<std::pair<RegionId, BrickCoord>> take_noted() { return std::exchange(noted_, {}); }

 private:
  using Numbers = std::vector<uint32_t>;
  /// Those of the regions that meet a chunk.
  const Numbers& near(ChunkCoord chunk) const;

  float voxel_size_m_;
  std::vector<Region> regions_;
  mutable std::unordered_map<ChunkCoord, Numbers, CoordHash> near_;  ///< as far as they were asked for
  mutable std::vector<std::pair<RegionId, BrickCoord>> noted_;
};

class WorldRegions {
 public:
  explicit WorldRegions(float voxel_size_m)
      : voxel_size_m_(voxel_size_m),
        zones_({}, voxel_size_m),
        holding_(std::make_unique<RegionHolding>(voxel_size_m)) {}

  const std::vector<Region>& all() const { return *all_; }
  /// The same, to be shared: it never changes.
  std::shared_ptr<const std::vector<Region>> shared() const { return all_; }
  bool empty() const { return all_->empty(); }
  /// Sum of the hashes of all (state_hash.h); 0: there are none.
  uint64_t hash() const { return hash_; }
  /// Whether one forbids any of these.
  bool forbid_any(uint8_t what) const { return (forbidden_ & what) != 0; }
  bool tell() const { return tells_; }
  /// Those that count.
  const RegionZones& zones() const { return zones_; }
  const Region* named(std::string_view name) const;

  /// Adds a region, whose id is new and the highest, or takes the place of the one with its id.
  void set(Region region);
  void remove(RegionId id);

  /// The first region that forbids any of this and that meets the shape; null: none does.
  const Region* forbidding(uint8_t what, const Shape& shape) const;
  const Region* forbidding(uint8_t what, glm::vec3 place_m) const;
  const Region* forbidding(uint8_t what, const VoxelBox& box) const;

  /// What regions hold; null where none does.
  const Holding* holding() const { return holding_->empty() ? nullptr : holding_.get(); }
  /// Remembers where searches met what a region holds, since it was asked last.
  void remember_held();
  /// The same of one search: its own bricks are remembered if it met any such terrain.
  void remember_held(std::span<const BrickCoord> searched);
  /// Up to limits::hung_chunks_max chunks of a region.
  void remember(RegionId region, BrickCoord brick);

  /// Chunks that hang on a region. Those of a region that is over await their search in `released`.
  std::map<RegionId, std::set<ChunkCoord>> hung;
  std::set<ChunkCoord> released;
  /// Bodies whose middles lie in regions that tell, with the tags of props; of each region by id, in a list:
  /// every tick goes through all of them.
  struct BodyInside {
    PieceId id = 0;
    uint64_t tag = 0;
  };
  std::map<RegionId, std::vector<BodyInside>> inside;

 private:
  void changed(std::vector<Region> regions);

  float voxel_size_m_;
  std::shared_ptr<const std::vector<Region>> all_ = std::make_shared<const std::vector<Region>>();
  uint64_t hash_ = 0;
  uint8_t forbidden_ = 0;
  bool tells_ = false;
  RegionZones zones_;
  std::unique_ptr<RegionHolding> holding_;  ///< searches that go on point to it
};

}  // namespace scree
