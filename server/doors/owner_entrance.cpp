#include "server/doors/owner_entrance.h"

#include <chrono>
#include <fmt/format.h>
#include <optional>
#include <sys/socket.h>
#include <unistd.h>

#include "server/doors/limits.h"

namespace scree {

namespace {

constexpr uid_t root = 0;

/// Nothing: the kernel does not say.
std::optional<uid_t> user_at(OwnerEntrance::Socket& socket) {
  ucred peer{};
  socklen_t bytes = sizeof peer;
  if (::getsockopt(socket.native_handle(), SOL_SOCKET, SO_PEERCRED, &peer, &bytes) != 0 ||
      bytes != sizeof peer)
    return std::nullopt;
  return peer.uid;
}

}  // namespace

Result<void> OwnerEntrance::listen(const std::string& path) {
  const int descriptor = TRY(file_.listen(path));
  asio::error_code error;
  acceptor_.assign(asio::local::stream_protocol(), descriptor, error);
  if (error) {
    ::close(descriptor);
    return fail(fmt::format("cannot listen on {}: {} (--admin-socket)", path, error.message()));
  }
  accept();
  return {};
}

void OwnerEntrance::close() {
  file_.remove();
  asio::error_code ignored;
  acceptor_.close(ignored);
  pause_.cancel();
}

void OwnerEntrance::accept() {
  acceptor_.async_accept([this](asio::error_code error, Socket socket) {
    if (!acceptor_.is_open()) return;
    if (error) {
      refused_("cannot accept connections by the admin socket: " + error.message());
      return rest();
    }
    accepted(std::move(socket));
    accept();
  });
}

/// Asking again at once would fail again.
void OwnerEntrance::rest() {
  pause_.expires_after(std::chrono::milliseconds(limits::accept_pause_ms));
  pause_.async_wait([this](asio::error_code error) {
    if (!error && acceptor_.is_open()) accept();
  });
}

void OwnerEntrance::accepted(Socket socket) {
  const std::optional<uid_t> user = user_at(socket);
  if (!user || (*user != ::geteuid() && *user != root))
    return refused_(fmt::format("a connection by the admin socket was closed: {}",
                                user ? fmt::format("the user {} is neither the server's nor root", *user)
                                     : "the system does not say whose it is"));
  asio::error_code ignored;
  socket.set_option(asio::socket_base::send_buffer_size(limits::socket_send_buffer_bytes), ignored);
  entered_(std::move(socket), fmt::format("unix:uid={}", *user));
}

}  // namespace scree
