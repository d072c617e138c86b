#include "server/world/stores.h"

#include <algorithm>
#include <utility>

#include "server/world/state_hash.h"
#include "shared/base/check.h"

namespace scree {

const Stores::Store* Stores::find(const StoreName& store) const {
  const auto found = stores_.find(store);
  return found == stores_.end() ? nullptr : &found->second;
}

MassUnits Stores::mass_of(const StoreName& store, Material material) const {
  const Store* const found = find(store);
  return found == nullptr ? 0 : scree::mass_of(found->masses, material);
}

MassUnits Stores::mass_of(const StoreName& store) const {
  const Store* const found = find(store);
  return found == nullptr ? 0 : sum_of(found->masses);
}

void Stores::put(const StoreName& store, std::span<const MaterialMass> masses) {
  CHECK(store.kind != StoreKind::own);
  if (masses.empty()) return;
  MaterialMasses& to = stores_[store].masses;
  for (const MaterialMass& one : masses) {
    CHECK(one.mass >= 0);
    if (one.mass > 0) add(to, one.material, one.mass);
  }
  changed_.insert(store);
}

void Stores::take(const StoreName& store, Material material, MassUnits mass) {
  if (mass == 0) return;
  take_out(stores_.at(store).masses, material, mass);
  changed_.insert(store);
}

void Stores::move_all(const StoreName& from, const StoreName& to) {
  CHECK(!(from == to));
  const auto found = stores_.find(from);
  if (found == stores_.end() || found->second.masses.empty()) return;
  const MaterialMasses masses = std::exchange(found->second.masses, {});
  changed_.insert(from);
  put(to, masses);
}

void Stores::drop(const StoreName& store) {
  CHECK_EQ(mass_of(store), 0);
  stores_.erase(store);
}

MassUnits Stores::counting(const StoreName& store, Tick now, const Rate& rate) const {
  const Store* const found = find(store);
  if (found == nullptr || found->dug == 0) return 0;
  CHECK(rate.ticks > 0 && rate.units >= 0 && now >= found->dug_at);
  const Tick passed = now - found->dug_at;
  // More ticks than it takes for all of it to cease.
  if (rate.units == 0 || passed / rate.ticks > static_cast<Tick>(found->dug / rate.units)) return 0;
  const MassUnits ceased =
      rate.units * static_cast<MassUnits>(passed / rate.ticks) +
      rate.units * static_cast<MassUnits>(passed % rate.ticks) / static_cast<MassUnits>(rate.ticks);
  return std::max<MassUnits>(0, found->dug - ceased);
}

void Stores::count(const StoreName& store, MassUnits mass, Tick now, const Rate& rate) {
  if (rate.units == 0) return;
  const MassUnits counts = counting(store, now, rate) + mass;
  Store& of = stores_[store];
  of.dug = counts;
  of.dug_at = now;
}

void Stores::tidy(Tick now, const Rate& rate) {
  std::erase_if(stores_, [&](const auto& one) {
    return one.second.masses.empty() && counting(one.first, now, rate) == 0;
  });
}

std::vector<StoreContent> Stores::take_changed() {
  std::vector<StoreContent> contents;
  for (const StoreName& name : changed_) {
    const Store* const store = find(name);
    contents.push_back({name, store == nullptr ? MaterialMasses() : store->masses});
  }
  changed_.clear();
  return contents;
}

std::vector<StoreContent> Stores::contents() const {
  std::vector<StoreContent> contents;
  for (const auto& [name, store] : stores_)
    if (!store.masses.empty()) contents.push_back({name, store.masses});
  return contents;
}

MassUnits Stores::mass() const {
  MassUnits sum = 0;
  for (const auto& [name, store] : stores_) sum += sum_of(store.masses);
  return sum;
}

MaterialMasses Stores::masses() const {
  MaterialMasses sum;
  for (const auto& [name, store] : stores_) add(sum, store.masses);
  return sum;
}

uint64_t Stores::hash() const {
  uint64_t sum = 0;
  for (const auto& [name, store] : stores_)
    sum += hash_of(StoreRecord{{name, store.masses}, store.dug, store.dug_at});
  return sum;
}

std::vector<StoreRecord> Stores::value() const {
  std::vector<StoreRecord> records;
  for (const auto& [name, store] : stores_)
    records.push_back({{name, store.masses}, store.dug, store.dug_at});
  return records;
}

void Stores::restore(const std::vector<StoreRecord>& records) {
  CHECK(stores_.empty());
  for (const StoreRecord& record : records)
    stores_[record.content.store] = {record.content.masses, record.dug, record.dug_at};
}

}  // namespace scree
