#include "server/formats/world_provenance.h"

#include <algorithm>
#include <set>

#include "proto/byte_stream.h"
#include "shared/base/overloaded.h"

namespace scree {

namespace {

using Origins = std::vector<MassOrigin>;

Origins origins_of(const std::vector<PlacedMass>& placed) {
  std::set<MassOrigin> origins;
  for (const PlacedMass& one : placed) origins.insert(one.share.origin);
  return {origins.begin(), origins.end()};
}

void write_text(ByteWriter& writer, const std::string& text) {
  writer.u8(static_cast<uint8_t>(text.size()));
  for (const char letter : text) writer.u8(static_cast<uint8_t>(letter));
}

/// The place after the last one's brick.
void write_place(ByteWriter& writer, const MassPlace& place, BrickCoord& last) {
  writer.u8(static_cast<uint8_t>(place.at.index()));
  std::visit(
      Overloaded{[&](const TerrainPlace& at) {
                   for (const int32_t step : {at.brick.x - last.x, at.brick.y - last.y, at.brick.z - last.z})
                     writer.zigzag(step);
                   last = at.brick;
                   writer.varint(at.region);
                   writer.u8(at.rubble ? 1 : 0);
                 },
                 [&](const PiecePlace& at) { writer.varint(at.piece); },
                 [&](const StorePlace& at) {
                   writer.u8(static_cast<uint8_t>(at.store.kind));
                   writer.varint(at.store.number);
                   write_text(writer, at.store.name);
                 },
                 [](const DustPlace&) {}, [](const NoPlace&) {}},
      place.at);
}

constexpr int32_t brick_coordinate_max = limits::voxel_coordinate_max / brick_size;

MassPlace read_place(ByteReader& reader, BrickCoord& last) {
  constexpr uint8_t kinds = std::variant_size_v<decltype(MassPlace::at)>;
  const auto id = [&](const char* what) { return static_cast<PieceId>(reader.varint(what, UINT32_MAX)); };
  switch (reader.u8("kind of place", kinds - 1)) {
    case 0: {
      last = read_coord(reader, last, brick_coordinate_max, "brick");
      const RegionId region = id("region");
      return {TerrainPlace{last, region, reader.u8("rubble", 1) == 1}, {}};
    }
    case 1:
      return {PiecePlace{id("piece")}, {}};
    case 2: {
      StoreName store{reader.kind<StoreKind>("store"), reader.varint("number of a store"), {}};
      const auto name = reader.read_bytes(reader.u8("name", UINT8_MAX), "name of a store");
      store.name.assign(name.begin(), name.end());
      return {StorePlace{std::move(store)}, {}};
    }
    case 3:
      return {DustPlace{}, {}};
    default:
      return {NoPlace{}, {}};
  }
}

}  // namespace

std::string write_provenance(const std::vector<PlacedMass>& placed) {
  if (placed.empty()) return {};
  const Origins origins = origins_of(placed);
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  writer.varint(origins.size());
  for (const MassOrigin& origin : origins) {
    writer.varint(origin.region);
    writer.varint(origin.party);
  }
  writer.varint(placed.size());
  BrickCoord last;
  for (const auto& [place, share] : placed) {
    write_place(writer, place, last);
    writer.u8(static_cast<uint8_t>(row_number(place.material)));
    writer.varint(static_cast<uint64_t>(std::ranges::lower_bound(origins, share.origin) - origins.begin()));
    writer.varint(static_cast<uint64_t>(share.mass));
  }
  return {bytes.begin(), bytes.end()};
}

std::vector<PlacedMass> read_provenance(const std::string& bytes, FieldChecker& check) {
  if (bytes.empty()) return {};
  ByteReader reader(as_span(bytes), "masses with an origin");
  Origins origins;
  const uint64_t count = reader.varint("origins", limits::origins_max);
  for (uint64_t i = 0; i < count && !reader.failed(); ++i) {
    const auto region = static_cast<RegionId>(reader.varint("region", UINT32_MAX));
    origins.push_back({region, reader.varint("party")});
  }
  std::vector<PlacedMass> placed;
  BrickCoord last;
  const uint64_t masses = reader.varint("masses");
  for (uint64_t i = 0; i < masses && !reader.failed(); ++i) {
    PlacedMass one{read_place(reader, last), {}};
    one.place.material = static_cast<Material>(reader.u8("material", UINT8_MAX));
    const uint64_t origin = reader.varint("origin");
    one.share.mass = static_cast<MassUnits>(reader.varint("mass", limits::ledger_mass_max));
    if (origin >= origins.size()) reader.refuse("an origin of a mass is none of those listed");
    if (reader.failed()) break;
    one.share.origin = origins[origin];
    placed.push_back(std::move(one));
  }
  reader.finish();
  if (reader.failed()) check.refuse(reader.error().message);
  return placed;
}

}  // namespace scree
