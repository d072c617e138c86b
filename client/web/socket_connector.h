// A session's connection by a WebSocket that the page owns: the page brings received bytes and takes those to
// be sent, and opens and closes the socket as it is told to. Its binary messages are pieces of the same
// stream of bytes as by TCP, cut anywhere.
//
// One thread. Time is an argument, or that of std::chrono::steady_clock where the bytes come in.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "client/cache/connector.h"
#include "client/connection/intake.h"
#include "client/web/limits.h"

namespace scree {

/// The page's side of the socket, and what waits on either.
class PageSocket {
 public:
  enum class Wish { nothing, open, close };

  // ---- the page's calls

  /// What it is to do with its socket; each wish is told once.
  Wish pop_wish();
  void opened();
  void closed(const std::string& why);
  void received(std::span<const uint8_t> bytes);
  /// The bytes to be sent now, as one binary message; takes them.
  std::vector<uint8_t> drain_outgoing();

  // ---- a connection's calls

  /// Asks for a socket by which these messages go first.
  void open(const std::vector<ClientMessage>& first);
  /// No bytes are wanted any more.
  void close(const ConnectionEnd& end);
  void send(const ClientMessage& message);
  /// The next message; nothing when none has come. When what comes is no more of use, the socket is closed.
  std::optional<Received> next();

  bool is_closed() const { return state_ == State::closed; }
  const ConnectionEnd& end() const { return end_; }
  const Intake& intake() const { return intake_; }
  ConnectionCounters counters() const;
  /// Ends the connection when the server has fallen silent.
  void check_silence(std::chrono::steady_clock::time_point now);

 private:
  enum class State { closed, wanted, opening, open };
  struct Arrived {
    std::vector<uint8_t> bytes;
    std::chrono::steady_clock::time_point at;
  };

  State state_ = State::closed;
  bool must_close_ = false;  ///< the page's socket is open, and no more wanted
  ConnectionEnd end_;
  Intake intake_;
  std::deque<Arrived> arrived_;  ///< not pushed into the intake yet
  size_t unread_bytes_ = 0;
  std::chrono::steady_clock::time_point pushed_at_;  ///< the arrival of what the intake reads
  std::chrono::steady_clock::time_point heard_;
  std::vector<uint8_t> outgoing_;
  ConnectionCounters counters_;
};

/// Joins by the page's socket, which outlives it and its channels.
class SocketConnector final : public Connector {
 public:
  /// `where`: the server, for people.
  SocketConnector(PageSocket& socket, std::string where) : socket_(socket), where_(std::move(where)) {}

  void set_token(const std::string& token) { token_ = token; }
  /// Seconds that an attempt may take, in place of limits::page_join_s.
  void set_patience(double seconds) { patience_s_ = seconds; }

  void begin(Rejoin& rejoin, const HelloMessage& hello, double now_s) override;
  bool busy() const override { return busy_; }
  void await(std::chrono::milliseconds /*within*/) override {}
  std::optional<Attempt> poll(double now_s) override;
  std::string where() const override { return where_; }

 private:
  PageSocket& socket_;
  std::string where_;
  std::string token_;
  bool busy_ = false;
  double patience_s_ = limits::page_join_s;
  double until_s_ = 0.0;
};

}  // namespace scree
