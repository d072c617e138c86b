// A bare socket to a server on loopback, for tests that send bytes which no real client would send.
// Every wait has a deadline.
#pragma once

#include <chrono>
#include <optional>
#include <poll.h>
#include <span>
#include <sys/socket.h>
#include <vector>

#include "proto/codec.h"
#include "proto/frame_reader.h"
#include "tests/support/loopback_socket.h"

namespace scree {

class RawClient {
 public:
  explicit RawClient(const Route& route, int receive_buffer_bytes = 0)
      : socket_(route, receive_buffer_bytes) {}

  bool connected() const { return socket_.connected(); }

  bool send_bytes(std::span<const uint8_t> bytes) {
    return ::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  bool send(const ClientMessage& message) { return send_bytes(encode(message)); }
  /// Ends the connection out of order, as a lost link does, when it is closed.
  void reset() {
    const linger at_once{1, 0};
    ::setsockopt(socket_.number(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  }
  void finish_sending() { socket_.finish_sending(); }

  /// The next message; nothing at the end of the stream or after the deadline.
  std::optional<ServerMessage> receive(std::chrono::milliseconds within = std::chrono::seconds(10)) {
    const auto deadline = std::chrono::steady_clock::now() + within;
    for (;;) {
      const auto message = reader_.next();
      if (!message) return std::nullopt;
      if (message->has_value()) {
        auto decoded = decode_server(**message);
        return decoded ? std::optional(std::move(*decoded)) : std::nullopt;
      }
      if (!fill(deadline)) return std::nullopt;
    }
  }

  /// The next message of one kind; others are skipped.
  template <typename T>
  std::optional<T> receive_as(std::chrono::milliseconds within = std::chrono::seconds(10)) {
    const auto deadline = std::chrono::steady_clock::now() + within;
    while (std::chrono::steady_clock::now() < deadline) {
      const auto left = deadline - std::chrono::steady_clock::now();
      const auto message = receive(std::chrono::duration_cast<std::chrono::milliseconds>(left));
      if (!message) return std::nullopt;
      if (const T* wanted = std::get_if<T>(&*message)) return *wanted;
    }
    return std::nullopt;
  }

  /// Whether the server closes the connection before the deadline.
  bool closed_within(std::chrono::milliseconds within) {
    const auto deadline = std::chrono::steady_clock::now() + within;
    while (!ended_ && fill(deadline)) {
      while (reader_.buffered_bytes() != 0) {
        const auto message = reader_.next();
        if (!message || !message->has_value()) break;
      }
    }
    return ended_;
  }

 private:
  bool fill(std::chrono::steady_clock::time_point deadline) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(deadline - std::chrono::steady_clock::now());
    pollfd waiting{socket_.number(), POLLIN, 0};
    if (left.count() <= 0 || ::poll(&waiting, 1, static_cast<int>(left.count())) <= 0) return false;
    std::vector<uint8_t> bytes(65536);
    const ssize_t count = ::recv(socket_.number(), bytes.data(), bytes.size(), 0);
    if (count <= 0) {
      ended_ = true;
      return false;
    }
    reader_.push(std::span<const uint8_t>(bytes.data(), static_cast<size_t>(count)));
    return true;
  }

  LoopbackSocket socket_;
  bool ended_ = false;
  FrameReader reader_;
};

}  // namespace scree
