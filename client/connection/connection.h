// A client's connection to a server: bytes to messages and back, on a thread of its own.
//
// Received messages wait in a bounded queue for poll(). While it is full, the socket is not read, so that a
// slow client only slows the server's sending. All functions may be called from any thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "client/connection/endpoint.h"
#include "proto/messages.h"
#include "shared/base/result.h"

namespace scree {

/// Why there is no connection, or no more.
struct ConnectionEnd : Error {
  std::string refusal{};  ///< the name of the server's reason, if it refused (RefusalMessage); else empty
};

struct Received {
  ServerMessage message;
  size_t bytes = 0;  ///< on the wire, length prefix included
  std::chrono::steady_clock::time_point arrived;
};

struct ConnectionCounters {
  uint64_t received_bytes = 0;
  uint64_t received_messages = 0;
  uint64_t sent_bytes = 0;  ///< handed over to be sent, the hello included
  uint64_t sent_messages = 0;
  size_t waiting_messages = 0;  ///< received, not yet polled
  size_t waiting_bytes = 0;     ///< their memory, decoded
  uint64_t pauses = 0;          ///< times that reading stopped because the queue was full
};

class Connection {
 public:
  /// Connects, sends a hello, with the endpoint's token, then other messages if there are any, and waits for
  /// the welcome. The error names the address and the failure; a refusal has the server's reason.
  static tl::expected<std::unique_ptr<Connection>, ConnectionEnd> connect(
      const ServerEndpoint& server, HelloMessage hello, std::chrono::milliseconds within,
      const std::vector<ClientMessage>& then = {});
  /// Closes.
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const WelcomeMessage& welcome() const;

  /// Takes all messages that arrived after the welcome, in order. Does not wait. Messages that arrived before
  /// the connection closed can still be polled.
  std::vector<Received> poll();
  /// Like poll(), but waits until a message arrives, the connection closes, or the time is over.
  std::vector<Received> wait(std::chrono::milliseconds within);

  /// Queues a message for sending; does nothing after the connection closed.
  void send(const ClientMessage& message);

  bool connected() const;
  /// The reason for which the connection closed; empty while it is open.
  ConnectionEnd end() const;
  std::string close_reason() const { return end().message; }
  ConnectionCounters counters() const;

  /// Closes; the server takes it for a lost connection, to which the client may come back by its ticket.
  void close();
  /// Says goodbye and closes: the session is over, and its place is free.
  void leave();

  /// For tests: pause_reading() stops reading the socket, as a stuck client does; cut() ends the connection
  /// without closing it in order, as a lost link does.
  void pause_reading(bool pause);
  void cut();

 private:
  struct Impl;
  explicit Connection(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace scree
