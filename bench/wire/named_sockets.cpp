#include "bench/wire/named_sockets.h"

#include <algorithm>
#include <arpa/inet.h>
#include <fcntl.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

namespace scree {

namespace {

/// The first two bytes of a message of this kind say which it is.
std::array<uint8_t, 2> tag_of(const ServerMessage& message) {
  const std::vector<uint8_t> bytes = encode(message);
  return {bytes.at(length_prefix_bytes), bytes.at(length_prefix_bytes + 1)};
}

bool has_tag(std::span<const uint8_t> body, const std::array<uint8_t, 2>& tag) {
  // A kind above 15 has two bytes of tag, another one a single one.
  return body.size() >= 2 && body[0] == tag[0] && (tag[0] < 0x80 || body[1] == tag[1]);
}

}  // namespace

NamedSocket::NamedSocket(uint16_t port, const std::string& ip)
    : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(port);
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  over_ = ::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0;
  ::fcntl(socket_, F_SETFL, ::fcntl(socket_, F_GETFL) | O_NONBLOCK);
  send("PROXY TCP4 " + ip + " 192.0.2.1 50000 4177\r\n");
  sent_bytes_ = 0;
}

NamedSocket::~NamedSocket() {
  ::close(socket_);
}

void NamedSocket::send(std::span<const uint8_t> bytes) {
  while (!over_ && !bytes.empty()) {
    const ssize_t count = ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count < 0 && errno == EAGAIN) {
      pollfd writable{socket_, POLLOUT, 0};
      over_ = ::poll(&writable, 1, 1000) <= 0;
      continue;
    }
    over_ = count <= 0;
    if (over_) return;
    sent_bytes_ += static_cast<uint64_t>(count);
    bytes = bytes.subspan(static_cast<size_t>(count));
  }
}

void NamedSocket::send(const std::string& text) {
  send(std::span(reinterpret_cast<const uint8_t*>(text.data()), text.size()));
}

std::span<const uint8_t> NamedSocket::arrived() {
  const ssize_t count = over_ ? 0 : ::recv(socket_, buffer_.data(), buffer_.size(), 0);
  if (count == 0 || (count < 0 && errno != EAGAIN)) over_ = true;
  if (count <= 0) return {};
  received_bytes_ += static_cast<uint64_t>(count);
  return std::span<const uint8_t>(buffer_).first(static_cast<size_t>(count));
}

void NamedSocket::receive() {
  while (!arrived().empty()) continue;
}

void NamedSocket::receive_messages() {
  static const auto ground = tag_of(GroundMessage{}), tile = tag_of(TileMessage{{}, {1}}),
                    welcome = tag_of(WelcomeMessage{});
  for (auto bytes = arrived(); !bytes.empty(); bytes = arrived()) {
    reader_.push(bytes);
    for (auto next = reader_.next(); next && next->has_value(); next = reader_.next()) {
      if (has_tag(**next, ground) || has_tag(**next, tile)) ++answers_;
      if (world_ != 0 || !has_tag(**next, welcome)) continue;
      const auto message = decode_server(**next);
      if (message && std::holds_alternative<WelcomeMessage>(*message))
        world_ = std::get<WelcomeMessage>(*message).world;
    }
  }
}

}  // namespace scree
