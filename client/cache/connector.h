// Attempts of a session to reach its server, one at a time. Nothing waits; time is an argument (seconds of
// std::chrono::steady_clock).
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>

#include "client/cache/rejoin.h"
#include "client/connection/server_channel.h"

namespace scree {

class Connector {
 public:
  /// One of the two.
  struct Attempt {
    std::unique_ptr<ServerChannel> channel;  ///< whose welcome has come
    ConnectionEnd end;
  };

  virtual ~Connector() = default;

  /// Begins an attempt: no other is under way, and no channel of an earlier one is in use. `rejoin`, which
  /// says what comes with the hello, is this attempt's until its end.
  virtual void begin(Rejoin& rejoin, const HelloMessage& hello, double now_s) = 0;
  virtual bool busy() const = 0;
  /// Sleeps until the attempt has ended, or the time is over. Does nothing where the thread that calls it is
  /// the one that brings the bytes.
  virtual void await(std::chrono::milliseconds within) = 0;
  /// How the attempt ended; nothing while it is under way.
  virtual std::optional<Attempt> poll(double now_s) = 0;
  /// The server, for people.
  virtual std::string where() const = 0;
};

}  // namespace scree
