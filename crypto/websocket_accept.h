#pragma once

#include <string>
#include <string_view>

namespace scree {

/// What a server answers to a WebSocket's Sec-WebSocket-Key (RFC 6455, 4.2.2): base64 of a SHA-1.
std::string websocket_accept(std::string_view key);

}  // namespace scree
