#include "bench/wire/drains.h"

#include <algorithm>
#include <cstring>
#include <netinet/in.h>
#include <optional>
#include <sys/epoll.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <unistd.h>

#include "proto/codec.h"
#include "shared/base/check.h"
#include "shared/base/timing.h"

namespace scree {

namespace {

constexpr double step_s = 1e-4;
constexpr size_t head_bytes = 24;  ///< of a message: enough for a frame's tick
constexpr uint8_t frame_tag = 0x1A, changes_tag = 0x0A;

/// A varint of Protobuf; nothing when the bytes end before.
std::optional<uint64_t> varint(const uint8_t*& at, const uint8_t* end) {
  uint64_t value = 0;
  for (unsigned shift = 0; at != end && shift < 64; shift += 7) {
    const uint8_t byte = *at++;
    value |= uint64_t{byte & 0x7FU} << shift;
    if (byte < 0x80) return value;
  }
  return std::nullopt;
}

/// The tick of a message that begins so; nothing when it is no frame (proto/scree.proto, Frame.changes).
std::optional<Tick> tick_of(const uint8_t* at, size_t size) {
  const uint8_t* end = at + size;
  if (at == end || *at++ != frame_tag || !varint(at, end)) return std::nullopt;
  if (at == end || *at++ != changes_tag || !varint(at, end)) return std::nullopt;
  const auto tick = varint(at, end);
  if (!tick) return std::nullopt;
  return *tick >> 1U;
}

}  // namespace

void stand_aside() {
  const auto thread = static_cast<id_t>(gettid());
  constexpr int nicer = 10;
  setpriority(PRIO_PROCESS, thread, getpriority(PRIO_PROCESS, thread) + nicer);
}

void AgeCount::add(double age_s) {
  const auto step = static_cast<size_t>(std::max(age_s, 0.0) / step_s);
  ++steps_[std::min(step, steps_.size() - 1)];
  ++count_;
}

double AgeCount::quantile_ms(double part) const {
  const auto wanted = static_cast<uint64_t>(part * static_cast<double>(count_));
  uint64_t sum = 0;
  for (size_t i = 0; i < steps_.size(); ++i)
    if ((sum += steps_[i]) > wanted) return static_cast<double>(i + 1) * step_s * 1000.0;
  return 0.0;
}

struct Drains::Reader {
  int socket = -1;
  std::array<uint8_t, length_prefix_bytes + head_bytes> head{};
  size_t have = 0;  ///< of the head
  size_t skip = 0;  ///< bytes of the message after its head
};

Drains::Drains(const TickTimes& times) : times_(times), epoll_(epoll_create1(0)) {}

Drains::~Drains() {
  stop();
  for (const Reader& reader : readers_)
    if (reader.socket >= 0) close(reader.socket);
  close(epoll_);
}

Result<std::unique_ptr<Drains>> Drains::connect(uint16_t port, const std::vector<HelloMessage>& hellos,
                                                const TickTimes& times) {
  std::unique_ptr<Drains> drains(new Drains(times));
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  for (const HelloMessage& hello : hellos) {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (socket < 0) return fail(std::string("a viewer has no socket: ") + std::strerror(errno));
    drains->readers_.push_back({.socket = socket});
    const std::vector<uint8_t> bytes = encode(ClientMessage(hello));
    if (::connect(socket, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0 ||
        ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL) != static_cast<ssize_t>(bytes.size()))
      return fail(std::string("a viewer cannot connect: ") + std::strerror(errno));
  }
  for (size_t i = 0; i < drains->readers_.size(); ++i) {
    epoll_event event{};
    event.events = EPOLLIN;
    event.data.u64 = i;
    epoll_ctl(drains->epoll_, EPOLL_CTL_ADD, drains->readers_[i].socket, &event);
  }
  return drains;
}

void Drains::start() {
  CHECK(!thread_.joinable());
  thread_ = std::thread([this] { run(); });
}

void Drains::stop() {
  stopping_ = true;
  if (thread_.joinable()) thread_.join();
}

void Drains::receive(Reader& reader, const uint8_t* bytes, size_t size, double now_s) {
  const auto length = [&] {
    uint32_t value = 0;
    std::memcpy(&value, reader.head.data(), sizeof value);
    return size_t{value};
  };
  while (size > 0) {
    if (reader.skip > 0) {
      const size_t skipped = std::min(reader.skip, size);
      reader.skip -= skipped;
      bytes += skipped;
      size -= skipped;
      continue;
    }
    const size_t head = reader.have < length_prefix_bytes
                            ? length_prefix_bytes
                            : length_prefix_bytes + std::min(length(), head_bytes);
    const size_t taken = std::min(head - reader.have, size);
    std::memcpy(reader.head.data() + reader.have, bytes, taken);
    reader.have += taken;
    bytes += taken;
    size -= taken;
    if (reader.have < length_prefix_bytes) continue;
    if (reader.have < length_prefix_bytes + std::min(length(), head_bytes)) continue;
    const size_t body = reader.have - length_prefix_bytes;
    if (const auto tick = tick_of(reader.head.data() + length_prefix_bytes, body); tick && counting_)
      ages_.add(now_s - times_.of(*tick));
    reader.skip = length() - body;
    reader.have = 0;
  }
}

void Drains::run() {
  stand_aside();
  std::vector<epoll_event> events(256);
  std::vector<uint8_t> buffer(size_t{64} << 10U);
  while (!stopping_) {
    const int ready = epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), 20);
    for (int i = 0; i < ready; ++i) {
      Reader& reader = readers_[events[static_cast<size_t>(i)].data.u64];
      const ssize_t got = recv(reader.socket, buffer.data(), buffer.size(), MSG_DONTWAIT);
      if (got > 0) {
        if (counting_) bytes_ += static_cast<uint64_t>(got);
        receive(reader, buffer.data(), static_cast<size_t>(got), steady_now_s());
      } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
        ++lost_;
        epoll_ctl(epoll_, EPOLL_CTL_DEL, reader.socket, nullptr);
      }
    }
    cpu_s_ = thread_cpu_s();
  }
}

}  // namespace scree
