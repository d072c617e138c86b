#include "tools/import/process/frame_socket.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "shared/base/check.h"
#include "tools/import/process/limits.h"

namespace scree {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int64_t poll_ms_max = 60'000;

}  // namespace

FrameSocket::~FrameSocket() {
  ::close(socket_);
}

FrameSocket::Outcome FrameSocket::wait_for(short events, Clock::time_point until) const {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(until - Clock::now()).count();
    if (left <= 0) return Outcome::late;
    pollfd ready{socket_, events, 0};
    const int count = ::poll(&ready, 1, static_cast<int>(std::min<int64_t>(left, poll_ms_max)));
    if (count > 0) return Outcome::done;
    if (count < 0 && errno != EINTR) return Outcome::closed;
  }
}

FrameSocket::Outcome FrameSocket::send_all(std::span<const uint8_t> bytes, Clock::time_point until) {
  while (!bytes.empty()) {
    if (const Outcome ready = wait_for(POLLOUT, until); ready != Outcome::done) return ready;
    const ssize_t sent = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) bytes = bytes.subspan(static_cast<size_t>(sent));
    if (sent < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) return Outcome::closed;
  }
  return Outcome::done;
}

FrameSocket::Outcome FrameSocket::receive_all(std::span<uint8_t> bytes, Clock::time_point until) {
  while (!bytes.empty()) {
    if (const Outcome ready = wait_for(POLLIN, until); ready != Outcome::done) return ready;
    const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), MSG_DONTWAIT);
    if (got == 0) return Outcome::closed;
    if (got > 0) bytes = bytes.subspan(static_cast<size_t>(got));
    if (got < 0 && errno != EAGAIN && errno != EWOULDBLOCK && errno != EINTR) return Outcome::closed;
  }
  return Outcome::done;
}

FrameSocket::Outcome FrameSocket::send(FrameKind kind, std::span<const uint8_t> bytes,
                                       Clock::time_point until) {
  CHECK(bytes.size() <= limits::reader_frame_bytes_max);
  const std::array<uint32_t, 2> head{static_cast<uint32_t>(kind), static_cast<uint32_t>(bytes.size())};
  std::array<uint8_t, sizeof head> head_bytes{};
  std::memcpy(head_bytes.data(), head.data(), sizeof head);
  if (const Outcome sent = send_all(head_bytes, until); sent != Outcome::done) return sent;
  return send_all(bytes, until);
}

FrameSocket::Outcome FrameSocket::receive(Frame& frame, Clock::time_point until) {
  std::array<uint32_t, 2> head{};
  std::array<uint8_t, sizeof head> head_bytes{};
  if (const Outcome got = receive_all(head_bytes, until); got != Outcome::done) return got;
  std::memcpy(head.data(), head_bytes.data(), sizeof head);
  const auto [kind, length] = head;
  if (kind < static_cast<uint32_t>(FrameKind::values) || kind > static_cast<uint32_t>(FrameKind::no_memory) ||
      length > limits::reader_frame_bytes_max)
    return Outcome::malformed;
  frame.kind = static_cast<FrameKind>(kind);
  frame.bytes.resize(length);
  return receive_all(frame.bytes, until);
}

}  // namespace scree
