// Where connections come in: listens, asks the Door, and rests when accepting fails. Used by .cpp files of
// the network side only (Asio). All calls are on the network thread, but for listen(), which comes before it
// runs.
#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>
#include <string>

#include "server/doors/door.h"
#include "server/doors/proxies.h"
#include "shared/base/result.h"

namespace scree {

/// Why the door does not let a connection in, in words.
Refused door_refusal(Refusal reason);
/// Closes the connection, once it has taken the reason as far as it does so at once.
void tell_and_close(asio::ip::tcp::socket socket, const Refused& refused);

/// Who takes the connections.
class EntranceHost {
 public:
  virtual ~EntranceHost() = default;
  /// `address` as of Door; it is given back by Door::leave(). `by_proxy`: it is a trusted proxy's, and not
  /// the client's.
  virtual void entered(asio::ip::tcp::socket socket, const std::string& address, bool by_proxy) = 0;
  /// The door does not let it in.
  virtual void turned_away(asio::ip::tcp::socket socket, const std::string& address,
                           const Refused& refused) = 0;
  /// No connection could be accepted: mostly for want of descriptors.
  virtual void accepting_failed(const std::string& why) = 0;
};

class Entrance {
 public:
  /// All arguments must outlive this object.
  Entrance(asio::io_context& context, Door& door, const Proxies& proxies, EntranceHost& host)
      : acceptor_(context), pause_(context), door_(door), proxies_(proxies), host_(host) {}

  /// The error names address and port, and the way out.
  Result<void> listen(const std::string& bind, uint16_t port);
  uint16_t port() const { return port_; }
  void close();

 private:
  void accept();
  void accepted(asio::ip::tcp::socket socket);
  void rest();

  asio::ip::tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  uint16_t port_ = 0;
  Door& door_;
  const Proxies& proxies_;
  EntranceHost& host_;
};

}  // namespace scree
