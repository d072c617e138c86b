// The number of the protocol, and when two peers can talk. Additions keep the number, for a peer skips what
// it does not know (docs/protocol.md, Versions and growth).
#pragma once

#include <cstdint>
#include <variant>

#include "shared/operation/operation.h"

namespace scree {

/// The protocol that this program speaks.
inline constexpr uint32_t protocol_version = 6;

/// Whether a peer that speaks the protocols from `oldest` to `newest` can talk with this program, by
/// protocol_version. `oldest` 0: it speaks `newest` alone.
constexpr bool shares_protocol(uint32_t newest, uint32_t oldest) {
  return (oldest == 0 ? newest : oldest) <= protocol_version && protocol_version <= newest;
}

/// Kinds of operation that there are, and that a client of this program carries out.
inline constexpr uint32_t operation_kinds = std::variant_size_v<Operation>;

/// Kinds of operation in the first release of this protocol: those of a client that does not say its own.
inline constexpr uint32_t operation_kinds_first = 7;
static_assert(operation_kinds >= operation_kinds_first);

}  // namespace scree
