// A client's request on its way to the world, and the answer to it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/command/refusal.h"
#include "shared/operation/request.h"

namespace scree {

struct Command {
  uint64_t session = 0;  ///< session of the client; 0: the server itself
  uint32_t request = 0;  ///< the client's number of the request, returned in the reply
  Request body;
  /// Who shares the server with others as one: by the number of a session, its own or another's, which has
  /// the same address or token. 0: the session for itself.
  uint64_t party = 0;
  /// Who asks, as the network side knows it: a world lets him edit in a region by that. The server itself may
  /// edit everywhere.
  Asker asker{};
  /// The eye from which an edit has to be in sight; nothing: it may be out of sight. Set by the network side.
  std::optional<glm::vec3> eye_m{};

  bool operator==(const Command&) const = default;
};

/// The party of its session, never 0 but for the server itself.
inline uint64_t party_of(const Command& command) {
  return command.party == 0 ? command.session : command.party;
}

/// The answer to a request; `refusal` is empty when it was carried out.
struct Reply {
  uint64_t session = 0;
  uint32_t request = 0;
  std::string refusal;
  uint32_t pieces = 0;
  std::optional<Refusal> reason = std::nullopt;  ///< of the refusal
  std::string host_name{};                       ///< of a Refusal::host that the host gave a name of its own
  std::optional<uint32_t> painted{};             ///< bricks whose rock a paint changed
  std::optional<PieceId> prop{};                 ///< that was added
  std::optional<JointId> joint{};                ///< likewise
  std::optional<MassUnits> mass{};               ///< that was dug, placed or transferred
};

/// The name of the reply's refusal that clients get, which stays the same from version to version: that of
/// the reason, or "game:" and the host's own. Empty when it was carried out.
std::string refusal_name(const Reply& reply);

}  // namespace scree
