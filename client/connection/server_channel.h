// A session's messages to and from its server, whatever carries them: a socket of this program, a page's
// WebSocket. Begins with the welcome.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proto/messages.h"
#include "shared/base/result.h"

namespace scree {

/// Why there is no connection, or no more.
struct ConnectionEnd : Error {
  /// The name of the server's reason, if it refused (RefusalMessage), or token_in_clear; else empty.
  std::string refusal{};
};

struct Received {
  ServerMessage message;
  size_t bytes = 0;  ///< on the wire, length prefix included
  std::chrono::steady_clock::time_point arrived;

  /// The same in seconds.
  double arrived_s() const { return std::chrono::duration<double>(arrived.time_since_epoch()).count(); }
};

struct ConnectionCounters {
  uint64_t received_bytes = 0;
  uint64_t received_messages = 0;
  uint64_t sent_bytes = 0;  ///< handed over to be sent, the hello included
  uint64_t sent_messages = 0;
  uint64_t messages_unknown = 0;  ///< skipped: of a kind that this version does not know
  size_t waiting_messages = 0;    ///< received, not yet polled
  size_t waiting_bytes = 0;       ///< their memory
  uint64_t pauses = 0;            ///< times that reading stopped because the queue was full
};

class ServerChannel {
 public:
  virtual ~ServerChannel() = default;

  virtual const WelcomeMessage& welcome() const = 0;
  /// Takes messages that arrived after the welcome, in order. Does not wait. Messages that arrived before the
  /// connection closed can still be polled: it is over when none comes any more.
  virtual std::vector<Received> poll() = 0;
  /// Sleeps until poll() has something, the connection has ended, or the time is over. Does nothing where the
  /// thread that calls it is the one that brings the bytes.
  virtual void await(std::chrono::milliseconds within) = 0;
  /// Queues a message for sending; does nothing after the connection closed.
  virtual void send(const ClientMessage& message) = 0;
  virtual bool connected() const = 0;
  /// The reason for which the connection closed; empty while it is open.
  virtual ConnectionEnd end() const = 0;
  virtual ConnectionCounters counters() const = 0;
  /// Says goodbye and closes: the session is over, and its place is free.
  virtual void leave() = 0;
};

}  // namespace scree
