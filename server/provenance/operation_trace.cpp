#include "server/provenance/operation_trace.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <tuple>

#include "server/provenance/no_origin.h"
#include "shared/base/check.h"

namespace scree {

namespace {

/// What lies at a place of terrain.
struct PlaceMass {
  MassPlace place;
  MassUnits mass = 0;
};

/// The mass of a brick by place, in no order; few.
std::vector<PlaceMass> masses_in(BrickCoord coord, const Brick& brick, const MaterialReader::BrickOf& rock,
                                 const RubbleRows& rows, const BrickZones& zones) {
  std::vector<PlaceMass> masses;
  const std::optional<Material> one = rock.uniform();
  for (size_t i = 0; i < brick.codes.size(); ++i) {
    const int occupied = occupancy(brick.codes[i]);
    if (occupied == 0) continue;
    const size_t row = row_number(one ? *one : rock.at(static_cast<int>(i)));
    const MassPlace place{TerrainPlace{coord, zones ? (*zones)[i] : 0, rows.fill[row] != fill_solid},
                          rows.stones[row]};
    auto found = std::ranges::find(masses, place, &PlaceMass::place);
    if (found == masses.end()) found = masses.insert(found, {place, 0});
    found->mass += mass_in_voxel(occupied, rows.fill[row]);
  }
  return masses;
}

std::vector<PlaceMass> masses_now(const TracedWorld& world, BrickCoord coord, const BrickZones& zones) {
  const Brick codes = world.field.brick(coord);
  const BrickMaterials says = world.field.materials(coord), ground = world.field.ground_materials(coord);
  return masses_in(coord, codes, {&says, &ground}, world.field.rubble(), zones);
}

/// The mass that a place of terrain had, and has.
struct PlaceChange {
  MassPlace place;
  MassUnits before = 0, after = 0;

  MassUnits lost() const { return before - after; }
  const TerrainPlace& terrain() const { return std::get<TerrainPlace>(place.at); }
};

std::vector<PlaceChange> changes_of(std::vector<PlaceMass> before, const std::vector<PlaceMass>& after) {
  std::vector<PlaceChange> changes;
  for (PlaceMass& one : before) changes.push_back({std::move(one.place), one.mass, 0});
  for (const PlaceMass& one : after) {
    auto found = std::ranges::find(changes, one.place, &PlaceChange::place);
    if (found == changes.end()) found = changes.insert(found, {one.place, 0, 0});
    found->after = one.mass;
  }
  std::ranges::sort(changes, std::less<>(), &PlaceChange::place);
  return changes;
}

/// Terrain that became rubble, or solid, where it lies takes its origins with it.
void change_in_place(std::vector<PlaceChange>& changes, Provenance& provenance) {
  for (PlaceChange& from : changes)
    for (PlaceChange& to : changes) {
      const bool same =
          from.terrain().region == to.terrain().region && from.place.material == to.place.material;
      const MassUnits mass = std::min(from.lost(), -to.lost());
      if (!same || mass <= 0) continue;
      provenance.put(to.place, provenance.take(from.place, mass, from.before));
      from.before -= mass;
      to.before += mass;
    }
}

/// Mass that a brick lost, of one material and region.
struct Loss {
  BrickCoord brick;
  RegionId region = 0;
  Material material{};
  MixedMass mass;

  auto key() const { return std::tie(brick, region, material); }
};

/// What a new piece is to get of a brick's loss, where that has as much.
struct Want {
  BrickCoord brick;
  RegionId region = 0;
  Material material{};
  PieceId piece = 0;
  MassUnits mass = 0;

  auto key() const { return std::tie(brick, region, material); }
  bool operator<(const Want& other) const {
    return std::tie(brick, region, material, piece) <
           std::tie(other.brick, other.region, other.material, other.piece);
  }
};

/// How much of a piece lies in which brick, in the terrain that it was cut from.
class WantMaker {
 public:
  explicit WantMaker(const RegionZones& zones) : zones_(zones) {}

  void add(PieceId id, const Volume& volume, std::vector<Want>& wants) {
    std::map<Part, MassUnits> parts;
    std::array<MassUnits, 256> sums{};
    Part last;
    MassUnits* sum = nullptr;
    const VoxelBox& box = volume.window.box;
    size_t index = 0;
    for (int x = box.lo.x; x < box.hi.x; ++x)
      for (int y = box.lo.y; y < box.hi.y; ++y)
        for (int z = box.lo.z; z < box.hi.z; ++z, ++index) {
          const int occupied = occupancy(volume.window.codes[index]);
          if (occupied == 0) continue;
          const Material material = volume.materials.at(index);
          const Part part{brick_of(VoxelCoord{x, y, z}), region_at({x, y, z}), material};
          if (sum == nullptr || part != last) sum = &parts[last = part];
          *sum += occupied;
          sums[row_number(material)] += occupied;
        }
    const MaterialMasses masses = masses_of(volume);
    for (const auto& [part, occupied] : parts) {
      const auto& [brick, region, material] = part;
      const auto share =
          static_cast<unsigned __int128>(mass_of(masses, material)) * static_cast<uint64_t>(occupied);
      const auto mass = static_cast<MassUnits>(share / static_cast<uint64_t>(sums[row_number(material)]));
      if (mass > 0) wants.push_back({brick, region, material, id, mass});
    }
  }

 private:
  using Part = std::tuple<BrickCoord, RegionId, Material>;

  RegionId region_at(VoxelCoord voxel) {
    const BrickCoord brick = brick_of(voxel);
    if (zones_of_ == nullptr || brick != brick_) {
      const auto [found, is_new] = known_.try_emplace(brick);
      if (is_new) found->second = zones_.of(brick);
      brick_ = brick;
      zones_of_ = &found->second;
    }
    return *zones_of_
               ? (**zones_of_)[static_cast<size_t>(Brick::index(voxel.x & 7, voxel.y & 7, voxel.z & 7))]
               : 0;
  }

  const RegionZones& zones_;
  std::map<BrickCoord, BrickZones> known_;
  BrickCoord brick_;
  const BrickZones* zones_of_ = nullptr;  ///< of brick_
};

/// What an operation moves: what was lost, and what is to be given, by material.
struct Flow {
  std::vector<Loss> losses;  ///< in order of bricks, regions and materials
  std::vector<PlaceMass> gains;
  std::map<Material, MixedMass> pools;
  std::map<std::pair<PieceId, Material>, MassUnits> wanted;  ///< by new pieces
  std::map<MassOrigin, MassUnits> cut;                       ///< of regions' own rock, and not given back yet
  bool builds = false;                                       ///< what is poured into a region is its own rock

  void lose(BrickCoord brick, RegionId region, Material material, MassUnits mass,
            const OriginShares& shares) {
    const Loss loss{brick, region, material, {}};
    auto place = std::ranges::lower_bound(losses, loss.key(), {}, &Loss::key);
    if (place == losses.end() || place->key() != loss.key()) place = losses.insert(place, loss);
    place->mass.pour(mass, shares);
  }

  void give(const MassPlace& place, MassUnits mass, Provenance& provenance) {
    if (mass != 0) provenance.put(place, pools[place.material].draw(mass));
  }
  /// Terrain that a region loses and gets in the same operation was not cut; what it gets besides is not its
  /// own.
  void give_terrain(const PlaceMass& gain, Provenance& provenance) {
    const RegionId region = std::get<TerrainPlace>(gain.place.at).region;
    OriginShares shares = pools[gain.place.material].draw(gain.mass);
    const MassUnits foreign = gain.mass - sum_of(shares);
    for (OriginShare& share : shares) {
      if (share.origin.region != region) continue;
      const MassUnits own = std::min(share.mass, cut[share.origin]);
      provenance.leave_material({{share.origin, own}}, gain.place.material);
      cut[share.origin] -= own;
      share.mass -= own;
    }
    std::erase_if(shares, [](const OriginShare& share) { return share.mass == 0; });
    if (region != 0 && !builds) add(shares, no_origin, foreign);
    provenance.put(gain.place, shares);
  }

  /// New pieces get of what they were cut out of.
  void give_near(const TracedWorld& world, const Applied& applied) {
    std::vector<Want> wants;
    WantMaker maker(world.zones);
    for (const CreatedPiece& created : applied.created)
      maker.add(created.id, *world.pieces.at(created.id), wants);
    std::ranges::sort(wants, std::less<>());
    for (const Want& want : wants) {
      const auto loss = std::ranges::lower_bound(losses, want.key(), {}, &Loss::key);
      if (loss == losses.end() || loss->key() != want.key()) continue;
      MassUnits& left = wanted[{want.piece, want.material}];
      const MassUnits mass = std::min({want.mass, loss->mass.total, left});
      world.provenance.put({PiecePlace{want.piece}, want.material}, loss->mass.draw(mass));
      left -= mass;
    }
  }

  /// What dust gives, and what counts for another material from now on.
  void level(const TracedWorld& world, const std::vector<MaterialLedger::Row>& before) {
    const std::vector<MaterialLedger::Row>& after = world.materials.rows();
    const auto row = [](const std::vector<MaterialLedger::Row>& rows, size_t i) {
      return i < rows.size() ? rows[i] : MaterialLedger::Row{};
    };
    MixedMass converted;
    for (size_t i = 0; i < after.size(); ++i) {
      const auto material = static_cast<Material>(i);
      const MassUnits dust = row(before, i).dust - after[i].dust;
      if (dust > 0)
        pools[material].pour(dust, world.provenance.take({DustPlace{}, material}, dust, row(before, i).dust));
    }
    for (size_t i = 0; i < after.size(); ++i) {
      const MassUnits mass = row(before, i).converted - after[i].converted;
      if (mass <= 0) continue;
      const auto material = static_cast<Material>(i);
      const OriginShares shares = pools[material].draw(mass);
      world.provenance.leave_material(shares, material);
      converted.pour(mass, shares);
    }
    for (size_t i = 0; i < after.size(); ++i) {
      const MassUnits mass = after[i].converted - row(before, i).converted;
      if (mass <= 0) continue;
      const auto material = static_cast<Material>(i);
      const OriginShares shares = converted.draw(mass);
      world.provenance.enter_material(shares, material);
      pools[material].pour(mass, shares);
    }
  }
};

/// A brick has changed: what it lost, and what it gains.
void take_brick(const TracedWorld& world, const TracedBrick& before, uint64_t party, Flow& flow) {
  Provenance& provenance = world.provenance;
  const BrickZones zones = world.zones.of(before.coord);
  const BrickMaterials ground = world.field.ground_materials(before.coord);
  std::vector<PlaceChange> changes =
      changes_of(masses_in(before.coord, before.codes, {&before.says, &ground}, world.field.rubble(), zones),
                 masses_now(world, before.coord, zones));
  change_in_place(changes, provenance);
  for (const PlaceChange& change : changes) {
    const auto& [place, had, has] = change;
    if (has > had) flow.gains.push_back({place, has - had});
    if (has >= had) continue;
    OriginShares shares = provenance.take(place, had - has, had);
    const RegionId region = change.terrain().region;
    const MassUnits own = had - has - sum_of(shares);
    drop_foreign(shares);
    if (region != 0 && own > 0) {
      const MassOrigin origin = provenance.origin_of(region, party);
      provenance.cut(origin, place.material, own);
      flow.cut[origin] += own;
      add(shares, origin, own);
    }
    flow.lose(before.coord, region, place.material, had - has, shares);
  }
}

}  // namespace

std::optional<OperationTrace> OperationTrace::begin(const TracedWorld& world, const Operation& operation,
                                                    const VoxelBox& reads, const StoreContent* store) {
  if (world.zones.empty() && world.provenance.empty()) return std::nullopt;
  const std::vector<PieceId> ended = pieces_ended_by(operation);
  const Provenance& known = world.provenance;
  const bool concerns = world.zones.meet(reads) || known.has_terrain(reads) ||
                        (known.has_dust() && pieces_merged_by(operation) > 0) ||
                        std::ranges::any_of(ended, [&](PieceId id) { return known.has_piece(id); }) ||
                        (store != nullptr && std::ranges::any_of(store->masses, [&](const MaterialMass& one) {
                           return known.has({StorePlace{store->store}, one.material});
                         }));
  if (!concerns) return std::nullopt;
  OperationTrace trace;
  for_each_brick(reads, [&](BrickCoord coord) {
    trace.bricks_.push_back({coord, world.field.brick(coord), world.field.materials(coord)});
  });
  for (const PieceId id : ended) trace.ended_.push_back({id, masses_of(*world.pieces.at(id))});
  trace.rows_ = world.materials.rows();
  if (store != nullptr) trace.store_ = *store;
  return trace;
}

void OperationTrace::finish(const TracedWorld& world, const Operation& operation, const Applied& applied,
                            uint64_t party) const {
  Provenance& provenance = world.provenance;
  Flow flow;
  flow.builds =
      std::holds_alternative<FillOperation>(operation) || std::holds_alternative<RestoreOperation>(operation);
  for (const BrickCoord coord : applied.changed) {
    const auto before = std::ranges::lower_bound(bricks_, coord, {}, &TracedBrick::coord);
    CHECK(before != bricks_.end() && before->coord == coord);
    take_brick(world, *before, party, flow);
  }
  for (const auto& [id, masses] : ended_)
    for (const auto& [material, mass] : masses)
      flow.pools[material].pour(mass, provenance.take_all({PiecePlace{id}, material}));
  for (const CreatedPiece& created : applied.created)
    for (const auto& [material, mass] : masses_of(*world.pieces.at(created.id)))
      flow.wanted[{created.id, material}] = mass;
  if (!parent_of(operation)) flow.give_near(world, applied);
  for (const Loss& loss : flow.losses) flow.pools[loss.material].pour(loss.mass.total, loss.mass.shares);
  for (const MaterialFlow& one : applied.flows) {
    MixedMass& pool = flow.pools[one.material];
    if (one.poured > 0) pool.pour(one.poured, {});
    if (one.stored >= 0) continue;
    CHECK(store_);
    pool.pour(-one.stored, provenance.take({StorePlace{store_->store}, one.material}, -one.stored,
                                           mass_of(store_->masses, one.material)));
  }
  flow.level(world, rows_);
  for (const auto& [whose, mass] : flow.wanted)
    flow.give({PiecePlace{whose.first}, whose.second}, mass, provenance);
  for (const PlaceMass& gain : flow.gains) flow.give_terrain(gain, provenance);
  for (const MaterialFlow& one : applied.flows) {
    CHECK(one.stored == 0 || store_);
    if (one.stored > 0) flow.give({StorePlace{store_->store}, one.material}, one.stored, provenance);
    if (one.poured < 0) flow.give({NoPlace{}, one.material}, -one.poured, provenance);
  }
  for (auto& [material, pool] : flow.pools) {
    flow.give({DustPlace{}, material}, pool.total, provenance);
    // A file may say of a place that it has more than there is.
    provenance.put({NoPlace{}, material}, pool.shares);
  }
}

void rezone(const TracedWorld& world, const RegionZones& before) {
  Provenance& provenance = world.provenance;
  for (const BrickCoord brick : provenance.bricks()) {
    const VoxelCoord first = first_voxel(brick);
    const VoxelBox box{first, first + VoxelCoord{brick_size, brick_size, brick_size}};
    if (!world.zones.meet(box) && !before.meet(box)) continue;
    std::vector<PlaceMass> masses = masses_now(world, brick, world.zones.of(brick));
    std::ranges::sort(masses, std::less<>(), &PlaceMass::place);
    using Whose = std::pair<Material, bool>;
    std::map<Whose, MixedMass> mixed;
    const auto whose = [](const MassPlace& place) {
      return Whose{place.material, std::get<TerrainPlace>(place.at).rubble};
    };
    for (const PlaceMass& one : masses) mixed[whose(one.place)].total += one.mass;
    for (const auto& [place, shares] : provenance.take_brick(brick)) add(mixed[whose(place)].shares, shares);
    for (const PlaceMass& one : masses) {
      OriginShares shares = mixed[whose(one.place)].draw(one.mass);
      if (std::get<TerrainPlace>(one.place.at).region == 0) drop_foreign(shares);
      provenance.put(one.place, shares);
    }
    for (auto& [of, rest] : mixed) {
      drop_foreign(rest.shares);
      provenance.put({NoPlace{}, of.first}, rest.shares);
    }
  }
}

}  // namespace scree
