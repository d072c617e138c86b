#include "server/doors/entrance.h"

#include <asio/buffer.hpp>
#include <asio/write.hpp>
#include <chrono>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include "proto/codec.h"
#include "server/doors/limits.h"
#include "shared/base/check.h"
#include "shared/base/text.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

/// What is not sent yet waits in the outbox, where newer state can still take its place, and not in the
/// kernel. A socket that takes no options still works.
void tune(asio::ip::tcp::socket& socket) {
  asio::error_code ignored;
  socket.set_option(asio::socket_base::send_buffer_size(limits::socket_send_buffer_bytes), ignored);
  const int unsent_bytes = limits::socket_unsent_bytes;
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_NOTSENT_LOWAT, &unsent_bytes, sizeof unsent_bytes);
  const auto timeout_ms = static_cast<unsigned>(limits::stall_seconds_max * 1000.0);
  setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_USER_TIMEOUT, &timeout_ms, sizeof timeout_ms);
}

}  // namespace

Refused door_refusal(Refusal reason) {
  if (reason == Refusal::connects_per_second)
    return {reason, "too many connections a second from your address (connects-per-second); try again later"};
  CHECK(reason == Refusal::connections_per_address);
  return {reason, "too many connections from your address (connections-per-address)"};
}

void tell_and_close(asio::ip::tcp::socket socket, const Refused& refused) {
  asio::error_code ignored;
  socket.non_blocking(true, ignored);
  const RefusalMessage told{refused.message, std::string(name_of(refused.reason))};
  socket.write_some(asio::buffer(encode(ServerMessage(told))), ignored);
}

Result<void> Entrance::listen(const std::string& bind, uint16_t port) {
  const std::string where = endpoint_text(bind, port);
  asio::error_code error;
  const auto address = asio::ip::make_address(bind, error);
  if (error) return fail("cannot listen on " + where + ": '" + bind + "' is no IP address (--bind)");
  const asio::ip::tcp::endpoint endpoint(address, port);
  acceptor_.open(endpoint.protocol(), error);
  if (!error) acceptor_.set_option(asio::ip::tcp::acceptor::reuse_address(true), error);
  if (!error) acceptor_.bind(endpoint, error);
  if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
  if (error == asio::error::address_in_use)
    return fail("cannot listen on " + where +
                ": the port is in use; stop what uses it, or choose another one (--port)");
  if (error) return fail("cannot listen on " + where + ": " + error.message());
  port_ = acceptor_.local_endpoint(error).port();
  if (error) return fail("cannot listen on " + where + ": " + error.message());
  accept();
  return {};
}

void Entrance::close() {
  asio::error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
}

void Entrance::accept() {
  acceptor_.async_accept([this](asio::error_code error, asio::ip::tcp::socket socket) {
    if (!acceptor_.is_open()) return;
    if (error) {
      host_.accepting_failed(error.message());
      return rest();
    }
    accepted(std::move(socket));
    accept();
  });
}

/// Asking again at once would fail again.
void Entrance::rest() {
  pause_.expires_after(std::chrono::milliseconds(limits::accept_pause_ms));
  pause_.async_wait([this](asio::error_code error) {
    if (!error && acceptor_.is_open()) accept();
  });
}

void Entrance::accepted(asio::ip::tcp::socket socket) {
  asio::error_code error;
  const auto endpoint = socket.remote_endpoint(error);
  if (error) return;  // it has gone already
  const std::string ip = endpoint.address().to_string();
  const std::string address = door_address(ip);
  const bool by_proxy = proxies_.contains(ip);
  tune(socket);
  if (by_proxy) {
    door_.enter_unbounded(address, steady_now_s());
  } else if (const auto no = door_.enter(address, steady_now_s())) {
    return host_.turned_away(std::move(socket), address, door_refusal(*no));
  }
  host_.entered(std::move(socket), address, by_proxy);
}

}  // namespace scree
