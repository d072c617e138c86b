// Connections to a server that trusts this machine as a proxy: each comes from any address that a bench says,
// so the limits of addresses hold for it. Bytes are counted both ways, without the proxy's header.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "proto/codec.h"
#include "proto/frame_reader.h"

namespace scree {

class NamedSocket {
 public:
  NamedSocket(uint16_t port, const std::string& ip);
  ~NamedSocket();
  NamedSocket(const NamedSocket&) = delete;
  NamedSocket& operator=(const NamedSocket&) = delete;

  /// Sends all, or ends the connection.
  void send(std::span<const uint8_t> bytes);
  void send(const ClientMessage& message) { send(encode(message)); }
  void send(const std::string& text);
  /// Drops what has arrived.
  void receive();
  /// Likewise, but counts messages of the protocol, and reads the welcome.
  void receive_messages();
  bool over() const { return over_; }

  uint64_t sent_bytes() const { return sent_bytes_; }
  uint64_t received_bytes() const { return received_bytes_; }
  /// Answers to requests for ground or tiles.
  size_t answers() const { return answers_; }
  /// The server's world, by its welcome; 0: none came yet.
  uint64_t world() const { return world_; }

 private:
  /// Empty: nothing has arrived.
  std::span<const uint8_t> arrived();

  int socket_;
  bool over_ = false;
  uint64_t sent_bytes_ = 0, received_bytes_ = 0, world_ = 0;
  size_t answers_ = 0;
  FrameReader reader_;
  std::vector<uint8_t> buffer_ = std::vector<uint8_t>(size_t{1} << 18U);
};

}  // namespace scree
