// A client's connection to a server: bytes to messages and back, on a thread of its own.
//
// Received messages wait in a bounded queue for poll(). While it is full, the socket is not read, so that a
// slow client only slows the server's sending. All functions may be called from any thread.
#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "client/connection/endpoint.h"
#include "client/connection/server_channel.h"

namespace scree {

class Connection final : public ServerChannel {
 public:
  /// Connects, sends a hello, with the endpoint's token, then other messages if there are any, and waits for
  /// the welcome. The error names the address and the failure; a refusal has the server's reason.
  static tl::expected<std::unique_ptr<Connection>, ConnectionEnd> connect(
      const ServerEndpoint& server, HelloMessage hello, std::chrono::milliseconds within,
      const std::vector<ClientMessage>& then = {});
  /// Closes.
  ~Connection() override;
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  const WelcomeMessage& welcome() const override;

  /// Takes all messages that arrived.
  std::vector<Received> poll() override;
  void await(std::chrono::milliseconds within) override;
  /// await(), then poll().
  std::vector<Received> wait(std::chrono::milliseconds within);

  void send(const ClientMessage& message) override;
  bool connected() const override;
  ConnectionEnd end() const override;
  std::string close_reason() const { return end().message; }
  ConnectionCounters counters() const override;

  /// Closes; the server takes it for a lost connection, to which the client may come back by its ticket.
  void close();
  void leave() override;

  /// For tests: pause_reading() stops reading the socket, as a stuck client does; abort() ends the connection
  /// without closing it in order, as a lost link does.
  void pause_reading(bool pause);
  void abort();

 private:
  struct Impl;
  explicit Connection(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace scree
