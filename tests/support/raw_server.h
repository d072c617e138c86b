// A bare listener on loopback, or another address of this machine, for tests of clients, which sends bytes
// that no real server would send. One connection at a time; every wait has a deadline.
#pragma once

#include <arpa/inet.h>
#include <array>
#include <netinet/in.h>
#include <optional>
#include <poll.h>
#include <span>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

#include "proto/codec.h"
#include "proto/frame_reader.h"

namespace scree {

class RawServer {
 public:
  explicit RawServer(const char* ip = "127.0.0.1") : RawServer(ip, true) {}
  /// Nobody can come in, and no other program of this machine gets its port meanwhile.
  static RawServer closed() { return RawServer("127.0.0.1", false); }
  ~RawServer() {
    hang_up();
    ::close(listener_);
  }
  RawServer(const RawServer&) = delete;
  RawServer& operator=(const RawServer&) = delete;

  uint16_t port() const { return port_; }
  int socket() const { return socket_; }

  bool accept(int send_buffer_bytes = 0) {
    if (!ready(listener_, POLLIN)) return false;
    socket_ = ::accept(listener_, nullptr, nullptr);
    if (send_buffer_bytes != 0)
      ::setsockopt(socket_, SOL_SOCKET, SO_SNDBUF, &send_buffer_bytes, sizeof send_buffer_bytes);
    return socket_ >= 0;
  }
  void hang_up() {
    if (socket_ >= 0) ::close(socket_);
    socket_ = -1;
  }

  bool send_bytes(std::span<const uint8_t> bytes) {
    return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }
  bool send(const ServerMessage& message) { return send_bytes(encode(message)); }

  /// All that clients have sent which came and went, in order of coming.
  std::string all_sent() {
    std::string sent;
    for (std::array<char, 4096> buffer{}; ready(listener_, POLLIN, 0) && accept(); hang_up())
      for (ssize_t count = 1; count > 0 && ready(socket_, POLLIN);) {
        count = ::recv(socket_, buffer.data(), buffer.size(), 0);
        if (count > 0) sent.append(buffer.data(), static_cast<size_t>(count));
      }
    return sent;
  }

  /// Sends copies of a message until the socket takes no more for `quiet_ms`; how many went out whole.
  size_t send_until_stuck(const ServerMessage& message, size_t count_max, int quiet_ms) {
    const std::vector<uint8_t> bytes = encode(message);
    size_t sent = 0;
    for (size_t at = 0; sent < count_max;) {
      if (!ready(socket_, POLLOUT, quiet_ms)) return sent;
      const ssize_t count =
          ::send(socket_, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL | MSG_DONTWAIT);
      if (count < 0) return sent;
      at += static_cast<size_t>(count);
      if (at < bytes.size()) continue;
      at = 0;
      ++sent;
    }
    return sent;
  }

  /// The client's next message; nothing at the end of the stream, or after the deadline.
  std::optional<ClientMessage> receive() {
    for (;;) {
      const auto next = reader_.next();
      if (!next) return std::nullopt;
      if (*next) {
        Result<ClientMessage> message = decode_client(**next);
        return message ? std::optional(std::move(*message)) : std::nullopt;
      }
      if (!ready(socket_, POLLIN)) return std::nullopt;
      std::vector<uint8_t> bytes(65536);
      const ssize_t count = ::recv(socket_, bytes.data(), bytes.size(), 0);
      if (count <= 0) return std::nullopt;
      reader_.push(std::span<const uint8_t>(bytes).first(static_cast<size_t>(count)));
    }
  }

 private:
  RawServer(const char* ip, bool listens) : listener_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    ::inet_pton(AF_INET, ip, &address.sin_addr);
    ::bind(listener_, reinterpret_cast<const sockaddr*>(&address), sizeof address);
    if (listens) ::listen(listener_, 4);
    socklen_t size = sizeof address;
    ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  static bool ready(int socket, short events, int within_ms = 10000) {
    pollfd waiting{socket, events, 0};
    return ::poll(&waiting, 1, within_ms) == 1;
  }

  int listener_;
  int socket_ = -1;
  uint16_t port_ = 0;
  FrameReader reader_;
};

}  // namespace scree
