// Where connections come in: listens, lets in whom the Door lets in, and rests when accepting fails. Used by
// .cpp files of the network side only (Asio). All calls are on the network thread, but for listen(), which
// comes before it runs.
#pragma once

#include <asio/io_context.hpp>
#include <asio/ip/tcp.hpp>
#include <asio/steady_timer.hpp>
#include <string>

#include "server/doors/door.h"
#include "shared/base/result.h"

namespace scree {

/// Who takes the connections.
class EntranceHost {
 public:
  virtual ~EntranceHost() = default;
  /// `address` as of Door; it is given back by Door::leave().
  virtual void entered(asio::ip::tcp::socket socket, const std::string& address) = 0;
  /// It is closed after this; `words` were sent to it as far as it took them at once.
  virtual void turned_away(const std::string& peer, const Refused& refused) = 0;
  /// No connection could be accepted: mostly for want of descriptors.
  virtual void accepting_failed(const std::string& why) = 0;
};

class Entrance {
 public:
  /// `door` and `host` must outlive this object.
  Entrance(asio::io_context& context, Door& door, EntranceHost& host)
      : acceptor_(context), pause_(context), door_(door), host_(host) {}

  /// The error names address and port, and the way out.
  Result<void> listen(const std::string& bind, uint16_t port);
  uint16_t port() const { return port_; }
  void close();

 private:
  void accept();
  void accepted(asio::ip::tcp::socket socket);
  void turn_away(asio::ip::tcp::socket socket, const std::string& peer, Refusal reason);
  void rest();

  asio::ip::tcp::acceptor acceptor_;
  asio::steady_timer pause_;
  uint16_t port_ = 0;
  Door& door_;
  EntranceHost& host_;
};

}  // namespace scree
