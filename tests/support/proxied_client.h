// A bare client that a trusted proxy on this machine names: it comes from any address that a test likes. It
// reads as much as there is.
#pragma once

#include <fcntl.h>
#include <optional>
#include <string>
#include <sys/socket.h>
#include <vector>

#include "client/mirror/mirror.h"
#include "proto/codec.h"
#include "proto/frame_reader.h"
#include "tests/support/loopback_socket.h"
#include "tests/support/patience.h"

namespace scree {

class ProxiedClient {
 public:
  ProxiedClient(uint16_t port, const std::string& ip) : socket_(port) {
    send_text("PROXY TCP4 " + ip + " 192.0.2.1 50000 4177\r\n");
  }

  bool send_bytes(std::span<const uint8_t> bytes) {
    return ::send(socket_.number(), bytes.data(), bytes.size(), MSG_NOSIGNAL) ==
           static_cast<ssize_t>(bytes.size());
  }
  bool send_text(const std::string& text) {
    return send_bytes(std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
  }
  bool send(const ClientMessage& message) { return send_bytes(encode(message)); }

  /// Says hello, and waits for the welcome.
  bool join(const HelloMessage& hello) {
    if (!send(hello)) return false;
    for (const Within within(10.0); !mirror_ && !within.over();) receive();
    return joined();
  }
  bool joined() const { return mirror_.has_value(); }
  const Mirror& mirror() const { return *mirror_; }
  /// Drops what has arrived, and returns how many bytes it was.
  size_t drop() {
    size_t dropped = 0;
    for (std::vector<uint8_t> bytes = arrived(); !bytes.empty(); bytes = arrived()) dropped += bytes.size();
    return dropped;
  }
  /// Applies what has arrived to its copy of the world; false: it is not sound.
  bool receive() {
    for (std::vector<uint8_t> bytes = arrived(); !bytes.empty(); bytes = arrived()) reader_.push(bytes);
    for (auto next = reader_.next(); next && next->has_value(); next = reader_.next()) {
      const auto message = decode_server(**next);
      if (!message) return false;
      grounds_ += std::holds_alternative<GroundMessage>(*message) ? 1 : 0;
      if (const auto* welcome = std::get_if<WelcomeMessage>(&*message); welcome != nullptr && !mirror_)
        mirror_.emplace(*welcome);
      else if (mirror_ && !mirror_->apply(*message))
        return false;
    }
    return true;
  }
  /// Chunks of ground that came.
  size_t grounds() const { return grounds_; }

 private:
  std::vector<uint8_t> arrived() {
    std::vector<uint8_t> bytes(65536);
    const ssize_t count = ::recv(socket_.number(), bytes.data(), bytes.size(), MSG_DONTWAIT);
    bytes.resize(count > 0 ? static_cast<size_t>(count) : 0);
    return bytes;
  }

  LoopbackSocket socket_;
  FrameReader reader_;
  std::optional<Mirror> mirror_;
  size_t grounds_ = 0;
};

}  // namespace scree
