// A Unix socket: a stream to another process of this machine.
#pragma once

#include <asio/local/stream_protocol.hpp>
#include <string>
#include <utility>

#include "transport/socket_transport.h"

namespace scree {

class UnixTransport final : public SocketTransport {
 public:
  /// The socket is connected. `address`: the other side, in words, for it has no address.
  UnixTransport(asio::local::stream_protocol::socket socket, std::string address)
      : SocketTransport(std::move(socket), {std::move(address), 0}) {}
};

}  // namespace scree
