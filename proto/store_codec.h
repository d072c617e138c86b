// Stores and the requests about them, between our types and Protobuf's. proto/store.proto specifies them.
#pragma once

#include <google/protobuf/repeated_ptr_field.h>

#include "proto/wire_values.h"

namespace scree {

using WireStores = google::protobuf::RepeatedPtrField<wire::Store>;

void write(wire::StoreName& to, const StoreName& from);
void write(wire::Store& to, const StoreContent& from);
void write(WireStores& to, const std::vector<StoreContent>& from);
void write(wire::Dig& to, const DigMessage& from);
void write(wire::Place& to, const PlaceMessage& from);
void write(wire::Transfer& to, const TransferMessage& from);
void write(wire::Stores& to, const StoresMessage& from);

/// Refuses what names no store, and masses that no store has.
StoreName read(const wire::StoreName& from, FieldChecker& check);
/// Refuses also a store of who asks.
StoreContent read(const wire::Store& from, FieldChecker& check);
/// Refuses more than `most`, and stores that do not ascend.
std::vector<StoreContent> read_stores(const WireStores& from, size_t most, FieldChecker& check);
DigMessage read(const wire::Dig& from, FieldChecker& check);
PlaceMessage read(const wire::Place& from, FieldChecker& check);
TransferMessage read(const wire::Transfer& from, FieldChecker& check);
StoresMessage read(const wire::Stores& from, FieldChecker& check);

void write(wire::RegionMass& to, const RegionMass& from);
/// Refuses one that does not add up.
RegionMass read(const wire::RegionMass& from, FieldChecker& check);

}  // namespace scree
