#include "transport/tcp_transport.h"

namespace scree {

TcpTransport::TcpTransport(asio::ip::tcp::socket socket) : TcpTransport(prepare(socket), socket) {}

TcpTransport::TcpTransport(SocketPeer peer, asio::ip::tcp::socket& socket)
    : SocketTransport(std::move(socket), std::move(peer)) {}

SocketPeer TcpTransport::prepare(asio::ip::tcp::socket& socket) {
  asio::error_code error;
  socket.set_option(asio::ip::tcp::no_delay(true), error);  // a socket that takes no options still works
  const auto endpoint = socket.remote_endpoint(error);
  if (error) return {};
  return {endpoint.address().to_string(), endpoint.port()};
}

}  // namespace scree
