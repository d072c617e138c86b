// Joins a server by a socket of this program, with what is kept of it.
#pragma once

#include <chrono>
#include <future>
#include <memory>

#include "client/cache/connector.h"
#include "client/cache/limits.h"
#include "client/cache/rejoin.h"
#include "client/connection/connection.h"

namespace scree {

/// As Connection::connect(), with ticket and offer. Reads files; writes what was kept before.
tl::expected<std::unique_ptr<Connection>, ConnectionEnd> join_server(Rejoin& rejoin,
                                                                     const ServerEndpoint& server,
                                                                     HelloMessage hello,
                                                                     std::chrono::milliseconds within);

/// The same on a thread of its own.
class ServerConnector final : public Connector {
 public:
  /// `within`: what an attempt may take.
  explicit ServerConnector(ServerEndpoint server, std::chrono::milliseconds within =
                                                      std::chrono::milliseconds(limits::connect_ms_max))
      : server_(std::move(server)), within_(within) {}
  /// Waits for the attempt that is under way.
  ~ServerConnector() override;

  /// Attempts that begin from now on may take so long.
  void allow(std::chrono::milliseconds within) { within_ = within; }

  void begin(Rejoin& rejoin, const HelloMessage& hello, double now_s) override;
  bool busy() const override { return attempt_.valid(); }
  void await(std::chrono::milliseconds within) override {
    if (busy()) attempt_.wait_for(within);
  }
  std::optional<Attempt> poll(double now_s) override;
  std::string where() const override;

 private:
  ServerEndpoint server_;
  std::chrono::milliseconds within_;
  std::future<Attempt> attempt_;
};

}  // namespace scree
