// Plain TCP. Sends without delay (TCP_NODELAY).
#pragma once

#include <asio/ip/tcp.hpp>

#include "transport/socket_transport.h"

namespace scree {

class TcpTransport final : public SocketTransport {
 public:
  /// The socket is connected.
  explicit TcpTransport(asio::ip::tcp::socket socket);

 private:
  TcpTransport(SocketPeer peer, asio::ip::tcp::socket& socket);
  /// Sets the socket's options, and says where it leads.
  static SocketPeer prepare(asio::ip::tcp::socket& socket);
};

}  // namespace scree
