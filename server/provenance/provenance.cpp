#include "server/provenance/provenance.h"

#include <algorithm>
#define XXH_INLINE_ALL
#include <xxhash.h>

#include "server/provenance/no_origin.h"
#include "shared/base/check.h"
#include "shared/base/overloaded.h"
#include "shared/operation/ledger.h"

namespace scree {

namespace {

uint64_t hash_of(const MassPlace& place, const OriginShare& share) {
  std::vector<uint64_t> words{place.at.index(), row_number(place.material), share.origin.region,
                              share.origin.party, static_cast<uint64_t>(share.mass)};
  const auto put = [&](auto number) { words.push_back(static_cast<uint64_t>(number)); };
  std::visit(Overloaded{[&](const TerrainPlace& at) {
                          for (const int32_t axis : {at.brick.x, at.brick.y, at.brick.z}) put(axis);
                          put(at.region);
                          put(at.rubble);
                        },
                        [&](const PiecePlace& at) { put(at.piece); },
                        [&](const StorePlace& at) {
                          put(at.store.kind);
                          put(at.store.number);
                          for (const char letter : at.store.name) put(letter);
                        },
                        [](const DustPlace&) {}, [](const NoPlace&) {}},
             place.at);
  return XXH3_64bits(words.data(), words.size() * sizeof(uint64_t));
}

/// The member of a row that counts what lies at a place.
MassUnits RegionMass::*member_of(const MassPlace& place, const MassOrigin& origin) {
  return std::visit(Overloaded{[&](const TerrainPlace& at) {
                                 return at.region == origin.region ? &RegionMass::back : &RegionMass::away;
                               },
                               [](const PiecePlace&) { return &RegionMass::pieces; },
                               [](const StorePlace&) { return &RegionMass::carried; },
                               [](const DustPlace&) { return &RegionMass::dust; },
                               [](const NoPlace&) { return &RegionMass::away; }},
                    place.at);
}

bool is_terrain(const MassPlace& place) {
  return std::holds_alternative<TerrainPlace>(place.at);
}

}  // namespace

bool Provenance::has_terrain(const VoxelBox& box) const {
  if (terrain_places_ == 0 || box.empty()) return false;
  const BrickCoord lo = brick_of(box.lo), hi = brick_of(box.hi - VoxelCoord{1, 1, 1});
  for (int x = lo.x; x <= hi.x; ++x)
    for (int y = lo.y; y <= hi.y; ++y) {
      const auto next = places_.lower_bound(MassPlace{TerrainPlace{.brick = {x, y, lo.z}}, Material{}});
      if (next == places_.end() || !is_terrain(next->first)) return false;
      const BrickCoord brick = std::get<TerrainPlace>(next->first.at).brick;
      if (brick.x == x && brick.y == y && brick.z <= hi.z) return true;
    }
  return false;
}

bool Provenance::has_piece(PieceId piece) const {
  const auto next = places_.lower_bound(MassPlace{PiecePlace{piece}, Material{}});
  if (next == places_.end()) return false;
  const auto* const found = std::get_if<PiecePlace>(&next->first.at);
  return found != nullptr && found->piece == piece;
}

bool Provenance::has_dust() const {
  const auto next = places_.lower_bound(MassPlace{DustPlace{}, Material{}});
  return next != places_.end() && std::holds_alternative<DustPlace>(next->first.at);
}

MassOrigin Provenance::origin_of(RegionId region, uint64_t party) const {
  const MassOrigin origin{region, party};
  return origins_.contains(origin) || origins_.size() < limits::origins_max ? origin : MassOrigin{region, 0};
}

RegionMass& Provenance::row(const MassOrigin& origin, Material material) {
  RegionMass& row = rows_[{origin, material}];
  row.origin = origin;
  row.material = material;
  return row;
}

void Provenance::cut(const MassOrigin& origin, Material material, MassUnits mass) {
  CHECK(mass > 0 && origin.region != 0);
  origins_.insert(origin);
  row(origin, material).cut += mass;
}

void Provenance::leave_material(const OriginShares& shares, Material material) {
  for (const OriginShare& share : shares) row(share.origin, material).cut -= share.mass;
}

void Provenance::enter_material(const OriginShares& shares, Material material) {
  for (const OriginShare& share : shares) row(share.origin, material).cut += share.mass;
}

void Provenance::change(const MassPlace& place, const OriginShare& share, int sign) {
  hash_ += static_cast<uint64_t>(static_cast<int64_t>(sign)) * hash_of(place, share);
  if (share.origin == no_origin) return;
  row(share.origin, place.material).*member_of(place, share.origin) += sign * share.mass;
  changed_ = true;
}

void Provenance::put(const MassPlace& place, const OriginShares& shares) {
  if (shares.empty()) return;
  auto found = places_.find(place);
  if (found == places_.end()) {
    if (is_terrain(place)) {
      if (terrain_places_ >= limits::origin_places_max) return put({NoPlace{}, place.material}, shares);
      ++terrain_places_;
    }
    found = places_.try_emplace(place).first;
  }
  for (const OriginShare& share : found->second) change(place, share, -1);
  add(found->second, shares);
  for (const OriginShare& share : found->second) change(place, share, 1);
}

OriginShares Provenance::take(const MassPlace& place, MassUnits part, MassUnits whole) {
  const auto found = places_.find(place);
  if (found == places_.end() || part == 0) return {};
  for (const OriginShare& share : found->second) change(place, share, -1);
  OriginShares taken = take_part(found->second, part, whole);
  for (const OriginShare& share : found->second) change(place, share, 1);
  if (!found->second.empty()) return taken;
  if (is_terrain(place)) --terrain_places_;
  places_.erase(found);
  return taken;
}

OriginShares Provenance::take_all(const MassPlace& place) {
  const auto found = places_.find(place);
  if (found == places_.end()) return {};
  const MassUnits all = sum_of(found->second);
  return take(place, all, all);
}

std::vector<std::pair<MassPlace, OriginShares>> Provenance::take_brick(BrickCoord brick) {
  std::vector<std::pair<MassPlace, OriginShares>> taken;
  for (;;) {
    const auto next = places_.lower_bound(MassPlace{TerrainPlace{.brick = brick}, Material{}});
    if (next == places_.end() || !is_terrain(next->first)) return taken;
    const MassPlace place = next->first;
    if (std::get<TerrainPlace>(place.at).brick != brick) return taken;
    taken.emplace_back(place, take_all(place));
  }
}

std::vector<BrickCoord> Provenance::bricks() const {
  std::vector<BrickCoord> bricks;
  for (const auto& [place, shares] : places_) {
    if (!is_terrain(place)) break;
    const BrickCoord brick = std::get<TerrainPlace>(place.at).brick;
    if (bricks.empty() || bricks.back() != brick) bricks.push_back(brick);
  }
  return bricks;
}

void Provenance::bound_dust(Material material, MassUnits most) {
  const MassPlace dust{DustPlace{}, material};
  const auto found = places_.find(dust);
  if (found == places_.end()) return;
  const MassUnits known = sum_of(found->second);
  if (known > most) put({NoPlace{}, material}, take(dust, known - most, known));
}

void Provenance::forget(RegionId region) {
  std::vector<PlacedMass> kept = value();
  const size_t forgotten =
      std::erase_if(kept, [&](const PlacedMass& placed) { return placed.share.origin.region == region; });
  if (forgotten > 0) restore(kept);
}

std::vector<RegionMass> Provenance::masses() const {
  std::vector<RegionMass> masses;
  for (const auto& [key, row] : rows_) {
    CHECK_EQ(row.error(), 0);
    if (row.cut > 0) masses.push_back(row);
  }
  return masses;
}

std::shared_ptr<const std::vector<RegionMass>> Provenance::take_changed() {
  if (!std::exchange(changed_, false)) return nullptr;
  return std::make_shared<const std::vector<RegionMass>>(masses());
}

std::vector<PlacedMass> Provenance::value() const {
  std::vector<PlacedMass> placed;
  for (const auto& [place, shares] : places_)
    for (const OriginShare& share : shares) placed.push_back({place, share});
  return placed;
}

void Provenance::restore(const std::vector<PlacedMass>& placed) {
  *this = Provenance();
  for (const auto& [place, share] : placed) {
    if (share.origin != no_origin) cut(share.origin, place.material, share.mass);
    put(place, {share});
  }
  changed_ = true;
}

Result<void> validate(const std::vector<PlacedMass>& placed) {
  MassUnits sum = 0;
  size_t terrain = 0;
  std::set<MassOrigin> origins;
  for (size_t i = 0; i < placed.size(); ++i) {
    const auto& [place, share] = placed[i];
    const auto* const terrain_at = std::get_if<TerrainPlace>(&place.at);
    const bool may_be = share.origin.region != 0 ||
                        (share.origin == no_origin && terrain_at != nullptr && terrain_at->region != 0);
    if (!may_be || share.mass <= 0 || share.mass > limits::ledger_mass_max - sum)
      return fail("mass of an origin is of no region, less than nothing, or more than there is");
    sum += share.mass;
    origins.insert(share.origin);
    const bool is_new = i == 0 || !(placed[i - 1].place == place);
    if (is_new && is_terrain(place)) ++terrain;
    if (i > 0 && (is_new ? !(placed[i - 1].place < place) : !(placed[i - 1].share.origin < share.origin)))
      return fail("masses of origins are not in order");
  }
  if (terrain > limits::origin_places_max || origins.size() > limits::origins_max)
    return fail("mass of more origins, or at more places, than a world remembers");
  return {};
}

}  // namespace scree
