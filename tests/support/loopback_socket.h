// A connection to a server on this machine, by TCP or a Unix socket, for clients that are made by hand.
#pragma once

#include <arpa/inet.h>
#include <cstdint>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

namespace scree {

/// Where a connection goes to, and which of this machine's addresses it comes from.
struct Route {
  Route(uint16_t to_port) : port(to_port) {}  // NOLINT: a port alone is a route on loopback
  Route(uint16_t to_port, std::string to_address, std::string from_address)
      : port(to_port), to(std::move(to_address)), from(std::move(from_address)) {}
  /// To a Unix socket.
  static Route to_file(std::string path) {
    Route route(0);
    route.file = std::move(path);
    return route;
  }

  uint16_t port;
  std::string to = "127.0.0.1";
  std::string from{};  ///< empty: any
  std::string file{};  ///< of a Unix socket; empty: by TCP
};

class LoopbackSocket {
 public:
  explicit LoopbackSocket(const Route& route, int receive_buffer_bytes = 0)
      : socket_(::socket(route.file.empty() ? AF_INET : AF_UNIX, SOCK_STREAM, 0)) {
    if (receive_buffer_bytes != 0)
      ::setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &receive_buffer_bytes, sizeof receive_buffer_bytes);
    if (!route.file.empty()) {
      sockaddr_un there{AF_UNIX, {}};
      route.file.copy(there.sun_path, sizeof there.sun_path - 1);
      connected_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&there), sizeof there) == 0;
      return;
    }
    const sockaddr_in from = address(route.from, 0), to = address(route.to, route.port);
    connected_ =
        (route.from.empty() || ::bind(socket_, reinterpret_cast<const sockaddr*>(&from), sizeof from) == 0) &&
        ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) == 0;
  }
  ~LoopbackSocket() { ::close(socket_); }
  LoopbackSocket(const LoopbackSocket&) = delete;
  LoopbackSocket& operator=(const LoopbackSocket&) = delete;

  int number() const { return socket_; }
  bool connected() const { return connected_; }
  void finish_sending() const { ::shutdown(socket_, SHUT_WR); }

 private:
  static sockaddr_in address(const std::string& ip, uint16_t port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(port);
    ::inet_pton(AF_INET, ip.c_str(), &address.sin_addr);
    return address;
  }

  int socket_;
  bool connected_ = false;
};

}  // namespace scree
