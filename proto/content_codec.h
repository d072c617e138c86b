// Converts messages about content, and the ledger by material, between our types and Protobuf's. Internal to
// proto/ and server/formats.
#pragma once

#include <optional>

#include "proto/wire_values.h"
#include "shared/operation/ledger.h"

namespace scree {

std::string wire_digest(const Digest& digest);
/// Refuses other lengths than a digest's.
Digest read_digest(const std::string& from, const char* what, FieldChecker& check);
/// Nothing where the field is empty.
std::optional<Digest> read_any_digest(const std::string& from, const char* what, FieldChecker& check);

void write(wire::ContentRequest& to, const AskContentMessage& from);
AskContentMessage read(const wire::ContentRequest& from, FieldChecker& check);
void write(wire::Content& to, const ContentMessage& from);
ContentMessage read(const wire::Content& from, FieldChecker& check);

/// Refuses mass beyond limits::ledger_mass_max.
MassUnits ledger_mass(int64_t mass, FieldChecker& check);

/// Five zigzag varints for each row: terrain, pieces, dust, poured, converted (what is stored is apart, where
/// there is any). Rows at the end without
/// anything are left out: ledgers that say the same have the same bytes.
std::string pack_ledger(const MaterialLedger& ledger);
/// What is stored of each material, a zigzag varint for each row, likewise; empty where nothing is.
std::string pack_stored(const MaterialLedger& ledger);
MaterialLedger unpack_ledger(const std::string& packed, const std::string& stored, FieldChecker& check);

}  // namespace scree
