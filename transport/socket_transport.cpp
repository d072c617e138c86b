#include "transport/socket_transport.h"

#include <algorithm>
#include <array>
#include <asio/buffer.hpp>
#include <cerrno>
#include <linux/sockios.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <vector>

#include "transport/limits.h"

namespace scree {

namespace {

/// What asio did before the socket was closed, but tells of behind that, is not told (Transport::close).
Moved moved(const asio::generic::stream_protocol::socket& socket, const asio::error_code& error,
            size_t bytes) {
  if (!error && !socket.is_open())
    return tl::unexpected(StreamEnd{false, asio::error_code(asio::error::operation_aborted).message()});
  if (!error) return bytes;
  return tl::unexpected(StreamEnd{error == asio::error::eof, error.message()});
}

bool goes_later(int error) {
  return error == EAGAIN || error == EWOULDBLOCK || error == EINTR || error == ENOBUFS;
}

}  // namespace

void SocketTransport::read_some(std::span<uint8_t> into, Done done) {
  socket_.async_read_some(
      asio::buffer(into.data(), into.size()),
      [self = shared_from_this(), done = std::move(done)](const asio::error_code& error, size_t bytes) {
        const bool told_before = error == asio::error::eof && self->broke_;
        done(moved(self->socket_, told_before ? self->broke_ : error, bytes));
      });
}

void SocketTransport::write_some(Buffers buffers, Done done) {
  std::vector<asio::const_buffer> gathered;
  gathered.reserve(buffers.size());
  for (const std::span<const uint8_t> bytes : buffers) gathered.emplace_back(bytes.data(), bytes.size());
  socket_.async_write_some(gathered, [self = shared_from_this(), done = std::move(done)](
                                         const asio::error_code& error, size_t bytes) {
    if (error) self->broke_ = error;
    done(moved(self->socket_, error, bytes));
  });
}

/// The system call itself: Asio would queue a handler for what is done already.
size_t SocketTransport::write_now(Buffers buffers) {
  std::array<iovec, limits::gathered_buffers_max> gathered;
  const size_t count = std::min(buffers.size(), gathered.size());
  for (size_t i = 0; i < count; ++i)
    gathered[i] = {const_cast<uint8_t*>(buffers[i].data()), buffers[i].size()};  // it only reads them
  msghdr message{};
  message.msg_iov = gathered.data();
  message.msg_iovlen = count;
  const ssize_t sent = sendmsg(socket_.native_handle(), &message, MSG_DONTWAIT | MSG_NOSIGNAL);
  if (sent >= 0) return static_cast<size_t>(sent);
  if (!goes_later(errno)) broke_ = asio::error_code(errno, asio::system_category());
  return 0;
}

size_t SocketTransport::unsent_bytes() {
  int unsent = 0;
  if (ioctl(socket_.native_handle(), SIOCOUTQNSD, &unsent) != 0 || unsent < 0) return 0;
  return static_cast<size_t>(unsent);
}

void SocketTransport::finish_sending() {
  asio::error_code ignored;
  socket_.shutdown(asio::socket_base::shutdown_send, ignored);
}

void SocketTransport::close() {
  asio::error_code ignored;
  socket_.close(ignored);
}

void SocketTransport::abort() {
  asio::error_code ignored;
  socket_.set_option(asio::socket_base::linger(true, 0), ignored);
  socket_.close(ignored);
}

}  // namespace scree
