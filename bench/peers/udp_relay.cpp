#include "bench/peers/udp_relay.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <cstring>
#include <map>
#include <mutex>
#include <netinet/in.h>
#include <optional>
#include <string>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace scree::peers {

namespace {

constexpr int buffer_bytes = 4 << 20;  ///< of each socket: bursts of a join are not to be lost here
constexpr int wait_ms = 50;

sockaddr_in loopback(uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

/// -1 when there is none.
int datagram_socket() {
  const int made = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0);
  if (made < 0) return made;
  setsockopt(made, SOL_SOCKET, SO_RCVBUF, &buffer_bytes, sizeof buffer_bytes);
  setsockopt(made, SOL_SOCKET, SO_SNDBUF, &buffer_bytes, sizeof buffer_bytes);
  return made;
}

/// A socket on a port of its own choice, and that port; nothing when there is none.
std::optional<std::pair<int, uint16_t>> bound_socket() {
  const int made = datagram_socket();
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof address;
  if (made < 0) return std::nullopt;
  if (::bind(made, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::getsockname(made, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    ::close(made);
    return std::nullopt;
  }
  return std::pair(made, ntohs(address.sin_port));
}

std::string reason() {
  return std::string("no socket for datagrams: ") + std::strerror(errno);
}

}  // namespace

struct UdpRelay::State {
  /// The way of one client.
  struct Client {
    sockaddr_in address{};
    int to_server = -1;
    RelayedBytes bytes;
  };

  int listening = -1;
  int epoll = -1;
  uint16_t port = 0;
  sockaddr_in server{};
  std::map<uint16_t, size_t> numbers;  ///< of clients, by port
  std::vector<Client> clients;
  mutable std::mutex mutex;  ///< of `clients`, which the thread alone changes
  std::atomic<bool> stopping{false};
  std::thread thread;

  void add_to_epoll(int socket, uint64_t number) const {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = number;
    epoll_ctl(epoll, EPOLL_CTL_ADD, socket, &event);
  }
  /// The client's number; it may be a new one.
  std::optional<size_t> number_of(const sockaddr_in& from) {
    if (const auto found = numbers.find(from.sin_port); found != numbers.end()) return found->second;
    const int to_server = datagram_socket();
    if (to_server < 0 || ::connect(to_server, reinterpret_cast<const sockaddr*>(&server), sizeof server) != 0)
      return std::nullopt;
    const size_t number = clients.size();
    {
      const std::lock_guard lock(mutex);
      clients.push_back({from, to_server, {}});
    }
    numbers[from.sin_port] = number;
    add_to_epoll(to_server, number + 1);
    return number;
  }
  void from_clients() {
    std::array<uint8_t, 65536> datagram{};
    for (;;) {
      sockaddr_in from{};
      socklen_t size = sizeof from;
      const ssize_t got = ::recvfrom(listening, datagram.data(), datagram.size(), 0,
                                     reinterpret_cast<sockaddr*>(&from), &size);
      if (got < 0) return;
      const std::optional<size_t> number = number_of(from);
      if (!number) continue;
      ::send(clients[*number].to_server, datagram.data(), static_cast<size_t>(got), 0);
      const std::lock_guard lock(mutex);
      clients[*number].bytes.to_server += static_cast<uint64_t>(got);
    }
  }
  void from_server(size_t number) {
    std::array<uint8_t, 65536> datagram{};
    for (;;) {
      const ssize_t got = ::recv(clients[number].to_server, datagram.data(), datagram.size(), 0);
      if (got < 0) return;
      ::sendto(listening, datagram.data(), static_cast<size_t>(got), 0,
               reinterpret_cast<const sockaddr*>(&clients[number].address), sizeof clients[number].address);
      const std::lock_guard lock(mutex);
      clients[number].bytes.to_client += static_cast<uint64_t>(got);
    }
  }
  void run() {
    std::array<epoll_event, 64> events{};
    while (!stopping) {
      const int ready = epoll_wait(epoll, events.data(), static_cast<int>(events.size()), wait_ms);
      for (int i = 0; i < ready; ++i) {
        const uint64_t number = events[static_cast<size_t>(i)].data.u64;
        if (number == 0)
          from_clients();
        else
          from_server(number - 1);
      }
    }
  }
  ~State() {
    stopping = true;
    if (thread.joinable()) thread.join();
    for (const Client& client : clients) ::close(client.to_server);
    if (listening >= 0) ::close(listening);
    if (epoll >= 0) ::close(epoll);
  }
};

Result<std::unique_ptr<UdpRelay>> UdpRelay::start(uint16_t server_port) {
  auto state = std::make_unique<State>();
  const auto bound = bound_socket();
  if (!bound) return fail(reason());
  std::tie(state->listening, state->port) = *bound;
  state->epoll = epoll_create1(EPOLL_CLOEXEC);
  state->server = loopback(server_port);
  state->add_to_epoll(state->listening, 0);
  state->thread = std::thread([raw = state.get()] { raw->run(); });
  return std::unique_ptr<UdpRelay>(new UdpRelay(std::move(state)));
}

UdpRelay::UdpRelay(std::unique_ptr<State> state) : state_(std::move(state)) {}

UdpRelay::~UdpRelay() = default;

uint16_t UdpRelay::port() const {
  return state_->port;
}

std::vector<RelayedBytes> UdpRelay::counts() const {
  const std::lock_guard lock(state_->mutex);
  std::vector<RelayedBytes> counts;
  for (const State::Client& client : state_->clients) counts.push_back(client.bytes);
  return counts;
}

Result<uint16_t> free_udp_port() {
  const auto bound = bound_socket();
  if (!bound) return fail(reason());
  ::close(bound->first);
  return bound->second;
}

}  // namespace scree::peers
