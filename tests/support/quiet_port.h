// A port of this machine at which nobody should call.
#pragma once

#include <arpa/inet.h>
#include <cstdint>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace scree {

class QuietPort {
 public:
  QuietPort() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t bytes = sizeof here;
    listens_ = ::bind(socket_, reinterpret_cast<const sockaddr*>(&here), bytes) == 0 &&
               ::listen(socket_, 16) == 0 &&
               ::getsockname(socket_, reinterpret_cast<sockaddr*>(&here), &bytes) == 0;
    port_ = ntohs(here.sin_port);
  }
  ~QuietPort() { ::close(socket_); }
  QuietPort(const QuietPort&) = delete;
  QuietPort& operator=(const QuietPort&) = delete;

  bool listens() const { return listens_; }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(port_) + "/"; }
  /// Whether a connection waits: the kernel holds it until it is accepted.
  bool was_called() const {
    pollfd waits{socket_, POLLIN, 0};
    return ::poll(&waits, 1, 0) > 0;
  }

 private:
  int socket_;
  bool listens_ = false;
  uint16_t port_ = 0;
};

}  // namespace scree
