// From a server's bytes to its messages: a welcome of this protocol first, and none after it. Messages of
// unknown kinds are skipped. Not
// thread-safe.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "client/connection/server_channel.h"
#include "proto/frame_reader.h"

namespace scree {

class Intake {
 public:
  struct Next {
    ServerMessage message;
    size_t bytes = 0;  ///< on the wire, length prefix included
  };

  /// Appends received bytes. Call next() until it returns nothing before the next push.
  void push(std::span<const uint8_t> bytes) { reader_.push(bytes); }
  /// The next message of a known kind, the welcome among them; nothing when more bytes are needed. The error
  /// ends the connection: the server refused, or does not speak this protocol.
  tl::expected<std::optional<Next>, ConnectionEnd> next();

  /// Nothing before it has come.
  const std::optional<WelcomeMessage>& welcome() const { return welcome_; }
  /// Messages that were skipped, for their kind is not known.
  uint64_t unknown() const { return unknown_; }
  /// The server has sent frames, so that its silence says something.
  bool sends_frames() const { return sends_frames_; }

 private:
  tl::expected<void, ConnectionEnd> inspect(const ServerMessage& message);

  FrameReader reader_;
  std::optional<WelcomeMessage> welcome_;
  bool sends_frames_ = false;
  uint64_t unknown_ = 0;
};

}  // namespace scree
