// Where the mass that was broken out of regions lies, by origin: the region's, and the party's that broke it.
// Part of a world's state, and derived: the operations of a world, in order, decide it (tracing.h).
//
// Mass is well mixed within a place: what leaves a place takes of every origin its part. A place is a piece,
// a store, all dust, or, of terrain, what one material has in a brick, apart by region and by whether it is
// rubble; of one material each. So it is exact to the unit which origins' mass is where, as far as places
// tell; within one, nobody can tell.
// Invariant: of each origin and material, all that lies in places is what was cut. Not thread-safe.
#pragma once

#include <map>
#include <memory>
#include <set>
#include <utility>
#include <variant>
#include <vector>

#include "server/provenance/origin_shares.h"
#include "shared/field/coord.h"
#include "shared/operation/store.h"

namespace scree {

namespace limits {
/// Places of terrain that hold mass with an origin. Beyond: such mass counts as terrain elsewhere, and is not
/// found again.
inline constexpr size_t origin_places_max = 65'536;
/// Origins of a world. Beyond: what is broken is the world's own doing (party 0).
inline constexpr size_t origins_max = 4'096;
}  // namespace limits

/// Terrain of a brick that lies in a region, 0: in none that counts.
struct TerrainPlace {
  BrickCoord brick;
  RegionId region = 0;
  bool rubble = false;

  auto operator<=>(const TerrainPlace&) const = default;
};
struct PiecePlace {
  PieceId piece = 0;

  auto operator<=>(const PiecePlace&) const = default;
};
struct StorePlace {
  StoreName store;

  bool operator==(const StorePlace&) const = default;
  bool operator<(const StorePlace& other) const { return store < other.store; }
};
struct DustPlace {
  auto operator<=>(const DustPlace&) const = default;
};
/// Terrain whose place is not remembered, and mass that a fill took away.
struct NoPlace {
  auto operator<=>(const NoPlace&) const = default;
};

/// A place, and the material there: of rubble that of its stones.
struct MassPlace {
  std::variant<TerrainPlace, PiecePlace, StorePlace, DustPlace, NoPlace> at;
  Material material{};

  bool operator==(const MassPlace&) const = default;
  bool operator<(const MassPlace& other) const {
    return at < other.at || (at == other.at && material < other.material);
  }
};

/// As it is kept: what of an origin lies at a place.
struct PlacedMass {
  MassPlace place;
  OriginShare share;

  bool operator==(const PlacedMass&) const = default;
};

class Provenance {
 public:
  /// Nothing is known of any mass.
  bool empty() const { return places_.empty(); }
  size_t terrain_places() const { return terrain_places_; }
  /// Whether any terrain in these bricks has an origin.
  bool has_terrain(const VoxelBox& box) const;
  bool has_piece(PieceId piece) const;
  bool has(const MassPlace& place) const { return places_.contains(place); }
  bool has_dust() const;

  /// The origin of what a party breaks in a region now.
  MassOrigin origin_of(RegionId region, uint64_t party) const;
  /// Mass that lies nowhere counts for another material from now on: as the ledger's `converted`.
  void leave_material(const OriginShares& shares, Material material);
  void enter_material(const OriginShares& shares, Material material);
  /// New mass of an origin, which the caller puts into places.
  void cut(const MassOrigin& origin, Material material, MassUnits mass);
  void put(const MassPlace& place, const OriginShares& shares);
  /// Takes a part of the mass at a place, as take_part() does.
  OriginShares take(const MassPlace& place, MassUnits part, MassUnits whole);
  OriginShares take_all(const MassPlace& place);
  /// The same of all materials of a brick, by place; it has none any more.
  std::vector<std::pair<MassPlace, OriginShares>> take_brick(BrickCoord brick);
  /// The bricks with terrain of an origin, in order.
  std::vector<BrickCoord> bricks() const;
  /// What there is of dust beyond these masses is not found again.
  void bound_dust(Material material, MassUnits most);
  /// Forgets a region, and all mass that came from it.
  void forget(RegionId region);

  /// By origin and material; a row for all that was cut.
  std::vector<RegionMass> masses() const;
  /// The same if it changed since it was asked last; else null.
  std::shared_ptr<const std::vector<RegionMass>> take_changed();
  /// 0 where nothing is known.
  uint64_t hash() const { return hash_; }

  std::vector<PlacedMass> value() const;
  /// Takes what was kept, which is valid.
  void restore(const std::vector<PlacedMass>& placed);

 private:
  using Key = std::pair<MassOrigin, Material>;

  void change(const MassPlace& place, const OriginShare& share, int sign);
  RegionMass& row(const MassOrigin& origin, Material material);

  std::map<MassPlace, OriginShares> places_;
  std::map<Key, RegionMass> rows_;
  std::set<MassOrigin> origins_;
  size_t terrain_places_ = 0;
  uint64_t hash_ = 0;
  bool changed_ = false;
};

/// Refuses what no world has: entries out of order, masses of nothing, more of anything than there can be.
Result<void> validate(const std::vector<PlacedMass>& placed);

}  // namespace scree
