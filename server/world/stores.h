// What was dug and not placed since, by owner. Part of a world's state: its sum is the ledger's.
//
// A store is there while it has mass, or while what was dug into it counts for the rate of digging. That is
// a bucket: what is dug goes in, and a second's worth runs out in a second; who has more in it than that has
// to wait. Whole units and ticks alone, so that it is the same on every machine.
#pragma once

#include <map>
#include <set>

#include "server/formats/world_value.h"
#include "shared/operation/store.h"

namespace scree {

class Stores {
 public:
  struct Store {
    MaterialMasses masses;
    MassUnits dug = 0;  ///< that counts still, as of that tick
    Tick dug_at = 0;
  };

  const std::map<StoreName, Store>& all() const { return stores_; }
  bool contains(const StoreName& store) const { return stores_.contains(store); }
  /// Null: there is none.
  const Store* find(const StoreName& store) const;
  /// What the store has of a material, and of all.
  MassUnits mass_of(const StoreName& store, Material material) const;
  MassUnits mass_of(const StoreName& store) const;

  void put(const StoreName& store, std::span<const MaterialMass> masses);
  /// The store must have as much.
  void take(const StoreName& store, Material material, MassUnits mass);
  /// Moves all that the store has to another.
  void move_all(const StoreName& from, const StoreName& to);

  /// Forgets a store, which has nothing.
  void drop(const StoreName& store);

  /// What of the mass that was dug into the store counts still at that tick, of which so much ceases to in a
  /// tick: `units` in `ticks`.
  struct Rate {
    MassUnits units = 0;
    Tick ticks = 1;
  };
  MassUnits counting(const StoreName& store, Tick now, const Rate& rate) const;
  /// So much was dug into the store.
  void count(const StoreName& store, MassUnits mass, Tick now, const Rate& rate);

  /// Forgets stores that have nothing, and of which nothing counts.
  void tidy(Tick now, const Rate& rate);

  /// The stores whose masses changed since, in order; those that have none are gone.
  std::vector<StoreContent> take_changed();
  std::vector<StoreContent> contents() const;
  /// The sum of all masses.
  MassUnits mass() const;
  MaterialMasses masses() const;
  /// 0 where there is no store.
  uint64_t hash() const;

  std::vector<StoreRecord> value() const;
  void restore(const std::vector<StoreRecord>& records);

 private:
  std::map<StoreName, Store> stores_;
  std::set<StoreName> changed_;
};

}  // namespace scree
