// One end of a stream of bytes within another stream, such as TLS over TCP. It has no sockets: its user feeds
// the bytes that arrived, and sends those that output holds. Not thread-safe.
//
// Every error is final; output may then hold the reason for the other end. What the other end sends is never
// trusted. An owner that feeds only when it wants to read, and stops while it cannot send, bounds what an
// engine holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/base/result.h"

namespace scree {

class StreamEngine {
 public:
  virtual ~StreamEngine() = default;

  virtual void feed(std::span<const uint8_t> arrived) = 0;

  /// Continues the handshake, if there is one, as far as the bytes go. The error is in words for people.
  virtual Result<void> shake() = 0;
  /// Whether the handshake is over, which read() and write() need.
  virtual bool established() const = 0;

  struct Got {
    size_t bytes = 0;    ///< 0: more must arrive first, or it ended
    bool ended = false;  ///< the other end will send no more
  };
  virtual Result<Got> read(std::span<uint8_t> into) = 0;
  virtual Result<void> write(std::span<const uint8_t> plain) = 0;
  /// Bytes for one write() that make best use of the stream below.
  virtual size_t chunk_bytes() const = 0;
  /// Tells the other end that no more comes.
  virtual void finish() = 0;

  virtual size_t output_bytes() const = 0;
  /// Moves all output into `into`, which is replaced.
  virtual void drain_output(std::vector<uint8_t>& into) = 0;
};

}  // namespace scree
