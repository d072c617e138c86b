#include "proto/store_codec.h"

#include <fmt/format.h>

#include "proto/byte_stream.h"
#include "proto/content_codec.h"
#include "shared/operation/ledger.h"

namespace scree {

namespace {

static_assert(wire::StoreKind_ARRAYSIZE == kind_count<StoreKind>);

std::string pack_masses(const MaterialMasses& masses) {
  std::vector<uint8_t> bytes;
  ByteWriter writer(bytes);
  for (const MaterialMass& one : masses) {
    writer.u8(static_cast<uint8_t>(one.material));
    writer.varint(static_cast<uint64_t>(one.mass));
  }
  return to_string(bytes);
}

MaterialMasses unpack_masses(const std::string& packed, FieldChecker& check) {
  MaterialMasses masses;
  ByteReader reader(as_span(packed), "masses of a store");
  while (!reader.at_end() && !reader.failed()) {
    const auto material = static_cast<Material>(reader.u8("material", materials_max - 1));
    const auto mass =
        static_cast<MassUnits>(reader.varint("mass (limits.ledger_mass_max)", limits::ledger_mass_max));
    if (mass == 0) reader.refuse("a material without mass");
    if (!masses.empty() && masses.back().material >= material) reader.refuse("the materials do not ascend");
    masses.push_back({material, mass});
  }
  if (!reader.failed()) return masses;
  check.refuse(reader.error().message);
  return {};
}

}  // namespace

void write(wire::StoreName& to, const StoreName& from) {
  to.set_kind(static_cast<wire::StoreKind>(from.kind));
  to.set_number(from.number);
  to.set_name(from.name);
}

void write(wire::Store& to, const StoreContent& from) {
  write(*to.mutable_store(), from.store);
  to.set_masses(pack_masses(from.masses));
}

void write(WireStores& to, const std::vector<StoreContent>& from) {
  for (const StoreContent& one : from) write(*to.Add(), one);
}

void write(wire::Dig& to, const DigMessage& from) {
  to.set_request(from.request);
  write(*to.mutable_shape(), from.shape);
  to.set_piece(from.piece);
  if (from.store != StoreName{}) write(*to.mutable_store(), from.store);
}

void write(wire::Place& to, const PlaceMessage& from) {
  to.set_request(from.request);
  write(*to.mutable_shape(), from.shape);
  to.set_material(static_cast<uint32_t>(from.material));
  to.set_solid(from.solid);
  if (from.store != StoreName{}) write(*to.mutable_store(), from.store);
}

void write(wire::Transfer& to, const TransferMessage& from) {
  to.set_request(from.request);
  write(*to.mutable_from(), from.from);
  write(*to.mutable_to(), from.to);
  if (from.material) to.set_material(static_cast<uint32_t>(*from.material));
  to.set_mass(static_cast<uint64_t>(from.mass));
}

void write(wire::Stores& to, const StoresMessage& from) {
  write(*to.mutable_stores(), from.stores);
}

StoreName read(const wire::StoreName& from, FieldChecker& check) {
  StoreName store{check.asked_kind<StoreKind>(from.kind(), "kind of store"), from.number(),
                  check.text(from.name(), limits::store_name_bytes_max, "name of a store")};
  if (!check.unknown().empty()) return {};
  if (const Result<void> valid = validate(store); !valid) {
    check.refuse(valid.error().message);
    return {};
  }
  return store;
}

StoreContent read(const wire::Store& from, FieldChecker& check) {
  StoreContent content{read(from.store(), check), unpack_masses(from.masses(), check)};
  if (content.store.kind == StoreKind::own) check.refuse("a store of nobody");
  return content;
}

std::vector<StoreContent> read_stores(const WireStores& from, size_t most, FieldChecker& check) {
  std::vector<StoreContent> stores;
  if (static_cast<size_t>(from.size()) > most) {
    check.refuse(fmt::format("{} stores are over the limit of {}", from.size(), most));
    return stores;
  }
  for (const wire::Store& one : from) {
    if (check.failed()) break;
    StoreContent store = read(one, check);
    if (!stores.empty() && !(stores.back().store < store.store)) check.refuse("stores are not in order");
    stores.push_back(std::move(store));
  }
  return stores;
}

DigMessage read(const wire::Dig& from, FieldChecker& check) {
  return {{check.shape(from.shape()), from.piece(), read(from.store(), check)}, from.request()};
}

PlaceMessage read(const wire::Place& from, FieldChecker& check) {
  return {{check.shape(from.shape()), check.asked_material(from.material()), from.solid(),
           read(from.store(), check)},
          from.request()};
}

TransferMessage read(const wire::Transfer& from, FieldChecker& check) {
  TransferMessage transfer;
  transfer.request = from.request();
  transfer.from = read(from.from(), check);
  transfer.to = read(from.to(), check);
  if (from.has_material()) transfer.material = check.asked_material(from.material());
  if (from.mass() <= static_cast<uint64_t>(limits::ledger_mass_max))
    transfer.mass = static_cast<MassUnits>(from.mass());
  else
    check.refuse("a mass of a transfer that no world has (limits.ledger_mass_max)");
  return transfer;
}

StoresMessage read(const wire::Stores& from, FieldChecker& check) {
  return {read_stores(from.stores(), limits::stores_a_message, check)};
}

void write(wire::RegionMass& to, const RegionMass& from) {
  to.set_region(from.origin.region);
  to.set_party(from.origin.party);
  to.set_material(static_cast<uint32_t>(row_number(from.material)));
  to.set_cut(from.cut);
  to.set_pieces(from.pieces);
  to.set_dust(from.dust);
  to.set_carried(from.carried);
  to.set_back(from.back);
  to.set_away(from.away);
}

RegionMass read(const wire::RegionMass& from, FieldChecker& check) {
  RegionMass mass;
  mass.origin = {from.region(), from.party()};
  mass.material = static_cast<Material>(check.within(from.material(), 0, UINT8_MAX, "material"));
  mass.cut = ledger_mass(from.cut(), check);
  mass.pieces = ledger_mass(from.pieces(), check);
  mass.dust = ledger_mass(from.dust(), check);
  mass.carried = ledger_mass(from.carried(), check);
  mass.back = ledger_mass(from.back(), check);
  mass.away = ledger_mass(from.away(), check);
  for (const MassUnits part : {mass.cut, mass.pieces, mass.dust, mass.carried, mass.back, mass.away})
    if (part < 0) check.refuse("less than nothing came out of a region");
  if (mass.error() != 0) check.refuse("what became of a region's rock is not what was cut out of it");
  return mass;
}

}  // namespace scree
