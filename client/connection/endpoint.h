// Where a server is, and how a client comes to it.
#pragma once

#include <cstdint>
#include <string>

#include "crypto/tls_context.h"
#include "proto/messages.h"

namespace scree {

struct ServerEndpoint {
  std::string host = "127.0.0.1";
  uint16_t port = default_port;
  bool tls = false;
  TlsTrust trust{};     ///< with TLS: whose certificate is taken
  std::string token{};  ///< goes with the hello: an access token, or the server's admin token; empty: none
};

}  // namespace scree
