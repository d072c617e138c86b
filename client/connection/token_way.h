// Whether a token may go to an address: in the clear, everybody on the way could read it, and come in by it.
#pragma once

#include <optional>
#include <string>

#include "client/connection/endpoint.h"

namespace scree {

/// Why the endpoint's token must not be sent to this IP address, with the way out; nothing: it may, for there
/// is no token, it goes by TLS, it stays on this machine, or the person insists.
std::optional<std::string> fault_of_way(const ServerEndpoint& server, const std::string& ip);

}  // namespace scree
