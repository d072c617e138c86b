// A stream of bytes both ways, whatever carries it: TCP, a Unix socket, TLS or a WebSocket over another
// stream. What is above it knows no other.
//
// All calls and all handlers are on one thread, the one that runs the sockets; write_now() alone may be
// called by another one while that one waits for it. At most one read and one write are under way at a time,
// and their memory stays valid until the handler is called. A handler is called once, possibly before the
// call returns; after close() it is called with an error, or not at all. Handlers keep their stream alive, so
// a stream is owned by a shared_ptr.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <tl/expected.hpp>

namespace scree {

/// How a stream ended.
struct StreamEnd {
  bool orderly = false;  ///< the other side finished sending
  std::string why;       ///< in words for people
  bool broken = false;   ///< the other side broke the rules of what carries the stream
};

/// The bytes that were read or written, at least one; or the end.
using Moved = tl::expected<size_t, StreamEnd>;

class Transport {
 public:
  using Done = std::function<void(const Moved&)>;
  using Buffers = std::span<const std::span<const uint8_t>>;

  virtual ~Transport() = default;

  virtual void read_some(std::span<uint8_t> into, Done done) = 0;
  /// Sends some of the bytes, from the first on.
  virtual void write_some(Buffers buffers, Done done) = 0;
  /// Sends the bytes that go without waiting, from the first on, calls no handler, and returns how many of
  /// them it took. 0: none; write_some() waits, or tells the error. No write is under way. send_rest() must
  /// follow before any other call.
  virtual size_t write_now(Buffers /*buffers*/) { return 0; }
  /// Goes on with the bytes that write_now() took and could not send.
  virtual void send_rest() {}
  /// Bytes that were taken from the writer, and wait on this machine to be sent, as far as it is known.
  virtual size_t unsent_bytes() { return 0; }
  /// Tells the other side that no more comes. No write is under way, and none follows.
  virtual void finish_sending() = 0;
  virtual void close() = 0;
  /// Closes like a lost link: the other side is not told in order.
  virtual void abort() = 0;

  /// Whether bytes pass: a handshake beneath, if there is one, is over.
  virtual bool established() const = 0;
  virtual bool encrypted() const = 0;
  /// The other side's numeric address, or words for one without; "unknown" if the link was lost before.
  virtual const std::string& address() const = 0;
  virtual uint16_t port() const = 0;
};

}  // namespace scree
