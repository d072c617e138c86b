// Where the server's owner comes in without a token: a Unix socket, whose file nobody else may open. Who
// connects is asked of the kernel (SO_PEERCRED, unix(7)): the user that the server runs as, and root, are let
// in. Used by .cpp files of the network side only (Asio). All calls are on the network thread, but for
// listen(), which comes before it runs.
#pragma once

#include <asio/io_context.hpp>
#include <asio/local/stream_protocol.hpp>
#include <asio/steady_timer.hpp>
#include <functional>
#include <string>

#include "server/doors/socket_file.h"
#include "shared/base/result.h"

namespace scree {

class OwnerEntrance {
 public:
  using Socket = asio::local::stream_protocol::socket;
  /// Takes a connection of the owner's, and his address in words: "unix:uid=1000".
  using Entered = std::function<void(Socket socket, const std::string& address)>;
  /// Hears in words that a connection was closed, or could not be accepted.
  using Refused = std::function<void(const std::string& why)>;

  OwnerEntrance(asio::io_context& context, Entered entered, Refused refused)
      : acceptor_(context), pause_(context), entered_(std::move(entered)), refused_(std::move(refused)) {}

  /// As of SocketFile.
  Result<void> listen(const std::string& path);
  /// Nobody comes in any more, and the file is gone.
  void close();

 private:
  void accept();
  void accepted(Socket socket);
  void rest();

  asio::local::stream_protocol::acceptor acceptor_;
  asio::steady_timer pause_;
  const Entered entered_;
  const Refused refused_;
  SocketFile file_;
};

}  // namespace scree
