#include "client/connection/dial.h"

#include <fmt/format.h>
#include <sys/un.h>
#include <utility>

#include "client/connection/come_again.h"
#include "client/connection/limits.h"
#include "client/connection/token_way.h"
#include "shared/base/text.h"
#include "transport/asio_link_clock.h"
#include "transport/link_transport.h"
#include "transport/tcp_transport.h"
#include "transport/tls_transport.h"
#include "transport/unix_transport.h"

namespace scree {

std::string text_of(const ServerEndpoint& server) {
  return server.socket.empty() ? endpoint_text(server.host, server.port) : server.socket;
}

Result<void> Dial::begin(const ServerEndpoint& server, Reached reached, Failed failed) {
  server_ = server;
  reached_ = std::move(reached);
  failed_ = std::move(failed);
  if (!server_.socket.empty()) {
    if (server_.socket.size() >= sizeof sockaddr_un::sun_path)
      return fail(fmt::format("the path of a Unix socket has at most {} bytes (--socket)",
                              sizeof sockaddr_un::sun_path - 1));
    reach_socket();
    return {};
  }
  if (server_.host.empty()) return fail("no server is named (--host)");
  if (server_.tls) tls_ = TRY(TlsClientContext::make(server_.trust));
  resolver_.async_resolve(server_.host, std::to_string(server_.port),
                          [this](const asio::error_code& error, const auto& results) {
                            if (over_) return;
                            if (error) return fail_with("cannot find the host: " + error.message());
                            found_ = results;
                            untried_ = found_.begin();
                            try_next(asio::error::host_not_found);
                          });
  return {};
}

void Dial::reach_socket() {
  local_.async_connect({server_.socket}, [this](const asio::error_code& error) {
    if (over_) return;
    if (error == asio::error::access_denied)
      return fail_with("cannot connect: only the user that the server runs as, and root, may");
    if (error)
      return fail_with(
          fmt::format("cannot connect: {}; does a server with this --admin-socket run?", error.message()));
    hand_over(std::make_shared<UnixTransport>(std::move(local_), server_.socket));
  });
}

void Dial::try_next(const asio::error_code& before) {
  if (over_) return;
  if (untried_ == found_.end())
    return fail_with(fmt::format("cannot connect: {}; is a server running there?", before.message()));
  const tcp::endpoint to = *untried_++;
  // A name does not say where it leads, so the address decides.
  if (const auto fault = fault_of_way(server_, to.address().to_string()))
    return fail_with(*fault, std::string(token_in_clear));
  asio::error_code failed;
  socket_.close(failed);
  socket_.open(to.protocol(), failed);
  if (failed) return try_next(failed);
  // What the link does not take is to wait at the server, as it would there, and not in this socket.
  asio::error_code ignored;
  if (server_.link) socket_.set_option(tcp::socket::receive_buffer_size(limits::link_receive_bytes), ignored);
  socket_.async_connect(to, [this](const asio::error_code& refused) {
    if (refused) return try_next(refused);
    if (!over_) hand_over(std::make_shared<TcpTransport>(std::move(socket_)));
  });
}

void Dial::hand_over(std::shared_ptr<Transport> stream) {
  over_ = true;
  if (server_.link)
    stream = std::make_shared<LinkTransport>(std::move(stream), *server_.link,
                                             std::make_unique<AsioLinkClock>(context_));
  if (tls_) stream = std::make_shared<TlsTransport>(std::move(stream), TlsEngine(tls_, server_.host));
  reached_(std::move(stream));
}

void Dial::fail_with(const std::string& why, const std::string& refusal) {
  over_ = true;
  failed_({{why}, refusal});
}

void Dial::cancel() {
  over_ = true;
  asio::error_code ignored;
  resolver_.cancel();
  socket_.close(ignored);
  local_.close(ignored);
}

}  // namespace scree
