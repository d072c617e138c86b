// The way to a server: finds its addresses, tries one after the other, and puts the simulated link and TLS
// over the socket. Or connects to its admin socket. Used by .cpp files of this folder only (Asio). All calls
// are on the thread that runs the context, or before it runs.
#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/local/stream_protocol.hpp>
#include <functional>
#include <memory>

#include "client/connection/endpoint.h"
#include "client/connection/server_channel.h"
#include "shared/base/result.h"
#include "transport/transport.h"

namespace scree {

class Dial {
 public:
  /// Takes the stream, whose TLS has not begun yet.
  using Reached = std::function<void(std::shared_ptr<Transport> stream)>;
  using Failed = std::function<void(const ConnectionEnd& why)>;

  explicit Dial(asio::io_context& context)
      : context_(context), resolver_(context), socket_(context), local_(context) {}

  /// One of the two is called, once, unless cancel() comes before. The error: nothing was begun, and neither
  /// is called. Called once.
  Result<void> begin(const ServerEndpoint& server, Reached reached, Failed failed);
  void cancel();

 private:
  using tcp = asio::ip::tcp;

  void reach_socket();
  void try_next(const asio::error_code& before);
  void hand_over(std::shared_ptr<Transport> stream);
  void fail_with(const std::string& why, const std::string& refusal = {});

  asio::io_context& context_;
  ServerEndpoint server_;
  Reached reached_;
  Failed failed_;
  std::shared_ptr<const TlsClientContext> tls_;
  tcp::resolver resolver_;
  tcp::resolver::results_type found_;  ///< addresses of the server's name
  tcp::resolver::results_type::iterator untried_;
  tcp::socket socket_;  ///< until it is connected; likewise the next
  asio::local::stream_protocol::socket local_;
  bool over_ = false;
};

}  // namespace scree
