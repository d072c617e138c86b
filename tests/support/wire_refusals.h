// The reason for which a decoder refuses a message; empty when it takes it.
#pragma once

#include <string>
#include <vector>

#include "tests/support/wire_samples.h"

namespace scree {

inline std::string client_refusal(const ClientMessage& message) {
  const std::vector<uint8_t> bytes = encode(message);
  const Result<ClientMessage> decoded = decode_client(samples::body_of(bytes));
  return decoded ? "" : decoded.error().message;
}

inline std::string server_refusal(const ServerMessage& message) {
  const std::vector<uint8_t> bytes = encode(message);
  const Result<ServerMessage> decoded = decode_server(samples::body_of(bytes));
  return decoded ? "" : decoded.error().message;
}

}  // namespace scree
