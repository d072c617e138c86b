// A server of NATS on loopback with streams of its own, which a test starts, kills and starts again.
#pragma once

#include <arpa/inet.h>
#include <cstdint>
#include <memory>
#include <netinet/in.h>
#include <string>
#include <sys/socket.h>
#include <unistd.h>
#include <vector>

#include "server/bus/bus.h"
#include "tests/support/background_program.h"
#include "tests/support/patience.h"
#include "tests/support/test_folder.h"

namespace scree {

/// A port that was free a moment ago, below those that systems give to connections: of these a client that
/// calls while nobody listens may get the one that it calls, and meet itself.
inline uint16_t free_port() {
  static uint32_t tried = static_cast<uint32_t>(::getpid()) * 61;
  for (int attempt = 0; attempt < 1000; ++attempt) {
    const auto port = static_cast<uint16_t>(12'000 + tried++ % 20'000);
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in here{};
    here.sin_family = AF_INET;
    here.sin_port = htons(port);
    here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    const bool is_free = ::bind(socket, reinterpret_cast<const sockaddr*>(&here), sizeof here) == 0;
    ::close(socket);
    if (is_free) return port;
  }
  ADD_FAILURE() << "no port is free";
  return 0;
}

class NatsProcess {
 public:
  explicit NatsProcess(std::vector<std::string> more = {}) : more_(std::move(more)) { start(); }

  void start() {
    std::vector<std::string> command{NATS_SERVER,           "-a",  "127.0.0.1", "-p",
                                     std::to_string(port_), "-js", "-sd",       folder_ / "streams"};
    command.insert(command.end(), more_.begin(), more_.end());
    program_ = std::make_unique<BackgroundProgram>(command, folder_ / "said");
  }
  void kill() { program_.reset(); }
  /// It answers nothing, and its connections stay, until it goes on.
  void hang() const { ::kill(program_->number(), SIGSTOP); }
  void go_on() const { ::kill(program_->number(), SIGCONT); }

  std::string url(const std::string& user = "") const {
    return "nats://" + (user.empty() ? "" : user + "@") + "127.0.0.1:" + std::to_string(port_);
  }
  const TestFolder& folder() const { return folder_; }

 private:
  const TestFolder folder_;
  const uint16_t port_ = free_port();
  const std::vector<std::string> more_;
  std::unique_ptr<BackgroundProgram> program_;
};

/// Whether it comes true within the tests' patience.
template <typename Condition>
bool comes(const Condition& condition) {
  const auto end = std::chrono::steady_clock::now() + patience;
  while (!condition()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    wait_a_moment();
  }
  return true;
}

inline BusConfig bus_at(const std::string& url) {
  BusConfig config;
  config.url = url;
  config.name = "test";
  return config;
}

inline std::shared_ptr<Bus> connected_bus(const NatsProcess& nats) {
  auto bus = Bus::connect(bus_at(nats.url()));
  EXPECT_TRUE(bus) << bus.error().message;
  EXPECT_TRUE(comes([&] { return (*bus)->is_connected(); })) << (*bus)->fault();
  return *bus;
}

}  // namespace scree
