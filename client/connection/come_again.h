// Which refusals leave a client a chance to come in later, without anybody changing anything at this end.
#pragma once

#include <string_view>

namespace scree {

/// The name of the client's own refusal to send a token in the clear (ServerEndpoint::insecure_token).
inline constexpr std::string_view token_in_clear = "token_in_clear";

/// Whether connecting again by itself may help after a refusal of this name (docs/protocol.md). True of a
/// name that is not known, as of a lost connection: who tries again waits longer each time.
bool may_come_again(std::string_view refusal);

}  // namespace scree
