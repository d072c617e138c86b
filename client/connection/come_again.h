// Which refusals leave a client a chance to come in later, without anybody changing anything at this end.
#pragma once

#include <string_view>

namespace scree {

/// Whether connecting again by itself may help after a refusal of this name (docs/protocol.md). True of a
/// name that is not known, as of a lost connection: who tries again waits longer each time.
bool may_come_again(std::string_view refusal);

}  // namespace scree
