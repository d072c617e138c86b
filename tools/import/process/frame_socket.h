// One end of a socket that carries frames of bounded length between two processes. One thread.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <vector>

namespace scree {

enum class FrameKind : uint32_t {
  values = 1,     ///< bytes of values
  refusal = 2,    ///< the words of an error
  no_memory = 3,  ///< the reader ran into its limit of memory
};

class FrameSocket {
 public:
  explicit FrameSocket(int socket) : socket_(socket) {}
  ~FrameSocket();
  FrameSocket(const FrameSocket&) = delete;
  FrameSocket& operator=(const FrameSocket&) = delete;

  struct Frame {
    FrameKind kind = FrameKind::values;
    std::vector<uint8_t> bytes;
  };
  enum class Outcome { done, late, closed, malformed };

  /// At most limits::reader_frame_bytes_max bytes. `until`: the end of the sender's patience.
  Outcome send(FrameKind kind, std::span<const uint8_t> bytes, std::chrono::steady_clock::time_point until);
  Outcome receive(Frame& frame, std::chrono::steady_clock::time_point until);

 private:
  Outcome wait_for(short events, std::chrono::steady_clock::time_point until) const;
  Outcome send_all(std::span<const uint8_t> bytes, std::chrono::steady_clock::time_point until);
  Outcome receive_all(std::span<uint8_t> bytes, std::chrono::steady_clock::time_point until);

  int socket_;
};

}  // namespace scree
