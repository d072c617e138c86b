// A link between a client and a server on loopback that makes each look to the other like one of a later
// release: a message of an unknown kind comes before every message, and every message has unknown fields.
// One connection; every wait has a deadline.
#pragma once

#include <array>
#include <atomic>
#include <poll.h>
#include <span>
#include <thread>
#include <vector>

#include "proto/byte_stream.h"
#include "proto/codec.h"
#include "proto/frame_reader.h"
#include "tests/support/loopback_socket.h"
#include "tests/support/raw_server.h"

namespace scree {

/// A Protobuf field of number 1,000, a varint: no message has it.
inline constexpr std::array<uint8_t, 3> unknown_field = {0xC0, 0x3E, 0x07};

/// A message of kind 1,001, with content, and its length in front.
inline constexpr std::array<uint8_t, 9> unknown_message = {5, 0, 0, 0, 0xCA, 0x3E, 0x02, 0x08, 0x01};

/// The same message with an unknown field, and another one around it. `body`: a message of some kind.
inline std::vector<uint8_t> grown(std::span<const uint8_t> body) {
  ByteReader reader(body, "message");
  const uint64_t kind = reader.varint("kind"), length = reader.varint("length");
  std::vector<uint8_t> grown;
  ByteWriter writer(grown);
  writer.u32(0);
  writer.varint(kind);
  writer.varint(length + unknown_field.size());
  const auto content = body.last(length);
  grown.insert(grown.end(), content.begin(), content.end());
  grown.insert(grown.end(), unknown_field.begin(), unknown_field.end());
  grown.insert(grown.end(), unknown_field.begin(), unknown_field.end());
  const size_t bytes = grown.size() - length_prefix_bytes;
  for (size_t i = 0; i < length_prefix_bytes; ++i) grown[i] = static_cast<uint8_t>(bytes >> (8 * i));
  return grown;
}

class GrowingRelay {
 public:
  explicit GrowingRelay(uint16_t server_port) : thread_([this, server_port] { run(server_port); }) {}
  ~GrowingRelay() {
    over_ = true;
    thread_.join();
  }
  GrowingRelay(const GrowingRelay&) = delete;
  GrowingRelay& operator=(const GrowingRelay&) = delete;

  uint16_t port() const { return clients_.port(); }

 private:
  void run(uint16_t server_port) {
    if (!clients_.accept()) return;
    const LoopbackSocket server(server_port);
    FrameReader from_client, from_server;
    while (!over_) {
      std::array<pollfd, 2> waiting{pollfd{clients_.socket(), POLLIN, 0}, pollfd{server.number(), POLLIN, 0}};
      ::poll(waiting.data(), waiting.size(), wait_ms);
      // The client's hello has to come first.
      if (waiting[0].revents != 0 && !pass(clients_.socket(), server.number(), from_client, hello_passed_))
        break;
      bool goes_on = true;
      if (waiting[1].revents != 0 && !pass(server.number(), clients_.socket(), from_server, goes_on)) break;
    }
    clients_.hang_up();
  }

  /// False at the end of the stream. `with_unknown`: messages of unknown kinds may come, from the second on.
  static bool pass(int from, int to, FrameReader& reader, bool& with_unknown) {
    std::array<uint8_t, 65536> bytes;
    const ssize_t count = ::recv(from, bytes.data(), bytes.size(), 0);
    if (count <= 0) return false;
    reader.push(std::span<const uint8_t>(bytes).first(static_cast<size_t>(count)));
    for (auto body = reader.next(); body && body->has_value(); body = reader.next()) {
      if (with_unknown && !send_all(to, unknown_message)) return false;
      with_unknown = true;
      if (!send_all(to, grown(**body))) return false;
    }
    return true;
  }
  static bool send_all(int to, std::span<const uint8_t> bytes) {
    while (!bytes.empty()) {
      const ssize_t sent = ::send(to, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (sent <= 0) return false;
      bytes = bytes.subspan(static_cast<size_t>(sent));
    }
    return true;
  }

  static constexpr int wait_ms = 20;
  RawServer clients_;
  bool hello_passed_ = false;
  std::atomic<bool> over_{false};
  std::thread thread_;
};

}  // namespace scree
