// Where a server is, and how a client comes to it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "client/connection/limits.h"
#include "crypto/tls_context.h"
#include "proto/messages.h"
#include "transport/link_config.h"

namespace scree {

struct ServerEndpoint {
  std::string host = "127.0.0.1";
  uint16_t port = default_port;
  std::string
      socket{};  ///< path of the server's admin socket: instead of host and port, without TLS and token
  bool tls = false;
  TlsTrust trust{};                  ///< with TLS: whose certificate is taken
  std::optional<LinkConfig> link{};  ///< as if each connection went by such a link
  double silent_seconds_max = limits::silent_seconds_max;
  std::string token{};  ///< goes with the hello: an access token, or the server's admin token; empty: none
  /// The token may be read on its way: it goes to other machines without TLS, too.
  bool insecure_token = false;
};

/// "127.0.0.1:4177", or the path of the socket.
std::string text_of(const ServerEndpoint& server);

}  // namespace scree
