// The acts of rules, between our types and Protobuf's. Internal to proto/ and to the formats of files.
// proto/rules.proto specifies them. A page has none (no_rules.cpp).
#pragma once

#include <string>

#include "proto/wire_values.h"

namespace scree::wire {
class Notice;
}

namespace scree {

/// The bytes of a wire.Rules.
std::string pack_rules(const RulesMessage& from);
/// Refuses bytes that are none, and what validate() refuses.
RulesMessage unpack_rules(const std::string& packed, FieldChecker& check);

/// The bytes of a wire.Restore, likewise.
std::string pack_restore(const RestoreMessage& from);
RestoreMessage unpack_restore(const std::string& packed, FieldChecker& check);

void write(wire::Notice& to, const Notice& from);
Notice read(const wire::Notice& from, FieldChecker& check);

}  // namespace scree
